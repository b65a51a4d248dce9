// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

// Texts of events with their numbers taken out: those that differ only in numbers are told as one.
namespace cortex {

constexpr char numberSign = '\x01';  // stands for a number; control characters are never shown

// "position limited from # to # rad", and the numbers as they were written. What belongs to a name
// (/drives/4, A4, 0x8611, 12:04) or stands in quotes is no number.
struct NumberedText {
    std::string words;
    std::vector<std::string> numbers;
};
NumberedText numberedText(std::string_view text);

// The numbers at one place of such texts, as they were written.
struct NumberRange {
    std::string first, last, least, greatest;

    explicit NumberRange(const std::string& number);
    void take(const std::string& number);
    bool isOne() const;  // all of them have the same value
};

// Of a number in such a text, whatever the locale; one that no double holds is infinite.
double valueOfNumber(const std::string& number);

// Without any digit, those of names too.
std::string withoutDigits(std::string_view text);

}  // namespace cortex
