// SPDX-License-Identifier: Apache-2.0
#include "report/number_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace cortex::profiler {
namespace {

std::string printed(const char* format, int decimals, double value) {
    std::array<char, 400> text{};
    const int length = std::snprintf(text.data(), text.size(), format, decimals, value);
    return {text.data(), static_cast<std::size_t>(length)};
}

std::string withoutZeros(std::string text) {
    if (text.find('.') != std::string::npos) text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text;
}

}  // namespace

std::string readable(double value) {
    if (std::isnan(value)) return "none";
    if (value < 0) return "-" + readable(-value);
    if (std::isinf(value)) return "infinite";
    if (value != 0 && (value >= 1e12 || value < 1e-4)) {
        const std::string text = printed("%.*e", 2, value);
        const std::size_t mark = text.find('e');
        return withoutZeros(text.substr(0, mark)) + "e" +
               std::to_string(std::stoi(text.substr(mark + 1)));
    }
    const int before = value == 0 ? 0 : static_cast<int>(std::floor(std::log10(value)));
    const bool whole = value == std::round(value);
    std::string text = withoutZeros(printed("%.*f", whole ? 0 : std::max(0, 2 - before), value));
    const std::size_t point = std::min(text.find('.'), text.size());
    for (std::size_t at = point; point > 4 && at > 3; at -= 3) text.insert(at - 3, " ");
    return text;
}

std::string exact(double value) {
    if (std::isnan(value)) return {};
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
        if (c == '&') {
            result += "&amp;";
        } else if (c == '<') {
            result += "&lt;";
        } else if (c == '>') {
            result += "&gt;";
        } else if (c == '"') {
            result += "&quot;";
        } else if (control && c != '\n' && c != '\t') {
            result += "\uFFFD";
        } else {
            result += c;
        }
    }
    return result;
}

}  // namespace cortex::profiler
