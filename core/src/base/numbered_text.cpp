// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/numbered_text.hpp"

#include "cortex/core/value.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <iterator>
#include <limits>

namespace cortex {
namespace {

bool isDecimal(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

bool belongsToName(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '/' || c == ':';
}

// Where the digits with point and exponent end that begin here.
std::size_t endOfNumber(std::string_view text, std::size_t begin) {
    std::size_t end = begin;
    const auto digits = [&] {
        while (end < text.size() && isDecimal(text[end])) ++end;
    };
    digits();
    if (end + 1 < text.size() && text[end] == '.' && isDecimal(text[end + 1])) {
        ++end;
        digits();
    }
    if (end < text.size() && text[end] == 'e') {
        std::size_t next = end + 1;
        if (next < text.size() && (text[next] == '-' || text[next] == '+')) ++next;
        if (next < text.size() && isDecimal(text[next])) {
            end = next;
            digits();
        }
    }
    return end;
}

// The end of the number that begins here; `begin`: none does.
std::size_t numberAt(std::string_view text, std::size_t begin) {
    const std::size_t first = text[begin] == '-' ? begin + 1 : begin;
    if (first >= text.size() || !isDecimal(text[first])) return begin;
    const char before = begin > 0 ? text[begin - 1] : ' ';
    if (belongsToName(before) || before == '.' || before == '-') return begin;
    const std::size_t end = endOfNumber(text, first);
    return end < text.size() && belongsToName(text[end]) ? begin : end;
}

}  // namespace

NumberedText numberedText(std::string_view text) {
    NumberedText result;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t end = quoted ? i : numberAt(text, i);
        if (end > i) {
            result.numbers.emplace_back(text.substr(i, end - i));
            result.words += numberSign;
            i = end;
            continue;
        }
        // A whole name or number that belongs to one, so that no part of it is taken for a number.
        do {
            if (text[i] == '"') quoted = !quoted;
            if (text[i] != numberSign) result.words += text[i];
            ++i;
        } while (i < text.size() && belongsToName(text[i - 1]) && belongsToName(text[i]));
    }
    return result;
}

NumberRange::NumberRange(const std::string& number)
    : first{number}, last{number}, least{number}, greatest{number} {}

void NumberRange::take(const std::string& number) {
    const double value = valueOfNumber(number);
    last = number;
    if (value < valueOfNumber(least)) least = number;
    if (value > valueOfNumber(greatest)) greatest = number;
}

bool NumberRange::isOne() const { return valueOfNumber(least) == valueOfNumber(greatest); }

double valueOfNumber(const std::string& number) {
    return toFloat(number).value_or(std::numeric_limits<double>::infinity());
}

std::string withoutDigits(std::string_view text) {
    std::string words;
    std::ranges::copy_if(text, std::back_inserter(words),
                         [](char each) { return !isDecimal(each); });
    return words;
}

}  // namespace cortex
