// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"

#include "cortex/core/printable.hpp"

#include "base/bounds.hpp"

#include <algorithm>
#include <cstddef>

namespace cortex {

namespace {

constexpr std::string_view blanks = " \t\r\n";

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

// Octets of the UTF-8 character that starts at `text[0]`; 0 if it is malformed.
std::size_t characterSize(std::string_view text) {
    const auto octet = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = octet(0);
    if (lead < 0x80) return 1;
    const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || text.size() < size) return 0;
    for (std::size_t i = 1; i < size; ++i) {
        if ((octet(i) & 0xC0U) != 0x80U) return 0;
    }
    const bool overlong = (lead == 0xE0 && octet(1) < 0xA0) || (lead == 0xF0 && octet(1) < 0x90);
    const bool surrogate = lead == 0xED && octet(1) >= 0xA0;
    const bool tooGreat = lead == 0xF4 && octet(1) >= 0x90;
    return overlong || surrogate || tooGreat ? 0 : size;
}

}  // namespace

std::vector<std::string_view> splitBlanks(std::string_view text) {
    std::vector<std::string_view> parts;
    std::size_t begin = text.find_first_not_of(blanks);
    while (begin != std::string_view::npos) {
        const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = text.find_first_not_of(blanks, end);
    }
    return parts;
}

std::string inQuotes(std::string_view text) {
    constexpr std::size_t most = 80;
    std::string result = "'";
    if (text.size() <= most) {
        result += text;
    } else {
        std::size_t end = most;
        while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
        result.append(text.substr(0, end)).append("…");
    }
    return result + "'";
}

bool isName(std::string_view text) {
    return !text.empty() && text.size() <= bounds::nameLength && isLetter(text.front()) &&
           std::ranges::all_of(text, [](char c) { return isLetter(c) || isDigit(c) || c == '-'; });
}

std::string wrongCount(std::size_t expected, std::size_t found) {
    return "expected " + std::to_string(expected) + (expected == 1 ? " value" : " values") +
           ", found " + std::to_string(found);
}

std::string printable(std::string_view text) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string result;
    const auto escape = [&](unsigned octet) {
        result += "\\x";
        result += digits[octet / 16];
        result += digits[octet % 16];
    };
    while (!text.empty()) {
        const std::size_t size = characterSize(text);
        const auto octet = static_cast<unsigned char>(text.front());
        const unsigned last = static_cast<unsigned char>(text[size > 1 ? 1 : 0]);
        const bool secondSet = size == 2 && octet == 0xC2 && last < 0xA0;  // U+0080 to U+009F
        if (size == 0 || octet < 0x20 || octet == 0x7F || secondSet)
            escape(last);
        else
            result += text.substr(0, size);
        text.remove_prefix(size == 0 ? 1 : size);
    }
    return result;
}

bool isUtf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t size = characterSize(text);
        if (size == 0) return false;
        text.remove_prefix(size);
    }
    return true;
}

}  // namespace cortex
