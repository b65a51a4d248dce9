// SPDX-License-Identifier: Apache-2.0
// Times as people write them.
#include "common/time_words.hpp"

#include "common/utc_text.hpp"

#include <cstdint>
#include <limits>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using common::timeFrom;

constexpr std::int64_t halfPastTwo = 1'795'962'600'250'000'000;  // 2026-11-29T14:30:00.25Z

std::string textFrom(const std::string& words, std::int64_t now = halfPastTwo) {
    const auto time = timeFrom(words, now);
    return time ? common::utcText(*time) : "none";
}

TEST(TimeWords, AreAgoOfTheDayOrADate) {
    const struct {
        const char *words, *time;
    } table[] = {{"90s", "2026-11-29T14:28:30.250Z"},
                 {"0s", "2026-11-29T14:30:00.250Z"},
                 {"10m", "2026-11-29T14:20:00.250Z"},
                 {"1h", "2026-11-29T13:30:00.250Z"},
                 {"1.5h", "2026-11-29T13:00:00.250Z"},
                 {"0.25s", "2026-11-29T14:30:00.000Z"},
                 {"2d", "2026-11-27T14:30:00.250Z"},
                 {"14:05", "2026-11-29T14:05:00.000Z"},
                 {"9:05", "2026-11-29T09:05:00.000Z"},
                 {"00:00", "2026-11-29T00:00:00.000Z"},
                 {"14:30:00.25", "2026-11-29T14:30:00.250Z"},
                 {"14:30:00.250000001", "2026-11-28T14:30:00.250Z"},  // not yet today
                 {"14:31", "2026-11-28T14:31:00.000Z"},
                 {"23:59:59", "2026-11-28T23:59:59.000Z"},
                 {"14:05:10Z", "2026-11-29T14:05:10.000Z"},
                 {"2026-11-29", "2026-11-29T00:00:00.000Z"},
                 {"2028-02-29", "2028-02-29T00:00:00.000Z"},
                 {"1970-01-01", "1970-01-01T00:00:00.000Z"},
                 {"2261-12-31T23:59:59", "2261-12-31T23:59:59.000Z"},
                 {"2026-11-29T14:05", "2026-11-29T14:05:00.000Z"},
                 {"2026-11-29T14:05:10Z", "2026-11-29T14:05:10.000Z"},
                 {" 2026-11-29T14:05:10.123Z ", "2026-11-29T14:05:10.123Z"}};
    for (const auto& each : table) EXPECT_EQ(textFrom(each.words), each.time) << each.words;
}

TEST(TimeWords, AreOnlyWhatTheFormsSay) {
    for (const std::string& wrong : {std::string{},
                                     std::string{" "},
                                     std::string{"1"},
                                     std::string{"10"},
                                     std::string{"10 m"},
                                     std::string{"-5m"},
                                     std::string{"+5m"},
                                     std::string{"5w"},
                                     std::string{"5M"},
                                     std::string{"1e1s"},
                                     std::string{"nans"},
                                     std::string{"infs"},
                                     std::string{"0x5s"},
                                     std::string{"s"},
                                     std::string{".5s"},
                                     std::string{"1h30m"},
                                     std::string{"yesterday"},
                                     std::string{"24:00"},
                                     std::string{"14:60"},
                                     std::string{"14:05:60"},
                                     std::string{"14:5"},
                                     std::string{"140:5"},
                                     std::string{"14:05:"},
                                     std::string{"14:05:10."},
                                     std::string{"14:05ZZ"},
                                     std::string{"14:05 "} + '\0',
                                     std::string{"2026-02-29"},
                                     std::string{"2026-13-01"},
                                     std::string{"2026-00-01"},
                                     std::string{"2026-11-31"},
                                     std::string{"2026-11-0"},
                                     std::string{"26-11-29"},
                                     std::string{"1969-12-31"},
                                     std::string{"2262-01-01"},
                                     std::string{"2026-11-29Z"},
                                     std::string{"2026-11-29T"},
                                     std::string{"2026-11-29 14:05"},
                                     std::string{"2026-11-29T25:00"},
                                     std::string{"99999999d"},
                                     std::string(10'000, '9') + "s",
                                     std::string(10'000, '9'),
                                     std::string{"14:05\n"},
                                     std::string{"١٤:٠٥"}}) {
        EXPECT_EQ(textFrom(wrong), "none") << wrong.substr(0, 40);
    }
}

TEST(TimeWords, EachFormThatAUserIsToldIsOne) {
    std::string forms = common::timeForms;
    for (const char* part : {", of the years 1970 to 2261", ", in UTC", "(ago)", " or", ","}) {
        for (auto at = forms.find(part); at != std::string::npos; at = forms.find(part))
            forms.replace(at, std::string{part}.size(), " ");
    }
    std::istringstream words{forms};
    int count = 0;
    for (std::string each; words >> each; ++count) EXPECT_NE(textFrom(each), "none") << each;
    EXPECT_EQ(count, 9) << forms;
}

TEST(TimeWords, OfTheFirstDayDoNotGoBeforeIt) {
    constexpr std::int64_t hour = 3'600'000'000'000;
    EXPECT_EQ(timeFrom("1h", hour), 0);
    EXPECT_EQ(timeFrom("2h", hour), std::nullopt);
    EXPECT_TRUE(timeFrom("1h", std::numeric_limits<std::int64_t>::max()));
}

}  // namespace
}  // namespace cortex::test
