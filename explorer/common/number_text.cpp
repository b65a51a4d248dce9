// SPDX-License-Identifier: Apache-2.0
#include "common/number_text.hpp"

#include "cortex/core/value.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace cortex::common {

namespace {

constexpr int mostDecimals = 17, significantDigits = 6;
// Beyond these there is an exponent; where decimals are asked for, only beyond the last one.
constexpr double smallest = 1e-4, greatest = 1e7, greatestFixed = 1e15;

std::string written(double number, std::chars_format format, int decimals) {
    std::array<char, 400> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), number, format, decimals);
    return {text.data(), end.ptr};
}

std::string withoutZeros(std::string text) {
    if (text.find('.') == std::string::npos) return text;
    text.resize(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

// "1.2e-5" of 0.000012.
std::string withExponent(double number) {
    const std::string text = written(number, std::chars_format::scientific, significantDigits - 1);
    const std::size_t e = text.find('e');
    return withoutZeros(text.substr(0, e)) + 'e' + std::to_string(std::stoi(text.substr(e + 1)));
}

// What rounds to zero has no sign.
std::string withoutSignOfZero(std::string text) {
    return text.find_first_of("123456789") == std::string::npos && text.front() == '-'
               ? text.substr(1)
               : text;
}

std::optional<int> decimalsOfFormat(const std::string& format) {
    const std::size_t dot = format.find('.');
    int decimals = 0;
    if (dot == std::string::npos) return std::nullopt;
    const char* end = format.data() + format.size();
    if (std::from_chars(format.data() + dot + 1, end, decimals).ec != std::errc{}) return {};
    return std::clamp(decimals, 0, mostDecimals);
}

}  // namespace

// A format such as "%.3f", or a resolution of 0.001.
int decimalsOf(const DataItem& item) {
    if (const auto decimals = decimalsOfFormat(item.format)) return *decimals;
    if (item.resolution <= 0) return -1;
    const double decimals = std::ceil(-std::log10(item.resolution) - 1e-9);
    return std::clamp(static_cast<int>(decimals), 0, mostDecimals);
}

std::string significantText(double number, int digits) {
    if (number == 0) return "0";
    const int before = static_cast<int>(std::floor(std::log10(std::abs(number)))) + 1;
    return withoutSignOfZero(
        withoutZeros(written(number, std::chars_format::fixed, std::max(0, digits - before))));
}

std::string numberText(const DataItem& item, double number) {
    if (!std::isfinite(number)) return toText(number);
    const double size = std::abs(number);
    const int decimals = decimalsOf(item);
    if (decimals < 0) {
        const bool plain = size == 0 || (size >= smallest && size < greatest);
        return plain ? significantText(number, significantDigits) : withExponent(number);
    }
    if (size >= greatestFixed) return withExponent(number);
    return withoutSignOfZero(written(number, std::chars_format::fixed, decimals));
}

}  // namespace cortex::common
