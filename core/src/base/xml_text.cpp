// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/xml_text.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace cortex {
namespace {

bool isControl(char c) { return static_cast<unsigned char>(c) < 0x20; }

bool isSpace(char c) { return c == '\t' || c == '\n' || c == '\r'; }

std::string withEscapes(std::string_view value) {
    constexpr std::string_view digits = "0123456789abcdef";
    const bool whole = isUtf8(value);
    std::string result;
    for (const char c : value) {
        const auto octet = static_cast<unsigned char>(c);
        if (c == '\\') {
            result += "\\\\";
        } else if (isControl(c) || (!whole && octet >= 0x80)) {
            result += "\\x";
            result += digits[octet / 16];
            result += digits[octet % 16];
        } else {
            result += c;
        }
    }
    return result;
}

}  // namespace

std::string xmlAttribute(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                if (static_cast<unsigned char>(c) < 0x20) {
                    result += "&#" + std::to_string(static_cast<int>(c)) + ";";
                } else {
                    result += c;
                }
        }
    }
    return result;
}

std::string setElement(std::string_view item, std::string_view value) {
    const auto forbidden = [](char c) { return isControl(c) && !isSpace(c); };
    const bool plain = isUtf8(value) && std::ranges::none_of(value, forbidden);
    return "<set data=\"" + xmlAttribute(item) + "\" value=\"" +
           xmlAttribute(plain ? std::string{value} : withEscapes(value)) + "\"" +
           (plain ? "" : " escaped=\"true\"") + "/>";
}

std::optional<std::string> withoutEscapes(std::string_view value) {
    std::string result;
    while (!value.empty()) {
        const std::size_t plain = std::min(value.find('\\'), value.size());
        result += value.substr(0, plain);
        value.remove_prefix(plain);
        if (value.empty()) break;
        if (value.starts_with("\\\\")) {
            result += '\\';
            value.remove_prefix(2);
            continue;
        }
        constexpr std::size_t size = 4;  // \xNN
        unsigned octet = 0;
        if (value.size() < size || value[1] != 'x') return {};
        const char* end = value.data() + size;
        const auto [stop, error] = std::from_chars(value.data() + 2, end, octet, 16);
        if (error != std::errc{} || stop != end) return {};
        result += static_cast<char>(octet);
        value.remove_prefix(size);
    }
    return result;
}

}  // namespace cortex
