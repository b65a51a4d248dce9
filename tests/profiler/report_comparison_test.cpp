// SPDX-License-Identifier: Apache-2.0
#include "profiler/report_results.hpp"
#include "report/comparison.hpp"
#include "report/machine_facts.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace cortex::profiler {
namespace {

Quantity quantity(double value, std::vector<double> repeats = {}) {
    Quantity result;
    result.id = result.what = "time";
    result.unit = "ns";
    result.value = value;
    result.repeats = std::move(repeats);
    return result;
}

Compared compared(const Quantity& before, const Quantity& after) {
    Results first, second;
    first.quantities = {before};
    second.quantities = {after};
    return compare(first, second).quantities.at(0);
}

Change change(const Quantity& before, const Quantity& after) {
    return compared(before, after).change;
}

TEST(ReportComparison, WithoutRepeatsFivePercentAreNoise) {
    EXPECT_EQ(change(quantity(100), quantity(104.9)), Change::Noise);
    EXPECT_EQ(change(quantity(100), quantity(106)), Change::Worse);
    EXPECT_EQ(change(quantity(100), quantity(94)), Change::Better);
    EXPECT_EQ(change(quantity(100, {100}), quantity(104.9, {104.9})), Change::Noise);
}

TEST(ReportComparison, QuietRepeatsMakeSmallChangesCount) {
    const std::vector<double> quiet{100, 100.1, 99.9, 100, 100.1};

    EXPECT_EQ(change(quantity(100, quiet), quantity(102, {102, 102, 102.1, 101.9, 102})),
              Change::Worse);
    EXPECT_EQ(change(quantity(100, quiet), quantity(100.5, quiet)), Change::Noise);
}

TEST(ReportComparison, NoisyRepeatsOfOneSideAreEnoughToDoubt) {
    const Quantity noisy = quantity(100, {80, 90, 100, 110, 120});

    EXPECT_EQ(change(noisy, quantity(130, {130, 130, 130, 130, 130})), Change::Noise);
    EXPECT_EQ(change(quantity(130, {130, 130, 130, 130, 130}), noisy), Change::Noise);
    EXPECT_EQ(change(noisy, quantity(150)), Change::Worse);
}

TEST(ReportComparison, TheNoiseOfManyRepeatsIsNotMovedByOneOutlier) {
    EXPECT_NEAR(noiseOf(quantity(100, {98, 99, 100, 101, 5000})), 3 * 1.4826, 1e-9);
    EXPECT_NEAR(noiseOf(quantity(100, {97, 103})), 6, 1e-9);
    EXPECT_NEAR(noiseOf(quantity(100, {100, 100, 100, 100, 100})), 1, 1e-9);
}

TEST(ReportComparison, MoreIsBetterWhereTheQuantitySaysSo) {
    Quantity before = quantity(100), after = quantity(200);
    before.lessIsBetter = after.lessIsBetter = false;

    EXPECT_EQ(change(before, after), Change::Better);
    EXPECT_EQ(change(after, before), Change::Worse);
    EXPECT_EQ(compared(before, after).ratio, 2.0);
}

TEST(ReportComparison, FromNothingToSomethingIsAChangeWithoutARatio) {
    EXPECT_EQ(change(quantity(0), quantity(0)), Change::Noise);
    EXPECT_EQ(change(quantity(0), quantity(3)), Change::Worse);
    EXPECT_EQ(compared(quantity(0), quantity(3)).ratio, std::nullopt);
    EXPECT_EQ(change(quantity(-5), quantity(3)), Change::Worse);
    EXPECT_EQ(compared(quantity(-5), quantity(3)).ratio, std::nullopt);
}

TEST(ReportComparison, WhatIsNotANumberOrHasAnotherUnitIsNotCompared) {
    Quantity other = quantity(100);
    other.unit = "µs";

    EXPECT_EQ(change(quantity(100), other), Change::NotComparable);
    EXPECT_EQ(change(quantity(100), quantity(std::numeric_limits<double>::quiet_NaN())),
              Change::NotComparable);
    EXPECT_EQ(noiseOf(quantity(100, {std::numeric_limits<double>::infinity(), 100})), 5);
}

TEST(ReportComparison, WhatIsOnlyOnOneSideIsListed) {
    Results before = sampleResults(), after = sampleResults();
    before.quantities[0].id = "gone";
    after.quantities[0].id = "new";

    const Comparison comparison = compare(before, after);

    ASSERT_EQ(comparison.onlyBefore.size(), 1U);
    EXPECT_EQ(comparison.onlyBefore[0].id, "gone");
    ASSERT_EQ(comparison.onlyAfter.size(), 1U);
    EXPECT_EQ(comparison.onlyAfter[0].id, "new");
    EXPECT_EQ(comparison.quantities.size(), 1U);
    EXPECT_NE(comparisonText(comparison, 80).find("only after: first"), std::string::npos);
}

TEST(ReportComparison, OtherMachinesAreSaidFirst) {
    Results before = sampleResults(), after = sampleResults();
    before.machine = {{"CPU", "A"}, {"kernel", "same"}, {loadFact, "0.1"}};
    after.machine = {{"CPU", "B"}, {"kernel", "same"}, {loadFact, "7.5"}, {"governor", "new"}};

    const Comparison comparison = compare(before, after);

    EXPECT_EQ(comparison.otherMachine,
              (std::vector<std::string>{"CPU: A, then B", "governor: not told, then new"}));
    EXPECT_EQ(comparisonText(comparison, 80).find("DIFFERENT MACHINES"), 0U);
    EXPECT_EQ(comparisonText(compare(before, before), 80).find("DIFFERENT"), std::string::npos);
}

TEST(ReportComparison, TheTextBeginsWithWhatIsWorse) {
    Results before, after;
    for (const auto& [id, value] : {std::pair{"calm", 100.0}, {"good", 50.0}, {"bad", 200.0}}) {
        Quantity each = quantity(100);
        each.id = each.what = id;
        before.quantities.push_back(each);
        each.value = value;
        after.quantities.push_back(each);
    }

    const std::string text = comparisonText(compare(before, after), 80);

    EXPECT_LT(text.find("bad"), text.find("good"));
    EXPECT_LT(text.find("good"), text.find("calm"));
    EXPECT_NE(text.find("1 worse, 1 better, 1 within noise"), std::string::npos);
}

}  // namespace
}  // namespace cortex::profiler
