// SPDX-License-Identifier: Apache-2.0
#include "common/time_words.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstddef>

namespace cortex::common {
namespace {

constexpr std::int64_t secondOfTime = 1'000'000'000, minuteOfTime = 60 * secondOfTime,
                       hourOfTime = 60 * minuteOfTime, dayOfTime = 24 * hourOfTime;
constexpr int lastYear = 2261;  // whose end can be said in ns

bool isDigit(char each) { return each >= '0' && each <= '9'; }

std::size_t digitsOf(std::string_view text) {
    return static_cast<std::size_t>(std::ranges::find_if_not(text, isDigit) - text.begin());
}

bool takeSign(std::string_view& text, char sign) {
    if (!text.starts_with(sign)) return false;
    text.remove_prefix(1);
    return true;
}

// A number of so many digits, that is less than `end`.
std::optional<int> takeNumber(std::string_view& text, std::size_t fewest, std::size_t most,
                              int end) {
    const std::size_t digits = digitsOf(text);
    if (digits < fewest || digits > most) return {};
    int number = 0;
    std::from_chars(text.data(), text.data() + digits, number);
    text.remove_prefix(digits);
    return number < end ? std::optional{number} : std::nullopt;
}

// Behind the point of seconds, in ns.
std::optional<std::int64_t> takeFraction(std::string_view& text) {
    constexpr std::size_t most = 9;
    const std::size_t digits = digitsOf(text);
    if (digits == 0 || digits > most) return {};
    std::int64_t fraction = 0;
    std::from_chars(text.data(), text.data() + digits, fraction);
    for (std::size_t i = digits; i < most; ++i) fraction *= 10;
    text.remove_prefix(digits);
    return fraction;
}

// "14:05", "14:05:10", "14:05:10.25", each with or without a Z: ns of the day.
std::optional<std::int64_t> timeOfDay(std::string_view text) {
    const auto hour = takeNumber(text, 1, 2, 24);
    if (!hour || !takeSign(text, ':')) return {};
    const auto minute = takeNumber(text, 2, 2, 60);
    if (!minute) return {};
    std::int64_t time = *hour * hourOfTime + *minute * minuteOfTime;
    if (takeSign(text, ':')) {
        const auto seconds = takeNumber(text, 2, 2, 60);
        if (!seconds) return {};
        time += *seconds * secondOfTime;
        if (takeSign(text, '.')) {
            const auto fraction = takeFraction(text);
            if (!fraction) return {};
            time += *fraction;
        }
    }
    takeSign(text, 'Z');
    return text.empty() ? std::optional{time} : std::nullopt;
}

// "2026-11-29", and what stands behind a T.
std::optional<std::int64_t> dateAndTime(std::string_view text) {
    using namespace std::chrono;
    const auto inYear = takeNumber(text, 4, 4, lastYear + 1);
    if (!inYear || *inYear < 1970 || !takeSign(text, '-')) return {};
    const auto inMonth = takeNumber(text, 2, 2, 13);
    if (!inMonth || !takeSign(text, '-')) return {};
    const auto onDay = takeNumber(text, 2, 2, 32);
    if (!onDay) return {};
    const year_month_day date{year{*inYear}, month{static_cast<unsigned>(*inMonth)},
                              day{static_cast<unsigned>(*onDay)}};
    if (!date.ok()) return {};
    const std::int64_t begin = sys_days{date}.time_since_epoch().count() * dayOfTime;
    if (text.empty()) return begin;
    const auto time = takeSign(text, 'T') ? timeOfDay(text) : std::nullopt;
    return time ? std::optional{begin + *time} : std::nullopt;
}

// "90s", "1.5h": how long it is ago, in ns. Nobody counts longer than the years that a date has.
std::optional<double> agoFrom(std::string_view text) {
    if (text.empty() || !isDigit(text.front())) return {};
    double count = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size() - 1, count,
                                               std::chars_format::fixed);
    if (error != std::errc{} || rest != text.data() + text.size() - 1) return {};
    switch (text.back()) {
        case 's':
            return count * static_cast<double>(secondOfTime);
        case 'm':
            return count * static_cast<double>(minuteOfTime);
        case 'h':
            return count * static_cast<double>(hourOfTime);
        case 'd':
            return count * static_cast<double>(dayOfTime);
        default:
            return {};
    }
}

}  // namespace

std::optional<std::int64_t> timeFrom(std::string_view words, std::int64_t nowUtcNs) {
    while (takeSign(words, ' ')) {
    }
    while (words.ends_with(' ')) words.remove_suffix(1);
    if (const auto ago = agoFrom(words)) {
        if (*ago > static_cast<double>(nowUtcNs)) return {};
        return std::max<std::int64_t>(nowUtcNs - std::llround(*ago), 0);
    }
    if (const auto time = timeOfDay(words)) {
        const std::int64_t today = nowUtcNs - nowUtcNs % dayOfTime + *time;
        return today > nowUtcNs ? today - dayOfTime : today;
    }
    return dateAndTime(words);
}

}  // namespace cortex::common
