// SPDX-License-Identifier: Apache-2.0
#include "text/plain_text.hpp"

#include <algorithm>

namespace cortex::cli {
namespace {

bool continues(char c) { return (c & 0xC0) == 0x80; }  // a character of UTF-8

}  // namespace

std::size_t textWidth(std::string_view text) {
    return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, continues));
}

std::string clipped(const std::string& text, std::size_t width) {
    std::size_t end = 0;
    for (std::size_t characters = 0; end < text.size(); ++end) {
        if (!continues(text[end]) && characters++ == width) break;
    }
    return text.substr(0, end);
}

std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
    std::vector<std::string> lines(1);
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        if (!lines.back().empty() && textWidth(lines.back()) + 1 + textWidth(word) > width) {
            lines.emplace_back();
        }
        lines.back() += (lines.back().empty() ? "" : " ") + word;
        begin = end + 1;
    }
    return lines;
}

std::string plural(std::size_t count, const std::string& thing) {
    const char* ending = thing.ends_with('x') ? "es" : "s";
    return std::to_string(count) + " " + thing + (count == 1 ? "" : ending);
}

std::string joined(const std::vector<std::string>& parts, std::string_view separator) {
    std::string result;
    for (const std::string& part : parts) {
        if (!result.empty()) result += separator;
        result += part;
    }
    return result;
}

}  // namespace cortex::cli
