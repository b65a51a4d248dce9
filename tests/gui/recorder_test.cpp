// SPDX-License-Identifier: Apache-2.0
// What is recorded of agents that are made by hand.
#include "record/recorder.hpp"

#include "made_agent.hpp"
#include "model/plotted_items.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cortex::gui {
namespace {

using test::MadeAgent;

class Recording : public testing::Test {
protected:
    void hear() { recorder.hear("far", *agent.now().image); }
    const Ring& ring() { return *recorder.ring(gain); }
    const AgentTime& time() { return *recorder.time("far"); }

    MadeAgent agent{"far", [](SimplexTree& tree) { tree.add("/probe", "Probe"); }};
    RecordedItem gain{"far", "/probe", "gain", 0}, state{"far", "/probe", "state", 0};
    Recorder recorder;
};

TEST_F(Recording, KeepsEveryCycleWithItsTime) {
    recorder.record(this, {gain});
    for (int i = 1; i <= 100; ++i) {
        agent.put("/probe", "gain", i * 0.5);
        hear();
    }
    recorder.take();
    ASSERT_EQ(ring().end() - ring().begin(), 100);
    for (std::int64_t i = 1; i <= 100; ++i) {
        EXPECT_EQ(ring().value(i), static_cast<double>(i) * 0.5);
        EXPECT_EQ(time().table.utcAt(i), MadeAgent::start + i * MadeAgent::period);
        EXPECT_EQ(time().cycleAt(i), i);
    }
    EXPECT_NEAR(time().indexAt(time().secondsAt(42)), 42, 0.01);
    EXPECT_EQ(time().skipped, 0U);
}

// It becomes a lane of words.
TEST_F(Recording, AnItemThatIsFoundIsPlottedAlsoIfItIsAText) {
    MadeAgent settled{"far", [](SimplexTree& tree) { tree.add("/probe", "SettledProbe"); }};
    const std::shared_ptr<Frame> frame = test::frameOf({settled.now()});
    for (const auto& [item, lines] : {std::pair{"gain", 1U}, {"names", 2U}, {"gone", 0U}})
        EXPECT_EQ(plottedItems(*frame, "/probe", item).size(), lines) << item;
    EXPECT_TRUE(plottedItems(*frame, "/gone", "gain").empty());
}

TEST_F(Recording, CountsCyclesThatDidNotComeAndLeavesAGap) {
    recorder.record(this, {gain});
    hear();
    hear();
    agent.skip(700);
    hear();
    recorder.take();
    EXPECT_EQ(time().skipped, 700U);
    EXPECT_EQ(ring().nextMissing(1, 1'000), 3);
    EXPECT_EQ(ring().nextPresent(3, 1'000), 703);
}

// The first image of a line may be of a view at five images a second.
TEST_F(Recording, BeginsWhereEveryCycleComesAndNothingWasLostBefore) {
    recorder.record(this, {gain});
    hear();
    agent.skip(3);
    for (int i = 0; i < 5; ++i) hear();
    recorder.take();
    EXPECT_EQ(time().skipped, 0U);
    EXPECT_EQ(ring().begin(), 5);
    EXPECT_EQ(ring().end(), 10);
    EXPECT_EQ(ring().nextMissing(5, 10), 10);
}

TEST_F(Recording, ALineThatIsBadFromTheStartIsRecordedWithItsQuality) {
    recorder.record(this, {gain});
    agent.degrade("/probe", Quality::Bad);
    for (int i = 0; i < 3; ++i) hear();
    recorder.take();
    ASSERT_EQ(ring().end() - ring().begin(), 3);
    for (std::int64_t i = 1; i <= 3; ++i) {
        EXPECT_TRUE(std::isnan(ring().value(i)));
        EXPECT_EQ(ring().quality(i), static_cast<std::uint8_t>(Quality::Bad));
    }
}

// As of a process that was stopped: its cycles go on by one, and nobody lost any.
TEST_F(Recording, AStandstillOfTheAgentIsAGapOfItsLength) {
    recorder.record(this, {gain});
    for (int i = 0; i < 10; ++i) hear();
    agent.wait(3'000);
    for (int i = 0; i < 10; ++i) hear();
    recorder.take();
    EXPECT_EQ(time().skipped, 0U) << "no cycle was lost";
    const std::int64_t gap = ring().nextMissing(1, ring().end());
    const std::int64_t behind = ring().nextPresent(gap, ring().end());
    EXPECT_EQ(time().cycleAt(gap - 1), 10);
    EXPECT_EQ(time().cycleAt(behind), 11);
    EXPECT_EQ(time().table.utcAt(behind) - time().table.utcAt(gap - 1), 3'001 * MadeAgent::period);
    EXPECT_EQ(time().cycleAt(ring().end() - 1), 20);
    EXPECT_EQ(ring().nextMissing(behind, ring().end()), ring().end());
}

TEST_F(Recording, AStandstillOfHoursLeavesMostOfWhatWasBefore) {
    Recorder small{Ring::block};
    small.record(this, {gain});
    for (int i = 0; i < 10; ++i) small.hear("far", *agent.now().image);
    agent.wait(10'000'000);
    small.hear("far", *agent.now().image);
    small.take();
    EXPECT_EQ(small.ring(gain)->begin(), 1);
    EXPECT_LE(small.ring(gain)->end(), static_cast<std::int64_t>(Ring::block) / 5);
    EXPECT_EQ(small.time("far")->table.last() - small.time("far")->table.utcAt(10),
              10'000'001 * MadeAgent::period);
}

TEST_F(Recording, TicksThatABusyAgentMissesAreNoGap) {
    recorder.record(this, {gain});
    hear();
    for (int i = 0; i < 10; ++i) {
        hear();
        agent.wait(400);
        hear();
    }
    recorder.take();
    EXPECT_EQ(ring().end() - ring().begin(), 21);
    EXPECT_EQ(time().stretches.size(), 1U);
}

TEST_F(Recording, AValueOfACycleBeforeThatOfItsImageIsNotOfThisCycle) {
    recorder.record(this, {gain});
    agent.behind.assign(agent.structure->simplexes.size(), true);
    hear();
    recorder.take();
    EXPECT_EQ(recorder.ring(gain), nullptr);
    agent.behind.clear();
    hear();
    agent.behind.assign(agent.structure->simplexes.size(), true);
    hear();
    recorder.take();
    EXPECT_EQ(ring().begin(), 2);
    EXPECT_EQ(ring().end(), 3);
}

TEST_F(Recording, AValueThatIsNotGoodIsMissingButItsQualityIsKept) {
    recorder.record(this, {gain, state});
    hear();
    agent.degrade("/probe", Quality::Stale);
    hear();
    recorder.take();
    EXPECT_TRUE(std::isnan(ring().value(2)));
    EXPECT_EQ(ring().quality(2), static_cast<std::uint8_t>(Quality::Stale));
    EXPECT_EQ(recorder.ring(state)->value(2), 0) << "the framework writes the state always";
}

TEST_F(Recording, WhatNobodyShowsIsForgotten) {
    const int other = 0;
    recorder.record(this, {gain});
    recorder.record(&other, {gain, state});
    hear();
    recorder.take();
    EXPECT_EQ(recorder.viewed(), std::vector<std::string>{"/probe"});
    recorder.record(&other, {});
    EXPECT_NE(recorder.ring(gain), nullptr);
    EXPECT_EQ(recorder.ring(state), nullptr);
    recorder.record(this, {});
    EXPECT_EQ(recorder.ring(gain), nullptr);
    EXPECT_EQ(recorder.bytes(), 0U);
    EXPECT_TRUE(recorder.viewed().empty());
}

TEST_F(Recording, ForgetsTheOldestSamplesOfAllLinesWhereMemoryIsShort) {
    Recorder small{4 * Ring::block, 5 * Ring::block * Ring::bytesOfASample};
    small.record(this, {gain});
    EXPECT_FALSE(small.shortened());
    for (int i = 1; i <= 10; ++i) small.hear("far", *agent.now().image);
    small.take();
    small.record(this, {gain, state});
    EXPECT_TRUE(small.shortened());
    EXPECT_EQ(small.capacity(), 2 * Ring::block);
    EXPECT_EQ(small.ring(gain)->end() - small.ring(gain)->begin(), 10);
}

TEST_F(Recording, WhatTheWindowDoesNotFetchInTimeIsAGapThatIsCounted) {
    Recorder small{Ring::full, Recorder::usualLimit, 8};
    small.record(this, {gain, state});
    for (int i = 0; i < 6; ++i) small.hear("far", *agent.now().image);
    EXPECT_EQ(small.dropped(), 2U);
    small.take();
    small.hear("far", *agent.now().image);
    small.take();
    EXPECT_EQ(small.time("far")->skipped, 2U);
    EXPECT_TRUE(std::isnan(small.ring(gain)->value(6)));
    EXPECT_FALSE(std::isnan(small.ring(gain)->value(7)));
}

// A busy agent left periods out meanwhile.
TEST(TimeTable, IsTrueToEachSampleBehindAGap) {
    TimeTable table;
    const auto utcOf = [](std::int64_t index) {
        return MadeAgent::start + index * MadeAgent::period + (index < 500 ? 0 : 4'000'000);
    };
    for (std::int64_t i = 0; i < 1'000; ++i) {
        if (i < 100 || i >= 500) table.add(i, utcOf(i), MadeAgent::period);
    }
    for (std::int64_t i = 0; i < 1'000; ++i) {
        if (i >= 100 && i < 500) continue;
        EXPECT_LE(std::abs(table.utcAt(i) - utcOf(i)), MadeAgent::period / 5) << i;
    }
}

}  // namespace
}  // namespace cortex::gui
