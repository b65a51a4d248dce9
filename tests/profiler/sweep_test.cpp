// SPDX-License-Identifier: Apache-2.0
#include "measure/sweep.hpp"

#include "report/quantity_text.hpp"

#include <gtest/gtest.h>

namespace cortex::profiler {
namespace {

// A loop of 1 ms whose cycles all take so long.
Measured measured(double duty, std::int64_t missed = 0) {
    Measured found;
    found.period = 1000;
    found.cycles = found.sleeps = 1000;
    found.missed = missed;
    found.duration.add(static_cast<std::int64_t>(duty * 1e4), 1000);
    found.complete = true;
    return found;
}

Sweep sweep(std::vector<std::pair<double, Measured>> points) {
    Sweep made;
    for (auto& [x, found] : points) made.points.push_back({x, std::move(found)});
    return made;
}

TEST(Sweep, OneTickOfAHundredMayBeMissedBeyondTheSleeper) {
    EXPECT_FALSE(measured(50).overflows());
    EXPECT_FALSE(measured(50, 10).overflows());
    EXPECT_TRUE(measured(50, 11).overflows());
    EXPECT_TRUE(measured(101).overflows());
    Measured disturbed = measured(50, 30);
    disturbed.sleeperMissed = 30;
    EXPECT_FALSE(disturbed.overflows());
}

TEST(Sweep, WhatPassesAboveAFailureDoesNotCount) {
    const Sweep found = sweep({{10, measured(10)},
                               {20, measured(20)},
                               {30, measured(30, 50)},
                               {40, measured(40)},
                               {50, measured(110)}});

    EXPECT_EQ(found.withoutOverflow(), 20);
    EXPECT_EQ(found.overflow(), 30);
}

TEST(Sweep, IsWithoutResultWhereItsFirstPointFailsAndWithoutEndWhereNoneDoes) {
    EXPECT_EQ(sweep({{10, measured(110)}}).withoutOverflow(), 0);
    EXPECT_EQ(sweep({{10, measured(10)}}).overflow(), 0);
}

TEST(Sweep, TheCapacityIsTheLargestNumberWithinSeventyPerCentWithAllLess) {
    const Sweep found = sweep({{10'000, measured(35)},
                               {19'000, measured(69)},
                               {21'000, measured(71)},
                               {30'000, measured(60)}});

    const Quantity capacity = capacityOf(found, 20'000);

    EXPECT_EQ(capacity.value, 19'000);
    EXPECT_EQ(verdictOf(capacity), Verdict::Missed);
    EXPECT_EQ(verdictOf(capacityOf(found, 19'000)), Verdict::Met);
}

TEST(Sweep, ACapacityThatADisturbanceCutShortIsNotJudged) {
    const Sweep found =
        sweep({{100, measured(1)}, {300, measured(3, 500)}, {30'000, measured(60)}});

    EXPECT_EQ(verdictOf(capacityOf(found, 20'000)), Verdict::NotJudged);
}

}  // namespace
}  // namespace cortex::profiler
