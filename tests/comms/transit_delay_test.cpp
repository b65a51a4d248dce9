// SPDX-License-Identifier: Apache-2.0
#include "agent/transit_delay.hpp"

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t ahead = 1'700'000'000'000'000'000;  // the sender's clock, before ours

TEST(TransitDelay, IsCountedFromTheQuickest) {
    TransitDelay delay;
    EXPECT_EQ(delay.next(ahead, 5 * ms), 0) << "nothing to compare with";
    EXPECT_EQ(delay.next(ahead + 10 * ms, 12 * ms), 0) << "quicker: took 3 ms less";
    EXPECT_EQ(delay.next(ahead + 20 * ms, 22 * ms), 0);
    EXPECT_EQ(delay.next(ahead + 30 * ms, 102 * ms), 70 * ms);
    EXPECT_EQ(delay.next(ahead + 40 * ms, 102 * ms), 60 * ms) << "all of a queue";
    EXPECT_EQ(delay.next(ahead + 101 * ms, 103 * ms), 0);
}

TEST(TransitDelay, RemembersTheQuickestForTenSeconds) {
    TransitDelay delay;
    delay.next(ahead, 2 * ms);
    for (std::int64_t time = 1; time < 10'000; time += 50) {
        EXPECT_EQ(delay.next(ahead + time * ms, (time + 5) * ms), 3 * ms) << time;
    }
    EXPECT_EQ(delay.next(ahead + 10'100 * ms, 10'105 * ms), 3 * ms) << "of the window before";
    EXPECT_EQ(delay.next(ahead + 21'000 * ms, 21'005 * ms), 0) << "that is what they all take";
}

TEST(TransitDelay, IsKnownOfTheFirstAfterALongSilence) {
    TransitDelay delay;
    delay.next(ahead, 2 * ms);
    EXPECT_EQ(delay.next(ahead + 60'000 * ms, 60'082 * ms), 80 * ms);
    EXPECT_EQ(delay.next(ahead + 60'081 * ms, 60'083 * ms), 0);
}

TEST(TransitDelay, BeginsAnewWhereTheSendersClockIsSet) {
    TransitDelay delay;
    delay.next(ahead + 3'600'000 * ms, 2 * ms);
    EXPECT_EQ(delay.next(ahead, 3 * ms), 0) << "back";
    EXPECT_EQ(delay.next(ahead + 7 * ms, 10 * ms), 0);
    EXPECT_EQ(delay.next(ahead + 3'600'000 * ms, 11 * ms), 0) << "and forth";
    EXPECT_EQ(delay.next(ahead + 3'600'001 * ms, 15 * ms), 3 * ms);
}

}  // namespace
}  // namespace cortex::comms
