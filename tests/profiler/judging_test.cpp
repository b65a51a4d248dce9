// SPDX-License-Identifier: Apache-2.0
#include "report/judging.hpp"

#include "report/quantity_text.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace cortex::profiler {
namespace {

LoopAndSleeper found(std::vector<double> loop, std::vector<double> sleeper) {
    return {{std::move(loop)}, {std::move(sleeper)}};
}

Histogram times(double typical, double slow) {  // us; two of 100 are slow
    Histogram histogram;
    histogram.add(static_cast<std::int64_t>(typical * 1e3), 98);
    histogram.add(static_cast<std::int64_t>(slow * 1e3), 2);
    return histogram;
}

TEST(Judging, ALoopAsLateAsTheSleeperMeetsTheAimAndALaterOneMissesIt) {
    const std::vector<double> quiet{50, 51, 50, 49};

    EXPECT_EQ(verdictOf(judgedLateness(found({55, 56, 54, 55}, quiet))), Verdict::Met);
    EXPECT_EQ(verdictOf(judgedLateness(found({65, 66, 64, 65}, quiet))), Verdict::Missed);
}

TEST(Judging, NothingIsSaidOfLatenessWhereTheSleeperDiffersFromItself) {
    const std::vector<double> noisy{50, 70, 51, 69};

    const Quantity ratio = judgedLateness(found({50, 50, 50, 50}, noisy));

    EXPECT_EQ(verdictOf(ratio), Verdict::NotJudged);
    EXPECT_NE(ratio.doubt.find("more than 1.3 is not judged"), std::string::npos) << ratio.doubt;
    EXPECT_EQ(verdictOf(judgedLateness(found({}, {}))), Verdict::NotJudged);
    EXPECT_EQ(verdictOf(judgedLateness(found({1, 1}, {0, 0}))), Verdict::NotJudged);
}

TEST(Judging, AChangeOfLatenessIsMissedAboveTheLargerOfItsLimitAndTheNoise) {
    const LoopAndSleeper alone = found({50, 50}, {50, 50});

    EXPECT_EQ(verdictOf(judgedChange(found({55, 55}, {50, 50}), alone)), Verdict::Met);
    EXPECT_EQ(verdictOf(judgedChange(found({62, 62}, {50, 50}), alone)), Verdict::Missed);
    EXPECT_EQ(verdictOf(judgedChange(found({62, 62}, {50, 63}), alone)), Verdict::Met);
    EXPECT_EQ(verdictOf(judgedChange(found({99, 99}, {50, 66}), alone)), Verdict::NotJudged);
}

TEST(Judging, TicksMissedBeyondTheSleeperAreMissedUnlessMereComputingMissesThem) {
    const Missed none{0, 10'000}, one{1, 10'000}, three{3, 10'000};

    EXPECT_EQ(verdictOf(judgedMissed(one, none, none)), Verdict::Met);
    EXPECT_EQ(verdictOf(judgedMissed(three, none, none)), Verdict::Missed);
    EXPECT_EQ(verdictOf(judgedMissed(three, {2, 10'000}, none)), Verdict::Met);
    EXPECT_EQ(verdictOf(judgedMissed(three, none, three)), Verdict::NotJudged);
    EXPECT_EQ(verdictOf(judgedMissed(one, none, three)), Verdict::Met);
}

TEST(Judging, ADutyCycleAboveTheLimitIsMissedUnlessMereComputingIsAsUneven) {
    const Histogram even = times(500, 520), uneven = times(500, 800);

    EXPECT_EQ(verdictOf(judgedDuty(times(500, 690), even, 1000, 70)), Verdict::Met);
    EXPECT_EQ(verdictOf(judgedDuty(times(500, 720), even, 1000, 70)), Verdict::Missed);
    EXPECT_EQ(verdictOf(judgedDuty(times(500, 720), uneven, 1000, 70)), Verdict::NotJudged);
    EXPECT_EQ(verdictOf(judgedDuty(times(710, 720), uneven, 1000, 70)), Verdict::Missed);
}

TEST(Judging, ACapacityBelowTheAimIsMissedUnlessItEndedAtALowLoad) {
    EXPECT_EQ(verdictOf(judgedCapacity(21'000, 60, 70, 20'000)), Verdict::Met);
    EXPECT_EQ(verdictOf(judgedCapacity(19'000, 60, 70, 20'000)), Verdict::Missed);
    EXPECT_EQ(verdictOf(judgedCapacity(100, 2, 70, 20'000)), Verdict::NotJudged);
}

TEST(Judging, SchedulingIsWhatThePoolAddsToThePlainLoop) {
    const Quantity overhead = judgedOverhead({{34, 33, 35}, {30, 30.1, 30}, 80});

    EXPECT_NEAR(overhead.value, 3, 1e-9);
    EXPECT_NEAR(overhead.baseline, 50, 1e-9);
    EXPECT_EQ(overhead.limit, 5);
    EXPECT_EQ(verdictOf(overhead), Verdict::Met);
    EXPECT_EQ(verdictOf(judgedOverhead({{36, 36}, {30, 30}, 80})), Verdict::Missed);
    EXPECT_EQ(verdictOf(judgedOverhead({{34, 34}, {30, 30}, 60})), Verdict::Missed);
}

TEST(Judging, SchedulingIsNotJudgedWhereThePlainLoopDiffersFromItself) {
    EXPECT_EQ(verdictOf(judgedOverhead({{40, 40}, {30, 39}, 80})), Verdict::NotJudged);
    EXPECT_EQ(verdictOf(judgedOverhead({{34, 34}, {30, 30}, 29})), Verdict::NotJudged);
}

TEST(Judging, LatenessIsTakenSecondBySecond) {
    struct Wake {
        std::int64_t lateness;
        int block;
    };
    std::vector<Wake> wakes;
    for (int block : {0, 1}) {
        for (int i = 1; i <= 100; ++i) wakes.push_back({(block + 1) * i * 1000, block});
    }

    EXPECT_EQ(latenessOf(wakes).p99s, (std::vector<double>{99, 198}));
}

}  // namespace
}  // namespace cortex::profiler
