// SPDX-License-Identifier: Apache-2.0
#include "wire/presence_interval.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

constexpr std::int64_t millisecond = 1'000'000;

TEST(PresenceInterval, IsATenthOfASecondAmongFewAndFiveSecondsAmongAnyNumber) {
    EXPECT_EQ(intervalAmong(0), 100 * millisecond);
    EXPECT_EQ(intervalAmong(5), 100 * millisecond);
    EXPECT_EQ(intervalAmong(50), 1'000 * millisecond);
    EXPECT_EQ(intervalAmong(250), 5'000 * millisecond);
    EXPECT_EQ(intervalAmong(std::numeric_limits<std::uint32_t>::max()), 5'000 * millisecond);
}

TEST(PresenceInterval, PatienceIsFourOfThemAndASecondAtLeast) {
    Presence presence;
    for (const auto& [interval, patience] :
         {std::pair<std::int64_t, std::int64_t>{100, 1'000}, {500, 2'000}, {2'000, 8'000}}) {
        presence.interval = interval * millisecond;
        EXPECT_EQ(patienceWith(presence), patience * millisecond);
    }
}

TEST(PresenceInterval, PatienceInACrowdIsThatOfItsInterval) {
    Presence presence;
    presence.interval = 500 * millisecond;
    EXPECT_EQ(patienceWith(presence, 25), 2'000 * millisecond);
    EXPECT_EQ(patienceWith(presence, 100), 8'000 * millisecond);
    presence.interval = 5'000 * millisecond;
    EXPECT_EQ(patienceWith(presence, 100), 20'000 * millisecond);
}

TEST(PresenceInterval, PatienceWithWhatCannotBeIsBounded) {
    Presence presence;
    for (const std::int64_t interval :
         {std::numeric_limits<std::int64_t>::min(), std::int64_t{-1}, std::int64_t{0}}) {
        presence.interval = interval;
        EXPECT_EQ(patienceWith(presence), 1'000 * millisecond);
    }
    presence.interval = std::numeric_limits<std::int64_t>::max();
    EXPECT_EQ(patienceWith(presence), 20'000 * millisecond);
}

}  // namespace
}  // namespace cortex::comms
