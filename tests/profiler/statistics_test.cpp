// SPDX-License-Identifier: Apache-2.0
#include "report/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::profiler {
namespace {

TEST(Statistics, TheMedianOfAnEvenNumberIsBetweenTheTwoInTheMiddle) {
    EXPECT_EQ(median({}), 0);
    EXPECT_EQ(median({3, 1, 2}), 2);
    EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
}

TEST(Statistics, APercentileIsTheValueOfItsRank) {
    EXPECT_EQ(percentile({}, 0.5), 0);
    EXPECT_EQ(percentile({5}, 0.01), 5);
    EXPECT_EQ(percentile({4, 1, 3, 2}, 0.5), 2);
    EXPECT_EQ(percentile({4, 1, 3, 2}, 1), 4);
}

TEST(Statistics, OnlyAStraightLineIsStraight) {
    std::vector<Point> straight, bent;
    for (int x = 0; x <= 10; ++x) {
        straight.push_back({x * 1.0, 3.0 * x + 7});
        bent.push_back({x * 1.0, 1.0 * x * x});
    }

    EXPECT_NEAR(fit(straight).slope, 3, 1e-9);
    EXPECT_NEAR(fit(straight).residual, 0, 1e-9);
    EXPECT_GT(fit(bent).residual, 0.1);
}

TEST(Histogram, IsEmptyAtFirstAndSaysZero) {
    const Histogram histogram;

    EXPECT_EQ(histogram.count(), 0U);
    EXPECT_EQ(histogram.percentile(0.99), 0);
    EXPECT_EQ(histogram.max(), 0);
    EXPECT_EQ(histogram.mean(), 0);
    EXPECT_TRUE(histogram.shareAbove().empty());
}

TEST(Histogram, FindsPercentilesOfRandomTimesWithinHalfAPerCent) {
    std::mt19937_64 random{7};
    std::lognormal_distribution<double> times{9, 2};  // ns, over some orders of magnitude
    Histogram histogram;
    std::vector<double> all;
    for (int i = 0; i < 100'000; ++i) {
        const auto time = static_cast<std::int64_t>(times(random));
        histogram.add(time);
        all.push_back(static_cast<double>(time) * 1e-3);
    }
    std::ranges::sort(all);
    double sum = 0;
    for (const double each : all) sum += each;

    for (const double part : {0.01, 0.5, 0.9, 0.99, 0.999, 0.9999}) {
        const double exact = all[static_cast<std::size_t>(std::ceil(part * 1e5)) - 1];
        EXPECT_NEAR(histogram.percentile(part), exact, exact * 0.005 + 0.001) << part;
    }
    EXPECT_DOUBLE_EQ(histogram.max(), all.back());
    EXPECT_NEAR(histogram.mean(), sum / 1e5, sum / 1e5 * 1e-9);
}

TEST(Histogram, CountsWhatItIsToldSeveralTimesAtOnce) {
    Histogram histogram;
    histogram.add(1000, 99);
    histogram.add(50'000);

    EXPECT_EQ(histogram.count(), 100U);
    EXPECT_NEAR(histogram.percentile(0.99), 1, 0.01);
    EXPECT_NEAR(histogram.percentile(1), 50, 0.2);
}

TEST(Histogram, TakesNegativeAndHugeTimesWithoutHarm) {
    Histogram histogram;
    histogram.add(-5);
    histogram.add(3'600'000'000'000);

    EXPECT_EQ(histogram.percentile(0.5), 0);
    EXPECT_DOUBLE_EQ(histogram.max(), 3.6e9);
}

TEST(Histogram, SharesAboveFallFromOneToNothing) {
    Histogram histogram;
    for (int i = 1; i <= 1000; ++i) histogram.add(i * 1000);

    const std::vector<Point> shares = histogram.shareAbove();
    ASSERT_GT(shares.size(), 50U);
    EXPECT_LT(shares.front().x, 2);
    EXPECT_GT(shares.front().y, 0.99);
    for (std::size_t i = 1; i < shares.size(); ++i) {
        EXPECT_GT(shares[i].x, shares[i - 1].x);
        EXPECT_LT(shares[i].y, shares[i - 1].y);
    }
    EXPECT_LT(shares.back().y, 0.05);
}

}  // namespace
}  // namespace cortex::profiler
