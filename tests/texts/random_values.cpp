// SPDX-License-Identifier: Apache-2.0
#include "texts/random_values.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>

namespace cortex::test {
namespace {

using Doubles = std::numeric_limits<double>;
using Ints = std::numeric_limits<std::int64_t>;

constexpr std::array hardDoubles{
    0.0,
    -0.0,
    1.0,
    0.1,
    -0.1,
    0.3,
    1.0 / 3,
    1e-300,
    1e300,
    Doubles::denorm_min(),
    -Doubles::denorm_min(),
    Doubles::min(),
    2.2250738585072011e-308,  // the largest that is denormal
    Doubles::max(),
    Doubles::lowest(),
    Doubles::epsilon(),
    9007199254740993.0,  // 2^53 + 1, halfway between two
    1e23,                // halfway, too
    5e-324,
    123456789012345678.0,
    4.35,
    -1e-7,
    100000.0,
};

constexpr std::int64_t twoTo53 = 9007199254740992;
constexpr std::array<std::int64_t, 12> hardInts{
    0,   1,   -1,          twoTo53 + 1,     -twoTo53 - 1,    Ints::max(),
    255, -42, Ints::min(), Ints::min() + 1, Ints::max() - 1, 1'000'000'000'000'000'000};

constexpr std::array hardTexts{
    " ",         "  ",      "\t",     "\n",         "\r",
    "\r\n",      "\"",      "'",      "\\",         "&",
    "<",         ">",       "]]>",    "<!--",       "-->",
    "&amp;",     "&#10;",   "&#0;",   "\\x41",      "\\x0",
    "\\\\",      "\\n",     "%s",     "=",          ",",
    ";",         "#",       "$HOME",  "true",       "1e5",
    "/",         "?>",      "\x7f",   "é",          "ü",
    "€",         "e\u0301", "中",     "\u0080",     "\u0085",
    "\u00a0",    "\u2028",  "\u202e", "\ufeff",     "\ufffd",
    "\uffff",    "\ud7ff",  "\ue000", "\U0001F600", "\U0001F469\u200D\U0001F467",
    "\U0010FFFF"};
constexpr std::array controls{"\x01", "\x07", "\b", "\v", "\f", "\x1b[31m", "\x1f", "a\x02\\"};

std::string character(char32_t code) {
    std::string text;
    const auto add = [&](char32_t octet) { text += static_cast<char>(octet); };
    if (code < 0x80) {
        add(code);
    } else if (code < 0x800) {
        add(0xC0 | code >> 6);
        add(0x80 | (code & 0x3F));
    } else if (code < 0x10000) {
        add(0xE0 | code >> 12);
        add(0x80 | (code >> 6 & 0x3F));
        add(0x80 | (code & 0x3F));
    } else {
        add(0xF0 | code >> 18);
        add(0x80 | (code >> 12 & 0x3F));
        add(0x80 | (code >> 6 & 0x3F));
        add(0x80 | (code & 0x3F));
    }
    return text;
}

std::string piece(Chance& chance, bool withControls) {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEF0123456789+-._";
    switch (chance.below(withControls ? 6 : 5)) {
        case 0:
        case 1:
            return std::string(1, letters[chance.below(letters.size())]);
        case 2:
        case 3:
            return chance.nextOf(hardTexts);
        case 4: {
            constexpr std::array<char32_t, 4> ends{0x80, 0x800, 0xD800, 0x110000};
            constexpr std::array<char32_t, 4> begins{0x20, 0x80, 0x800, 0x10000};
            const std::size_t size = chance.below(ends.size());
            return character(
                static_cast<char32_t>(begins[size] + chance.below(ends[size] - begins[size])));
        }
        default:
            return chance.nextOf(controls);
    }
}

// Empty, short, or as long as it may be.
std::string randomText(Chance& chance, std::size_t capacity, bool withControls) {
    constexpr std::size_t brief = 12;
    if (chance.oneIn(10)) return {};
    const bool whole = chance.oneIn(4);
    const std::size_t most = whole ? capacity : 1 + chance.below(std::min(brief, capacity));
    std::string text;
    for (int misses = 0; text.size() < most && misses < 4;) {
        const std::string next = piece(chance, withControls);
        if (text.size() + next.size() <= most)
            text += next;
        else
            ++misses;
    }
    if (whole) text.append(capacity - text.size(), 'x');
    return text;
}

double randomDouble(Chance& chance) {
    if (chance.oneIn(2)) return chance.nextOf(hardDoubles);
    if (chance.oneIn(2)) return static_cast<double>(chance.below(200'000)) / 1000 - 100;
    double number = Doubles::infinity();
    while (!std::isfinite(number)) number = std::bit_cast<double>(chance.bits());
    return number;
}

std::int64_t randomInt(Chance& chance) {
    if (chance.oneIn(2)) return chance.nextOf(hardInts);
    const auto number = static_cast<std::int64_t>(chance.bits());
    return chance.oneIn(2) ? number : number >> chance.below(63);
}

// Within the range: tried a few times, then one of its ends.
template <class T, class Make>
T inRange(const DataItem& item, Make make) {
    T number = make();
    const auto fits = [&] {
        return !(item.min && number < std::get<T>(*item.min)) &&
               !(item.max && number > std::get<T>(*item.max));
    };
    for (int tries = 0; !fits() && tries < 8; ++tries) number = make();
    return fits() ? number : std::get<T>(item.min ? *item.min : *item.max);
}

std::int64_t randomLabelled(Chance& chance, const DataItem& item) {
    auto label = item.labels.begin();
    std::advance(label, chance.below(item.labels.size()));
    return label->first;
}

Value make(Chance& chance, const DataItem& item, bool withControls) {
    switch (item.kind) {
        case Kind::Int: {
            std::vector<std::int64_t> ints(item.length);
            for (auto& each : ints)
                each = item.labels.empty()
                           ? inRange<std::int64_t>(item, [&] { return randomInt(chance); })
                           : randomLabelled(chance, item);
            return ints;
        }
        case Kind::Float: {
            std::vector<double> floats(item.length);
            for (double& each : floats)
                each = inRange<double>(item, [&] { return randomDouble(chance); });
            return floats;
        }
        case Kind::Bool: {
            std::vector<bool> bools(item.length);
            for (auto&& each : bools) each = chance.oneIn(2);
            return bools;
        }
        case Kind::String:
            break;
    }
    std::vector<std::string> texts(item.length);
    for (std::string& each : texts) each = randomText(chance, item.capacity, withControls);
    return texts;
}

std::string printed(const char* format, double number) {
    std::array<char, 1500> text{};
    std::snprintf(text.data(), text.size(), format, number);
    return text.data();
}

std::string shortest(double number, std::chars_format format) {
    std::array<char, 400> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number, format).ptr;
    return {text.data(), end};
}

// The shortest form, or more digits than it needs, up to all that there are.
std::string elementText(Chance& chance, double number) {
    if (chance.oneIn(32)) return printed("%.1100f", number);
    if (chance.oneIn(8)) return shortest(number, std::chars_format::fixed);
    if (chance.oneIn(4)) return printed("%+.25e", number);
    return chance.oneIn(2) ? printed("%.17g", number)
                           : shortest(number, std::chars_format::general);
}

std::string elementText(Chance& chance, std::int64_t number) {
    const bool sign = number >= 0 && chance.oneIn(4);
    return (sign ? "+" : "") + std::to_string(number);
}

std::string elementText(Chance&, bool element) { return element ? "true" : "false"; }

std::string elementText(Chance& chance, const std::string& text) {
    const bool plain = !text.empty() && text.find_first_of(" \t\r\n\"\\") == std::string::npos;
    if (plain && chance.oneIn(2)) return text;
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += c;
    }
    return quoted + '"';
}

std::string reference(Chance& chance, unsigned octet) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), chance.oneIn(2) ? "&#%u;" : "&#x%X;", octet);
    return text.data();
}

std::string escapedOctet(unsigned octet, bool upper) {
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), upper ? "\\x%02X" : "\\x%02x", octet);
    return text.data();
}

std::string withEscapes(Chance& chance, const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        const auto octet = static_cast<unsigned char>(c);
        if (c == '\\')
            escaped += "\\\\";
        else if (octet < 0x20 || (octet < 0x80 && chance.oneIn(8)))
            escaped += escapedOctet(octet, chance.oneIn(2));
        else
            escaped += c;
    }
    return escaped;
}

std::string place(std::size_t index, const std::string& expected, const std::string& found) {
    return "[" + std::to_string(index) + "] expected " + expected + ", found " + found;
}

std::string shown(std::int64_t number) { return std::to_string(number); }
std::string shown(bool value) { return value ? "true" : "false"; }
std::string shown(double number) { return printed("%a", number) + printed(" = %.17g", number); }
std::string shown(const std::string& text) {
    std::string octets = "'" + text + "' =";
    for (const char c : text) octets += escapedOctet(static_cast<unsigned char>(c), false);
    return octets;
}

template <class T>
bool same(const T& one, const T& other) {
    if constexpr (std::is_same_v<T, double>) {
        return std::bit_cast<std::uint64_t>(one) == std::bit_cast<std::uint64_t>(other);
    } else {
        return one == other;
    }
}

}  // namespace

// Half of them have no control characters, as those let the whole value be written in another way.
Value randomValue(Chance& chance, const DataItem& item) {
    return make(chance, item, chance.oneIn(2));
}
Value randomDefault(Chance& chance, const DataItem& item) { return make(chance, item, false); }

std::string writtenAs(Chance& chance, const Value& value) {
    if (const auto* texts = std::get_if<std::vector<std::string>>(&value);
        texts != nullptr && texts->size() == 1)
        return texts->front();
    return std::visit(
        [&](const auto& elements) {
            using Element = typename std::decay_t<decltype(elements)>::value_type;
            std::string text;
            for (const auto& each : elements) {
                constexpr std::array blanks{" ", "  ", "\n", "\t"};
                if (!text.empty()) text += chance.oneIn(8) ? chance.oneOf(blanks) : " ";
                text += elementText(chance, static_cast<const Element&>(each));
            }
            return text;
        },
        value);
}

std::string attribute(Chance& chance, std::string_view name, const std::string& text) {
    const char quote = chance.oneIn(2) ? '"' : '\'';
    std::string result = std::string{name} + "=" + quote;
    for (const char c : text) {
        const auto octet = static_cast<unsigned char>(c);
        const bool needed = octet < 0x20 || c == '&' || c == '<' || c == quote;
        if (c == '&' && chance.oneIn(2))
            result += "&amp;";
        else if (c == '<' && chance.oneIn(2))
            result += "&lt;";
        else if (needed || (octet < 0x80 && chance.oneIn(16)))
            result += reference(chance, octet);
        else
            result += c;
    }
    return result + quote;
}

std::string setting(Chance& chance, const std::string& item, const std::string& text) {
    const auto needsEscape = [](char c) {
        return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r';
    };
    const bool escaped = std::ranges::any_of(text, needsEscape) || chance.oneIn(4);
    return "<set data=\"" + item + "\" " +
           attribute(chance, "value", escaped ? withEscapes(chance, text) : text) +
           (escaped ? " escaped=\"true\"/>" : "/>") + "\n";
}

std::string difference(const Value& expected, const Value& found) {
    if (expected.index() != found.index()) return " is of another kind";
    if (lengthOf(expected) != lengthOf(found)) return " has another length";
    return std::visit(
        [&](const auto& elements) {
            using Elements = std::decay_t<decltype(elements)>;
            using Element = typename Elements::value_type;
            const auto& others = std::get<Elements>(found);
            for (std::size_t i = 0; i < elements.size(); ++i) {
                const Element one = elements[i], other = others[i];
                if (!same(one, other)) return place(i, shown(one), shown(other));
            }
            return std::string{};
        },
        expected);
}

}  // namespace cortex::test
