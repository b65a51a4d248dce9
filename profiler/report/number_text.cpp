// SPDX-License-Identifier: Apache-2.0
#include "report/number_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace cortex::profiler {
namespace {

bool continues(char c) { return (c & 0xC0) == 0x80; }  // a character of UTF-8

std::string printed(const char* format, int decimals, double value) {
    std::array<char, 400> text{};
    const int length = std::snprintf(text.data(), text.size(), format, decimals, value);
    return {text.data(), static_cast<std::size_t>(length)};
}

}  // namespace

std::string fixed(double value, int decimals, std::string_view group) {
    std::string text = printed("%.*f", decimals, std::abs(value));
    const bool zero = text.find_first_not_of("0.") == std::string::npos;
    const std::size_t whole = std::min(text.find('.'), text.size());
    for (std::size_t at = whole; whole > 4 && at > 3; at -= 3) text.insert(at - 3, group);
    return value < 0 && !zero ? "-" + text : text;
}

std::string readable(double value, std::string_view group) {
    if (std::isnan(value)) return "none";
    if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
    const double size = std::abs(value);
    if (size != 0 && (size >= 1e12 || size < 1e-4)) {
        const std::string text = printed("%.*e", 2, value);
        const std::size_t mark = text.find('e');
        return text.substr(0, mark) + "e" + std::to_string(std::stoi(text.substr(mark + 1)));
    }
    if (value == std::round(value)) return fixed(value, 0, group);
    const int before = static_cast<int>(std::floor(std::log10(size)));
    std::string text = fixed(value, std::max(0, 2 - before), group);
    if (text.find('.') != std::string::npos) text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text;
}

std::string exact(double value) {
    if (std::isnan(value)) return {};
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

std::string powerOfTen(int exponent) {
    constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = exponent < 0 ? "10⁻" : "10";
    for (const char digit : std::to_string(std::abs(exponent))) {
        text += digits[static_cast<std::size_t>(digit - '0')];
    }
    return text;
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\'':
                result += "&#39;";
                break;
            case '\n':
            case '\t':
                result += c;
                break;
            default:
                if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
                    result += "\uFFFD";
                } else {
                    result += c;
                }
        }
    }
    return result;
}

std::size_t characters(std::string_view text) {
    return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, continues));
}

std::string clipped(const std::string& text, std::size_t width) {
    if (characters(text) <= width) return text;
    std::size_t end = 0;
    for (std::size_t seen = 0; end < text.size(); ++end) {
        if (!continues(text[end]) && ++seen == std::max<std::size_t>(width, 1)) break;
    }
    return text.substr(0, end) + "…";
}

}  // namespace cortex::profiler
