// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_tables.hpp"

#include "cortex/comms/mirror.hpp"

#include "comms/told_agent.hpp"
#include "wire/simplex_values.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using namespace std::chrono_literals;

const MirrorView everything = viewOf({{{"/"}, 30}});
constexpr std::size_t every = 0, at30 = 2, at5 = 3;  // streams
const Moment begin{1h};

class MirrorTablesTest : public testing::Test {
protected:
    MirrorTablesTest() {
        PeerModel peer{agent.name(), agent.epoch()};
        tell(agent, peer);
        tables = std::make_shared<MirrorTables>(peer.structure(), agent.presence.structureHash,
                                                everything);
        worker = tables->structure().find("/work/one");
        reading = tables->structure().find("/reading");
    }

    Quality quality(std::uint32_t simplex) { return tables->newest().state(simplex).quality; }

    ToldAgent agent;
    std::shared_ptr<MirrorTables> tables;
    std::uint32_t worker = 0, reading = 0;
};

TEST_F(MirrorTablesTest, ShowsEveryValueAsItsOwnerHasIt) {
    agent.worker->data<std::string_view>("title") = "drill";
    agent.worker->array<double>("weights")[1] = -0.5;
    agent.worker->data<std::int64_t>("mode") = 2;
    agent.worker->data<bool>("on") = true;
    agent.rig.step();
    const Image theirs = agent.rig.agent->images().newest();

    ASSERT_TRUE(tables->apply(agent.block(1), at30, begin));

    const Image image = tables->newest();
    EXPECT_EQ(image.cycle(), theirs.cycle());
    EXPECT_EQ(image.nominalTime(), theirs.nominalTime());
    EXPECT_EQ(image.get<std::string_view>("/work/one", "title"), "drill");
    for (std::uint32_t i = 0; i < agent.presence.simplexes; ++i) {
        EXPECT_EQ(image.state(i), theirs.state(i));
        for (const ItemLayout& item : image.structure().simplexes[i].layout->items) {
            EXPECT_EQ(image.value(i, item),
                      theirs.value(image.structure().simplexes[i].path, item.item->name))
                << item.item->name;
        }
    }
}

TEST_F(MirrorTablesTest, CallsLostWhatHasNotCome) {
    EXPECT_EQ(quality(worker), Quality::Lost);
    EXPECT_FALSE(tables->received(worker));
    EXPECT_FALSE(tables->age(worker, begin));

    Block block = agent.block(1);
    std::erase_if(block.simplexes, [&](const auto& each) { return each.index == reading; });
    tables->apply(block, at30, begin);

    EXPECT_EQ(quality(worker), Quality::Good);
    EXPECT_EQ(quality(reading), Quality::Lost);
}

TEST_F(MirrorTablesTest, CallsStaleAfterAGapWhatHasNotComeAgain) {
    tables->apply(agent.block(1), at30, begin);
    agent.rig.step();
    Block block = agent.block(5);
    std::erase_if(block.simplexes, [&](const auto& each) { return each.index == reading; });

    tables->apply(block, at30, begin);

    EXPECT_EQ(tables->loss(), 3U);
    EXPECT_EQ(quality(worker), Quality::Good);
    EXPECT_EQ(quality(reading), Quality::Stale);
    agent.rig.step();
    tables->apply(agent.block(6), at30, begin);
    EXPECT_EQ(quality(reading), Quality::Good);
    EXPECT_EQ(tables->loss(), 3U);
}

TEST_F(MirrorTablesTest, CountsTheCyclesOfAViewOfEveryCycleThatNobodySent) {
    tables->restart(viewOf({{{"/"}, 0}}));
    tables->apply(agent.block(1), every, begin);
    agent.rig.step(4);

    tables->apply(agent.block(2), every, begin);  // the agent itself left three out
    EXPECT_EQ(tables->loss(), 3U);
    tables->apply(agent.block(3), every, begin);  // the same cycle, with other simplexes
    agent.rig.step(2);
    tables->apply(agent.block(6), every, begin);  // two blocks were lost, but one cycle
    EXPECT_EQ(tables->loss(), 4U);

    tables->restart(everything);
    tables->apply(agent.block(1), at30, begin);
    agent.rig.step(33);
    tables->apply(agent.block(2), at30, begin);
    EXPECT_EQ(tables->loss(), 4U) << "a slower view leaves cycles out";
}

TEST_F(MirrorTablesTest, ToleratesCyclesOfAViewOfEveryCycleThatCannotBe) {
    tables->restart(viewOf({{{"/"}, 0}}));
    Block block = agent.block(1);
    block.cycle = std::numeric_limits<std::int64_t>::min();
    tables->apply(block, every, begin);
    block.cycle = std::numeric_limits<std::int64_t>::max();

    tables->apply(block, every, begin);

    EXPECT_EQ(tables->loss(), std::numeric_limits<std::uint64_t>::max() - 1);
    EXPECT_TRUE(tables->apply(agent.block(2), every, begin));
}

TEST_F(MirrorTablesTest, SaysWhichValuesAreOfACycleBeforeThatOfTheImage) {
    tables->restart(viewOf({{{"/"}, 30}, {{"/work/one"}, 0}}));
    tables->apply(agent.block(1), at30, begin);
    EXPECT_FALSE(tables->behind()[worker]);
    agent.rig.step();
    Block block = agent.block(1);
    std::erase_if(block.simplexes, [&](const auto& each) { return each.index != worker; });

    tables->apply(block, every, begin);

    EXPECT_FALSE(tables->behind()[worker]);
    EXPECT_TRUE(tables->behind()[reading]);
}

TEST_F(MirrorTablesTest, CallsStaleWhatDoesNotComeInTime) {
    tables->apply(agent.block(1), at30, begin);
    constexpr std::int64_t period = 1'000'000;
    const auto patience = patienceOf(at30, period);
    EXPECT_EQ(patience, 100ms) << "three periods of 30 Hz";

    tables->markStale(begin + patience - 1ms, period);
    EXPECT_EQ(quality(worker), Quality::Good);
    tables->markStale(begin + patience, period);
    EXPECT_EQ(quality(worker), Quality::Stale);
    EXPECT_EQ(tables->newest().state(worker).cause, worker);
}

TEST_F(MirrorTablesTest, DoesNotTakeACycleThatIsSaidAgainForNews) {
    constexpr std::int64_t period = 1'000'000;
    const auto patience = patienceOf(at30, period);
    tables->apply(agent.block(1), at30, begin);

    tables->apply(agent.block(1), at30, begin + patience);
    tables->markStale(begin + patience, period);
    EXPECT_EQ(quality(worker), Quality::Stale);
    tables->apply(agent.block(1), at30, begin + patience);
    EXPECT_EQ(quality(worker), Quality::Stale);

    tables->lose();
    tables->apply(agent.block(1), at30, begin + patience);
    EXPECT_EQ(quality(worker), Quality::Good);
    EXPECT_EQ(tables->loss(), 0U);
}

TEST_F(MirrorTablesTest, CallsAllLostWithTheAgent) {
    tables->apply(agent.block(1), at30, begin);

    tables->lose();

    EXPECT_EQ(quality(worker), Quality::Lost);
    tables->apply(agent.block(2), at30, begin);
    EXPECT_EQ(quality(worker), Quality::Good);
}

TEST_F(MirrorTablesTest, MeasuresAgeFromTheMeasurementByTheReceiversClock) {
    Block block = agent.block(1);
    block.nominalTime = 5'000'000'000;
    for (SimplexData& each : block.simplexes) each.time = 4'750'000'000;

    tables->apply(block, at30, begin);

    EXPECT_DOUBLE_EQ(tables->age(worker, begin + 500ms).value_or(-1), 0.75);
}

TEST_F(MirrorTablesTest, WhatNoTaskWritesIsAsOldAsTheCycleThatCame) {
    Block block = agent.block(1);
    block.nominalTime = 900'000'000'000;
    for (SimplexData& each : block.simplexes) each.cycle = each.time = 0;

    tables->apply(block, at30, begin);

    EXPECT_DOUBLE_EQ(tables->age(worker, begin + 500ms).value_or(-1), 0.5);
}

TEST_F(MirrorTablesTest, AppliesASimplexWholeOrNotAtAll) {
    using Fault = std::function<void(SimplexData&)>;
    const std::vector<Fault> faults{
        [](SimplexData& data) { data.floats.pop_back(); },
        [](SimplexData& data) { data.ints.push_back(1); },
        [](SimplexData& data) { data.bools.clear(); },
        [](SimplexData& data) { data.strings.emplace_back("more"); },
        [](SimplexData& data) { data.strings.front() = std::string(3000, 'x'); },
        [](SimplexData& data) { data.quality = 4; },
        [](SimplexData& data) { data.index = 0xffffffffU; }};
    agent.worker->data<double>("gain") = 7.0;
    agent.rig.step();
    for (const Fault& fault : faults) {
        Block block = agent.block(1);
        const std::uint64_t refused = tables->refused();
        fault(block.simplexes[worker]);
        EXPECT_TRUE(tables->apply(block, at30, begin));
        EXPECT_EQ(tables->refused(), refused + 1);
        EXPECT_EQ(quality(worker), Quality::Lost);
        EXPECT_EQ(tables->newest().get<double>("/work/one", "gain"), 1.0);
        EXPECT_EQ(quality(reading), Quality::Good);
    }
}

TEST_F(MirrorTablesTest, RefusesValuesOfASimplexOfAnotherAgent) {
    Block block = agent.block(1);
    const std::uint32_t far = tables->structure().find("/far/plate");
    readValues(far, *tables->structure().simplexes[far].layout, tables->newest().slice(far),
               block.simplexes.emplace_back());
    block.simplexes.back().quality = 0;

    tables->apply(block, at30, begin);

    EXPECT_EQ(tables->refused(), 1U);
    EXPECT_EQ(quality(far), Quality::Lost);
}

TEST_F(MirrorTablesTest, RefusesBlocksOfAnotherStartOrStructure) {
    Block block = agent.block(1);
    ++block.epoch;
    EXPECT_FALSE(tables->apply(block, at30, begin));
    block = agent.block(1);
    block.structureHash[0] ^= 1U;
    EXPECT_FALSE(tables->apply(block, at30, begin));
    EXPECT_EQ(quality(worker), Quality::Lost);
    EXPECT_EQ(tables->refused(), 2U);
}

TEST_F(MirrorTablesTest, ToleratesNumbersThatCannotBe) {
    Block block = agent.block(1);
    block.nominalTime = std::numeric_limits<std::int64_t>::max();
    block.simplexes[worker].time = -(std::int64_t{1} << 60) + 1;  // beyond it refused
    block.simplexes[worker].cause = 4'000'000;

    EXPECT_TRUE(tables->apply(block, at30, begin));

    EXPECT_EQ(tables->newest().state(worker).cause, noSimplex);
    block.sequenceNumber = std::numeric_limits<std::uint64_t>::max();
    EXPECT_TRUE(tables->apply(block, at30, begin));
}

TEST_F(MirrorTablesTest, LosesWithAnotherViewWhatIsNoLongerShown) {
    tables->apply(agent.block(7), at30, begin);

    tables->restart(viewOf({{{"/work"}, 5}}));

    EXPECT_EQ(quality(worker), Quality::Good);
    EXPECT_EQ(quality(reading), Quality::Lost);
    tables->apply(agent.block(1), at5, begin);
    EXPECT_EQ(tables->loss(), 0U) << "its numbers are of another stream";
}

// The reading is viewed five times a second, everything else thirty times.
class MirrorTablesOfTwoStreams : public MirrorTablesTest {
protected:
    MirrorTablesOfTwoStreams() {
        tables->restart(viewOf({{{"/"}, 30}, {{"/reading"}, 5}}));  // "/" covers it
        EXPECT_TRUE(tables->apply(agent.block(1), at30, begin));
        EXPECT_EQ(quality(reading), Quality::Good) << "the faster one of two";
        tables->restart(viewOf({{{"/work"}, 30}, {{"/reading"}, 5}}));
        tables->apply(agent.block(1), at30, begin);
        tables->apply(agent.block(1), at5, begin);
    }

    static constexpr std::int64_t period = 1'000'000;
};

TEST_F(MirrorTablesOfTwoStreams, CallsStaleEachSimplexAtItsOwnRate) {
    tables->markStale(begin + patienceOf(at30, period), period);
    EXPECT_EQ(quality(worker), Quality::Stale);
    EXPECT_EQ(quality(reading), Quality::Good);
    tables->markStale(begin + patienceOf(at5, period) - 1ns, period);
    EXPECT_EQ(quality(reading), Quality::Good);
    tables->markStale(begin + patienceOf(at5, period), period);
    EXPECT_EQ(quality(reading), Quality::Stale);
}

TEST_F(MirrorTablesOfTwoStreams, TakesEachSimplexFromItsOwnStream) {
    agent.worker->data<double>("gain") = 7.0;
    agent.rig.step();
    tables->apply(agent.block(2), at5, begin);
    EXPECT_EQ(tables->newest().get<double>("/work/one", "gain"), 1.0);

    tables->apply(agent.block(2), at30, begin);

    EXPECT_EQ(tables->newest().get<double>("/work/one", "gain"), 7.0);
}

TEST_F(MirrorTablesOfTwoStreams, CountsTheNumbersOfEachStreamByThemselves) {
    tables->apply(agent.block(2), at30, begin);
    tables->apply(agent.block(3), at30, begin);
    tables->apply(agent.block(2), at5, begin);
    EXPECT_EQ(tables->loss(), 0U);

    Block block = agent.block(5);
    block.simplexes.clear();
    tables->apply(block, at30, begin);

    EXPECT_EQ(tables->loss(), 1U);
    EXPECT_EQ(quality(worker), Quality::Stale);
    EXPECT_EQ(quality(reading), Quality::Good) << "the gap was in the other stream";
}

TEST_F(MirrorTablesOfTwoStreams, TakesTheOldStreamUntilTheNewOneHasCome) {
    tables->restart(viewOf({{{"/work"}, 5}, {{"/reading"}, 5}}));
    tables->markStale(begin + patienceOf(at30, period), period);
    EXPECT_EQ(quality(worker), Quality::Good);
    agent.worker->data<double>("gain") = 7.0;
    agent.rig.step();

    tables->apply(agent.block(2), at30, begin);
    EXPECT_EQ(tables->newest().get<double>("/work/one", "gain"), 7.0);
    agent.worker->data<double>("gain") = 8.0;
    agent.rig.step();
    tables->apply(agent.block(1), at5, begin);
    EXPECT_EQ(tables->newest().get<double>("/work/one", "gain"), 8.0);
    agent.worker->data<double>("gain") = 9.0;
    agent.rig.step();
    tables->apply(agent.block(3), at30, begin);
    EXPECT_EQ(tables->newest().get<double>("/work/one", "gain"), 8.0);
}

TEST_F(MirrorTablesOfTwoStreams, KeepTheCycleOfTheFastestAlsoWhereAViewBeginsAnew) {
    const std::int64_t before = tables->newest().cycle();
    tables->restart(viewOf({{{"/work"}, 30}, {{"/reading", "/rig"}, 5}}));
    agent.rig.step();

    tables->apply(agent.block(2), at5, begin);
    EXPECT_EQ(tables->newest().cycle(), before) << "the values of /work are of that cycle";

    tables->apply(agent.block(2), at30, begin);
    EXPECT_GT(tables->newest().cycle(), before);
}

TEST_F(MirrorTablesTest, DoNotGoBackToTheKeptCyclesOfAYoungAgent) {
    const Block kept = agent.block(1);
    agent.rig.step();
    tables->restart(viewOf({{{"/work"}, 0}, {{"/"}, 5}}));
    ASSERT_TRUE(tables->apply(agent.block(1), at5, begin));
    const std::int64_t before = tables->newest().cycle();
    ASSERT_LT(before, 32);

    tables->apply(kept, every, begin);
    EXPECT_EQ(tables->newest().cycle(), before);
}

// On a busy machine the first blocks of every cycle take their time.
TEST_F(MirrorTablesTest, DoNotGoBackToCyclesThatWereLongOnTheirWay) {
    const Block late = agent.block(1);
    for (int i = 0; i < 100; ++i) agent.rig.step();
    tables->restart(viewOf({{{"/work"}, 0}, {{"/"}, 5}}));
    ASSERT_TRUE(tables->apply(agent.block(1), at5, begin));
    const std::int64_t before = tables->newest().cycle();
    ASSERT_GT(before, late.cycle + 32);

    tables->apply(late, every, begin);
    EXPECT_EQ(tables->newest().cycle(), before);
}

TEST(MirrorView, LeavesOutWhatAFasterOneCovers) {
    const MirrorView view = viewOf({{{"/", "/arm/axis"}, 5}, {{"/arm"}, 0}, {{"/arm"}, 30}});

    EXPECT_EQ(view.prefixes, (MirrorView{{{{"/arm"}, {}, {}, {"/"}}}}.prefixes));
    EXPECT_EQ(view.streamOf("/arm/axis"), every);
    EXPECT_EQ(view.streamOf("/hand"), at5);
    EXPECT_EQ(viewOf({{{"/arm"}, 0}}).streamOf("/hand"), std::nullopt);
}

TEST_F(MirrorTablesTest, KeepsAnImageWhenTheTablesAreReplaced) {
    agent.worker->data<double>("gain") = 3.0;
    agent.rig.step();
    tables->apply(agent.block(1), at30, begin);
    AgentImage image{tables, tables->newest(), {}};
    const std::weak_ptr<MirrorTables> watched = tables;

    tables.reset();

    EXPECT_EQ(image->get<double>("/work/one", "gain"), 3.0);
    image = {};
    EXPECT_TRUE(watched.expired());
}

TEST(MirrorView, TakesTheStreamThatIsFastEnough) {
    EXPECT_EQ(viewRates.at(streamFor(1)), 5U);
    EXPECT_EQ(viewRates.at(streamFor(5)), 5U);
    EXPECT_EQ(viewRates.at(streamFor(6)), 30U);
    EXPECT_EQ(viewRates.at(streamFor(31)), 100U);
    EXPECT_EQ(viewRates.at(streamFor(101)), 0U);
    EXPECT_EQ(viewRates.at(streamFor(0)), 0U);
}

}  // namespace
}  // namespace cortex::comms
