// SPDX-License-Identifier: Apache-2.0
#include "peers/rejoin.hpp"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

constexpr std::int64_t second = 1'000'000'000;

// The seconds of 2,000 in which it is due, where nobody is heard and somebody proves nothing.
std::vector<std::int64_t> dueIn(Rejoin& rejoin) {
    std::vector<std::int64_t> due;
    for (std::int64_t i = 0; i < 2'000; ++i) {
        if (rejoin.isDue(false, true, i * second)) due.push_back(i);
    }
    return due;
}

TEST(Rejoin, IsDueEverMoreSeldomForWhoHearsNobodyAnyMore) {
    Rejoin rejoin;
    EXPECT_FALSE(rejoin.isDue(true, true, 0)) << "it hears somebody";
    EXPECT_EQ(dueIn(rejoin), (std::vector<std::int64_t>{0, 10, 30, 70, 150, 310, 630, 1230, 1830}));
}

TEST(Rejoin, IsDueLaterForWhoNeverHeardAnybody) {
    Rejoin rejoin;
    EXPECT_EQ(dueIn(rejoin),
              (std::vector<std::int64_t>{10, 20, 40, 80, 160, 320, 640, 1240, 1840}));
}

TEST(Rejoin, IsNotDueWhereNobodyIsFound) {
    Rejoin rejoin;
    EXPECT_FALSE(rejoin.isDue(false, false, 0));
    EXPECT_FALSE(rejoin.isDue(true, false, second));
    EXPECT_FALSE(rejoin.isDue(false, false, 100 * second));
}

TEST(Rejoin, BeginsAnewOnceSomebodyWasHeard) {
    Rejoin rejoin;
    rejoin.isDue(true, false, 0);
    ASSERT_TRUE(rejoin.isDue(false, true, second));
    ASSERT_TRUE(rejoin.isDue(false, true, 11 * second));
    EXPECT_FALSE(rejoin.isDue(false, true, 30 * second));
    rejoin.isDue(true, false, 31 * second);
    EXPECT_TRUE(rejoin.isDue(false, true, 32 * second));
    EXPECT_FALSE(rejoin.isDue(false, true, 41 * second));
    EXPECT_TRUE(rejoin.isDue(false, true, 42 * second));
}

}  // namespace
}  // namespace cortex::comms
