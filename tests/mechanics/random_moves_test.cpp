// SPDX-License-Identifier: Apache-2.0
#include "mechanics/random_moves.hpp"

#include <cstdlib>
#include <iostream>

#include <gtest/gtest.h>

namespace cortex::mechanics::test {
namespace {

int moves() {
    const char* asked = std::getenv("CORTEX_PROFILE_MOVES");
    return asked ? std::atoi(asked) : 500;
}

TEST(RandomMoves, KeepTheLimitsOfJerkAndArriveTogether) {
    const RandomMoves::Result result = RandomMoves{7, true}.run(moves());

    std::cout << result.samples << " samples, " << result.aimedAnew << " aimed anew, v "
              << result.used.velocity << ", a " << result.used.acceleration << ", j "
              << result.used.jerk << ", end " << result.endError << ", spread " << result.spread
              << ", beyond " << result.beyondRange << '\n';
    EXPECT_EQ(result.refused, 0);
    EXPECT_GT(result.aimedAnew, moves() / 2);
    EXPECT_LE(result.used.velocity, 1 + 1e-8);
    EXPECT_LE(result.used.acceleration, 1 + 1e-8);
    EXPECT_LE(result.used.jerk, 1 + 1e-5);
    EXPECT_LE(result.endError, 1e-9);
    EXPECT_LE(result.spread, RandomMoves::period);
    EXPECT_LE(result.beyondRange, 1e-12);
}

TEST(RandomMoves, KeepTheLimitsOfTrapezoids) {
    const RandomMoves::Result result = RandomMoves{8, false}.run(moves() / 5);

    EXPECT_EQ(result.refused, 0);
    EXPECT_LE(result.used.velocity, 1 + 1e-8);
    EXPECT_LE(result.used.acceleration, 1 + 1e-8);
    EXPECT_LE(result.endError, 1e-9);
    EXPECT_LE(result.spread, RandomMoves::period);
    EXPECT_LE(result.beyondRange, 1e-12);
}

TEST(RandomMoves, TellAGeneratorThatTakesOnePercentTooMuch) {
    const RandomMoves::Result result = RandomMoves{7, true, 1.01}.run(20);

    EXPECT_GT(result.used.acceleration, 1.009);
}

}  // namespace
}  // namespace cortex::mechanics::test
