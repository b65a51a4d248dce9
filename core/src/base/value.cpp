// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/value.hpp"

#include "base/text.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace cortex {

namespace {

template <class T>
std::string numberText(T number) {
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
    return {buffer.data(), end};
}

template <class T>
std::optional<T> wholeNumber(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(text.substr(1).starts_with('-') ? 0 : 1);
    T number{};
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc{} || stop != end) return std::nullopt;
    return number;
}

std::string elementText(std::int64_t element) { return toText(element); }
std::string elementText(double element) { return toText(element); }
std::string elementText(bool element) { return element ? "true" : "false"; }

// An element of an array of strings: quoted where blanks or quotes would be misread.
std::string elementText(const std::string& element) {
    if (!element.empty() && element.find_first_of(" \t\r\n\"\\") == std::string::npos) {
        return element;
    }
    std::string result = "\"";
    for (const char c : element) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + "\"";
}

// Splits at blanks outside of double quotes. False: a quote is not closed or stands inside a word.
bool splitStrings(std::string_view text, std::vector<std::string>& parts) {
    constexpr std::string_view separators = " \t\r\n";
    std::size_t i = text.find_first_not_of(separators);
    while (i != std::string_view::npos && i < text.size()) {
        std::string part;
        if (text[i] == '"') {
            for (++i; i < text.size() && text[i] != '"'; ++i) {
                if (text[i] == '\\' && i + 1 < text.size()) ++i;
                part += text[i];
            }
            if (i == text.size()) return false;
            ++i;
            if (i < text.size() && separators.find(text[i]) == std::string_view::npos) return false;
        } else {
            const std::size_t end = std::min(text.find_first_of(separators, i), text.size());
            part = text.substr(i, end - i);
            if (part.find('"') != std::string::npos) return false;
            i = end;
        }
        parts.push_back(std::move(part));
        i = text.find_first_not_of(separators, i);
    }
    return true;
}

// One that is whole, and too large, is told how large it may be.
const char* wholeExpected(std::string_view word) {
    const bool whole = word.find_first_not_of("+-0123456789") == std::string_view::npos;
    return whole ? "a whole number of 64 bit" : "a whole number";
}

template <class T, class Convert, class Expected>
std::optional<Value> parseElements(std::size_t length, std::string_view text, Convert convert,
                                   Expected expected, std::string& why) {
    const auto words = splitBlanks(text);
    if (words.size() != length) {
        why = wrongCount(length, words.size());
        return std::nullopt;
    }
    std::vector<T> elements;
    elements.reserve(length);
    for (const std::string_view word : words) {
        const auto element = convert(word);
        if (!element) {
            why = std::string{"expected "} + expected(word) + ", found " + inQuotes(word);
            return std::nullopt;
        }
        elements.push_back(*element);
    }
    return Value{std::move(elements)};
}

std::optional<Value> parseStrings(std::size_t length, std::string_view text, std::string& why) {
    std::vector<std::string> parts;
    if (!isUtf8(text) || text.find('\0') != std::string_view::npos) {
        why = isUtf8(text) ? "the text has the octet 0" : "the text is not UTF-8";
        return std::nullopt;
    }
    if (length == 1) {
        parts.emplace_back(text);
    } else if (!splitStrings(text, parts)) {
        why = "a double quote does not begin or end an element";
        return std::nullopt;
    } else if (parts.size() != length) {
        why = wrongCount(length, parts.size());
        return std::nullopt;
    }
    return Value{std::move(parts)};
}

}  // namespace

Kind kindOf(const Value& value) { return static_cast<Kind>(value.index()); }

std::size_t lengthOf(const Value& value) {
    return std::visit([](const auto& elements) { return elements.size(); }, value);
}

std::string toText(std::int64_t number) { return numberText(number); }
std::string toText(double number) { return numberText(number); }

std::string toText(const Number& number) {
    return std::visit([](auto plain) { return toText(plain); }, number);
}

std::string toText(const Value& value) {
    if (const auto* strings = std::get_if<std::vector<std::string>>(&value)) {
        if (strings->size() == 1) return strings->front();
    }
    return std::visit(
        [](const auto& elements) {
            std::string result;
            for (std::size_t i = 0; i < elements.size(); ++i) {
                if (i > 0) result += ' ';
                result += elementText(elements[i]);
            }
            return result;
        },
        value);
}

std::optional<std::int64_t> toInt(std::string_view text) { return wholeNumber<std::int64_t>(text); }

std::optional<double> toFloat(std::string_view text) {
    const auto number = wholeNumber<double>(text);
    if (number && !std::isfinite(*number)) return std::nullopt;
    return number;
}

std::optional<bool> toBool(std::string_view text) {
    if (text == "true") return true;
    if (text == "false") return false;
    return std::nullopt;
}

std::optional<Value> parseValue(Kind kind, std::size_t length, std::string_view text,
                                std::string& why) {
    switch (kind) {
        case Kind::Int:
            return parseElements<std::int64_t>(length, text, toInt, wholeExpected, why);
        case Kind::Float:
            return parseElements<double>(
                length, text, toFloat, [](auto) { return "a finite number"; }, why);
        case Kind::Bool:
            return parseElements<bool>(
                length, text, toBool, [](auto) { return "true or false"; }, why);
        case Kind::String:
            return parseStrings(length, text, why);
    }
    return std::nullopt;
}

}  // namespace cortex
