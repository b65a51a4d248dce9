// SPDX-License-Identifier: Apache-2.0
#include "types/unit.hpp"

#include "cortex/core/nearest_names.hpp"
#include "cortex/core/type_model.hpp"
#include "cortex/core/value.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <vector>

namespace cortex {

namespace {

struct Symbol {
    std::string_view text;
    bool metric;  // takes a prefix
    Dimension dimension;
};

//                                         m  kg  s rad  K  A cd mol bit
constexpr Symbol symbols[] = {
    {"m", true, {1}},
    {"g", true, {0, 1}},
    {"s", true, {0, 0, 1}},
    {"rad", true, {0, 0, 0, 1}},
    {"K", true, {0, 0, 0, 0, 1}},
    {"A", true, {0, 0, 0, 0, 0, 1}},
    {"cd", true, {0, 0, 0, 0, 0, 0, 1}},
    {"mol", true, {0, 0, 0, 0, 0, 0, 0, 1}},
    {"bit", true, {0, 0, 0, 0, 0, 0, 0, 0, 1}},
    {"By", true, {0, 0, 0, 0, 0, 0, 0, 0, 1}},
    {"Cel", false, {0, 0, 0, 0, 1}},
    {"deg", false, {0, 0, 0, 1}},
    {"sr", true, {0, 0, 0, 2}},
    {"%", false, {}},
    {"[ppm]", false, {}},
    {"min", false, {0, 0, 1}},
    {"h", false, {0, 0, 1}},
    {"d", false, {0, 0, 1}},
    {"a", false, {0, 0, 1}},
    {"Hz", true, {0, 0, -1}},
    {"N", true, {1, 1, -2}},
    {"Pa", true, {-1, 1, -2}},
    {"bar", true, {-1, 1, -2}},
    {"J", true, {2, 1, -2}},
    {"eV", true, {2, 1, -2}},
    {"W", true, {2, 1, -3}},
    {"C", true, {0, 0, 1, 0, 0, 1}},
    {"V", true, {2, 1, -3, 0, 0, -1}},
    {"Ohm", true, {2, 1, -3, 0, 0, -2}},
    {"S", true, {-2, -1, 3, 0, 0, 2}},
    {"F", true, {-2, -1, 4, 0, 0, 2}},
    {"H", true, {2, 1, -2, 0, 0, -2}},
    {"Wb", true, {2, 1, -2, 0, 0, -1}},
    {"T", true, {0, 1, -2, 0, 0, -1}},
    {"lm", true, {0, 0, 0, 2, 0, 0, 1}},
    {"lx", true, {-2, 0, 0, 2, 0, 0, 1}},
    {"Bq", true, {0, 0, -1}},
    {"Gy", true, {2, 0, -2}},
    {"Sv", true, {2, 0, -2}},
    {"L", true, {3}},
    {"l", true, {3}},
    {"t", true, {0, 1}},
    {"u", true, {0, 1}},
};

constexpr std::string_view prefixes[] = {"da", "Y", "Z", "E", "P", "T", "G", "M", "k", "h",
                                         "d",  "c", "m", "u", "n", "p", "f", "a", "z", "y"};

// What people write, and what UCUM says.
constexpr std::pair<std::string_view, std::string_view> habits[] = {
    {"sec", "s"},      {"second", "s"},    {"seconds", "s"},   {"meter", "m"},  {"metre", "m"},
    {"hour", "h"},     {"degree", "deg"},  {"degrees", "deg"}, {"°", "deg"},    {"°C", "Cel"},
    {"degC", "Cel"},   {"celsius", "Cel"}, {"Nm", "N.m"},      {"ohm", "Ohm"},  {"Ω", "Ohm"},
    {"µs", "us"},      {"μs", "us"},       {"µm", "um"},       {"hz", "Hz"},    {"rpm", "/min"},
    {"percent", "%"},  {"volt", "V"},      {"amp", "A"},       {"newton", "N"}, {"kilogram", "kg"},
    {"radian", "rad"}, {"radians", "rad"}, {"watt", "W"},      {"byte", "By"},  {"B", "By"},
    {"none", "1"},     {"ppm", "[ppm]"},
};

const Symbol* find(std::string_view text) {
    const auto found = std::ranges::find(symbols, text, &Symbol::text);
    return found == std::end(symbols) ? nullptr : found;
}

// "mm" is m with a prefix; what is a symbol as a whole ("min", "cd", "Pa") has none.
const Symbol* findWithPrefix(std::string_view text) {
    if (const Symbol* whole = find(text)) return whole;
    for (const std::string_view prefix : prefixes) {
        if (!text.starts_with(prefix)) continue;
        const Symbol* symbol = find(text.substr(prefix.size()));
        if (symbol && symbol->metric) return symbol;
    }
    return nullptr;
}

std::string suggestion(std::string_view text) {
    const auto habit = std::ranges::find(habits, text, [](const auto& pair) { return pair.first; });
    if (habit != std::end(habits)) return "nearest of: " + std::string{habit->second};
    std::vector<std::string> valid;
    for (const Symbol& symbol : symbols) {
        valid.emplace_back(symbol.text);
        if (!symbol.metric) continue;
        for (const std::string_view prefix : {"k", "m", "u"}) {
            valid.push_back(std::string{prefix} + std::string{symbol.text});
        }
    }
    const std::string near = nearestNames(text, valid);
    return near.empty() ? "symbols such as m, rad, s, kg, N, V, A, Cel, %, or 1 for none" : near;
}

// Adds one factor, such as "s2" or "m-1", with exponents by symbol.
bool addFactor(std::string_view factor, int sign, std::map<std::string, int>& exponents,
               Dimension& dimension, std::string& why) {
    constexpr std::int64_t most = 9;
    const std::size_t digits = factor.empty() ? 0 : factor.find_last_not_of("0123456789") + 1;
    const bool negative = digits > 0 && digits < factor.size() && factor[digits - 1] == '-';
    const std::string_view symbol = factor.substr(0, digits - (negative ? 1 : 0));
    std::int64_t exponent = 1;
    if (digits < factor.size()) exponent = toInt(factor.substr(digits)).value_or(0);
    const Symbol* known = findWithPrefix(symbol);
    if (!known) {
        why = "unit symbol " + inQuotes(symbol.empty() ? factor : symbol) + " is not known; " +
              suggestion(symbol);
        return false;
    }
    if (exponent < 1 || exponent > most) {
        why = "the exponent in " + inQuotes(factor) + " is not from 1 to 9";
        return false;
    }
    const int power = static_cast<int>(exponent) * (negative ? -sign : sign);
    exponents[std::string{symbol}] += power;
    for (std::size_t i = 0; i < dimension.size(); ++i) {
        dimension[i] = static_cast<std::int16_t>(dimension[i] + known->dimension[i] * power);
    }
    return true;
}

std::string canonicalText(const std::map<std::string, int>& exponents) {
    std::string above, below;
    for (const auto& [symbol, exponent] : exponents) {
        if (exponent == 0) continue;
        const int power = std::abs(exponent);
        const std::string factor = power == 1 ? symbol : symbol + std::to_string(power);
        if (exponent > 0) {
            above += (above.empty() ? "" : ".") + factor;
        } else {
            below += "/" + factor;
        }
    }
    const std::string result = above + below;
    return result.empty() ? "1" : result;
}

}  // namespace

std::optional<Unit> parseUnit(std::string_view text, std::string& why) {
    constexpr std::size_t longest = 32;
    const auto habit = std::ranges::find(habits, text, [](const auto& pair) { return pair.first; });
    if (habit != std::end(habits) && !findWithPrefix(text)) {
        why = inQuotes(text) + " is not a unit of UCUM; " + suggestion(text);
        return std::nullopt;
    }
    if (text.empty() || text.size() > longest) {
        why = "a unit has 1 to 32 characters; write 1 for none";
        return std::nullopt;
    }
    Unit unit;
    std::map<std::string, int> exponents;
    int sign = 1;
    std::string_view rest = text;
    if (rest.starts_with('/')) {
        sign = -1;
        rest.remove_prefix(1);
    }
    while (true) {
        const std::size_t end = std::min(rest.find_first_of("./"), rest.size());
        const std::string_view factor = rest.substr(0, end);
        const bool one = factor == "1";
        if (!one && !addFactor(factor, sign, exponents, unit.dimension, why)) return std::nullopt;
        if (end == rest.size()) break;
        sign = rest[end] == '/' ? -1 : 1;
        rest.remove_prefix(end + 1);
    }
    unit.canonical = canonicalText(exponents);
    return unit;
}

}  // namespace cortex
