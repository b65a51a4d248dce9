// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_value_watch.hpp"

#include "cortex/core/event_memory.hpp"
#include "cortex/core/framework_item.hpp"

#include "comms/network_agent.hpp"
#include "toolkit/allocation_counter.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

constexpr std::int64_t lookTime = 200'000'000;  // ns from one look to the next
constexpr std::uint32_t switches = 32;

using Texts = std::vector<std::string>;

// Readings have 32 switches, and three constant ones.
TypeModel watchedTypes() {
    return changedTypes("Reading", [](DataItem& item) {
        if (item.name == "on") {
            item.length = switches;
            item.initial = std::vector<bool>(switches);
            item.safe = {Safe::Kind::Given, item.initial};
        }
        if (item.name == "origin") {
            item.kind = Kind::Bool;
            item.initial = std::vector<bool>(item.length);
        }
    });
}

// An agent that is looked at every 200 ms.
struct Watching {
    Watching() {
        for (int i = 0; i < 300; ++i) rig.tree.add("/plates/" + std::to_string(1'000 + i), "Plate");
        test::Hand& boss = rig.hand("/boss", "Boss");
        rig.tree.relateRemote(boss, "plates", "/far/plate");
        rig.start();
        self = std::make_unique<AgentSelf>(rig.outside.access);
        watch = std::make_unique<AgentValueWatch>(*self);
    }
    SlotState& slot(const std::string& path) {
        return *rig.agent->tables().live(rig.agent->structure().find(path)).state;
    }
    void cycle() {
        rig.begin();
        rig.runTasks();
        rig.agent->endCycle(rig.tick, 5'000 + rig.tick.cycle);
    }
    void look() {
        cycle();
        lookAgain();
    }
    void lookAgain() { watch->step(now += lookTime); }
    // What came since it was asked last.
    std::vector<KeptEvent> kept() {
        auto events = rig.outside.access.memory->page(place_).events;
        std::erase_if(events, [](const auto& each) { return each.kind != EventKind::ValueChange; });
        if (!events.empty()) place_ = events.back().place;
        return events;
    }
    Texts texts() {
        Texts all;
        for (const KeptEvent& each : kept()) {
            const bool isWarning = each.severity == Severity::Warning;
            all.push_back((isWarning ? "warning " : "") + each.path + " " + each.text);
        }
        return all;
    }

    test::AgentRig rig{watchedTypes(), "rig"};
    test::Hand& worker = rig.hand("/worker");
    Simplex& reading = rig.tree.add("/reading", "Reading");
    std::unique_ptr<AgentSelf> self;
    std::unique_ptr<AgentValueWatch> watch;
    std::int64_t now = 1'000'000'000'000;

private:
    std::uint64_t place_ = 0;
};

struct AgentValueWatchTest : testing::Test, Watching {};

TEST_F(AgentValueWatchTest, TellsNothingOfTheFirstImage) {
    slot("/plates/1000").quality = Quality::Lost;
    worker.data<double>("gain") = 11.0;
    worker.data<bool>("on") = true;
    worker.data<std::int64_t>("mode") = 2;
    look();
    EXPECT_EQ(texts(), Texts{});
    look();
    EXPECT_EQ(texts(), Texts{}) << "it is as it was";
}

TEST_F(AgentValueWatchTest, TellsTheQualityWithItsFirstCause) {
    look();
    slot("/reading") = {1, 0, rig.agent->structure().find("/far/plate"), Quality::Lost};
    slot("/plates/1001") = {1, 0, rig.agent->structure().find("/plates/1001"), Quality::Stale};
    look();
    EXPECT_EQ(texts(), (Texts{"/plates/1001 is stale, was good",
                              "warning /reading is lost, was good: first cause /far/plate"}));
    slot("/reading").quality = Quality::Bad;
    slot("/plates/1001").quality = Quality::Good;
    look();
    EXPECT_EQ(texts(), (Texts{"/plates/1001 is good, was stale",
                              "/reading is bad, was lost: first cause /far/plate"}));
}

TEST_F(AgentValueWatchTest, TellsWhenAndInWhichStartItWas) {
    look();
    worker.data<bool>("on") = true;
    look();
    const auto events = kept();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].epoch, rig.agent->structure().epoch);
    EXPECT_EQ(events[0].number, 0U);
    EXPECT_EQ(events[0].cycle, 2);
    EXPECT_EQ(events[0].wallClock, 5'002);
}

TEST_F(AgentValueWatchTest, TellsAValueOutsideItsLimitsAndWithinThemAgain) {
    look();
    worker.data<double>("gain") = 10.25;
    worker.array<double>("weights")[1] = -2;
    look();
    EXPECT_EQ(texts(), (Texts{"warning /worker gain is outside its limits: 10.25 m",
                              "warning /worker weights[1] is outside its limits: -2"}));
    worker.data<double>("gain") = 12.0;
    worker.array<double>("weights")[2] = 2;
    look();
    EXPECT_EQ(texts(), Texts{"warning /worker weights[2] is outside its limits: 2"});
    worker.data<double>("gain") = 10.0;
    look();
    EXPECT_EQ(texts(), Texts{"/worker gain is within its limits"});
    worker.data<double>("gain") = 10.000'000'01;
    look();
    EXPECT_EQ(texts(), Texts{"warning /worker gain is outside its limits: 10.00000001 m"});
}

TEST_F(AgentValueWatchTest, JudgesNoLimitsOfWhatIsNotGood) {
    look();
    slot("/worker").quality = Quality::Stale;
    worker.data<double>("gain") = 11.0;
    look();
    EXPECT_EQ(texts(), Texts{"/worker is stale, was good"});
    slot("/worker").quality = Quality::Good;
    look();
    EXPECT_EQ(texts(), (Texts{"/worker is good, was stale",
                              "warning /worker gain is outside its limits: 11 m"}));
}

TEST_F(AgentValueWatchTest, TellsLabelsAndSwitches) {
    look();
    worker.data<std::int64_t>("mode") = 2;
    worker.data<bool>("on") = true;
    look();
    EXPECT_EQ(texts(), (Texts{"/worker mode is Hold, was Idle", "/worker on is true, was false"}));
    worker.data<std::int64_t>("mode") = 7;
    look();
    EXPECT_EQ(texts(), Texts{"warning /worker mode is 7, which is none of its labels, was Hold"});
    worker.data<std::int64_t>("mode") = 1;
    look();
    EXPECT_EQ(texts(), Texts{"/worker mode is Jog, was 7"});
}

TEST_F(AgentValueWatchTest, NamesTheElementsOfAnArrayUnlessTheyAreMany) {
    look();
    reading.array<bool>("on")[3] = true;
    look();
    EXPECT_EQ(texts(), Texts{"/reading on[3] is true, was false"});
    for (std::uint32_t i = 0; i < switches; ++i) reading.array<bool>("on")[i] = i != 3;
    look();
    EXPECT_EQ(texts(), Texts{"/reading on[0] is true, was false; on[1] is true, was false; on[2] "
                             "is true, was false, and 29 changes that are not kept"});
}

TEST_F(AgentValueWatchTest, TellsNothingOfPlainValuesOfTheFrameworksAndOfOtherAgents) {
    look();
    reading.data<double>("a") = 1e9;
    reading.data<std::int64_t>("count") = 7;
    worker.data<double>("progress") = 0.5;
    rig.setState(worker, State::Fault);
    frameworkItem<std::int64_t>(*rig.agent, worker.index(), "outcome") = 2;
    rig.begin();
    SlotState& far = slot("/far/plate");
    far.quality = far.quality == Quality::Good ? Quality::Bad : Quality::Good;
    rig.end();
    lookAgain();
    EXPECT_EQ(texts(), Texts{});
}

TEST_F(AgentValueWatchTest, TellsTenTogglesThenOneEachSecondAndHowManyItLeavesOut) {
    look();
    Texts told;
    for (int i = 0; i < 30; ++i) {  // 6 s
        worker.data<bool>("on") = i % 2 == 0;
        look();
        std::ranges::move(texts(), std::back_inserter(told));
    }
    ASSERT_EQ(told.size(), 15U);
    EXPECT_EQ(told[10], "/worker on is true, was false");
    EXPECT_EQ(told[11], "/worker on is false, was true") << "one came with each second";
    EXPECT_EQ(told[12], "/worker on is false, and 4 changes that are not kept");
    EXPECT_EQ(told[13], "/worker on is true, was false, and 4 changes that are not kept");
    EXPECT_EQ(told[14], "/worker on is false, was true, and 4 changes that are not kept");

    worker.data<bool>("on") = true;
    look();
    texts();
    worker.data<bool>("on") = false;
    look();
    EXPECT_EQ(texts(), Texts{});
    for (int i = 0; i < 5; ++i) lookAgain();
    EXPECT_EQ(texts(), Texts{"/worker on is false, was true"}) << "though the loop stands still";
    for (int i = 0; i < 50; ++i) look();
    EXPECT_EQ(texts(), Texts{});
}

TEST_F(AgentValueWatchTest, TellsOfAnArrayThatItIsAsItWas) {
    look();
    const auto on = reading.array<bool>("on");
    for (int i = 0; i < 12; ++i) {
        on[0] = i % 2 == 0;
        look();
    }
    texts();
    on[1] = true;
    look();
    on[1] = false;
    for (int i = 0; i < 10; ++i) look();
    EXPECT_EQ(texts(), Texts{"/reading on is as it was, and 2 changes that are not kept"});
}

TEST_F(AgentValueWatchTest, KeepsAFloodOfQualitiesSmallAndOtherValuesBesideIt) {
    look();
    for (int i = 0; i < 300; ++i)
        slot("/plates/" + std::to_string(1'000 + i)).quality = Quality::Lost;
    worker.data<bool>("on") = true;
    look();
    const Texts told = texts();
    ASSERT_EQ(told.size(), 252U);
    EXPECT_EQ(told[0], "warning /plates/1000 is lost, was good");
    EXPECT_EQ(told[249], "warning /plates/1249 is lost, was good");
    EXPECT_EQ(told[250], "/worker on is true, was false");
    EXPECT_EQ(told[251], "/rig 50 changes of values are not kept: too much changed at once");
    for (int i = 0; i < 10; ++i) look();
    EXPECT_EQ(texts(), Texts{}) << "later they would have a wrong time";
}

TEST_F(AgentValueWatchTest, LooksAgainAtOnceWhereNoImageCouldBeHad) {
    look();
    worker.data<bool>("on") = true;
    std::vector<Image> held;
    for (Image image = rig.agent->images().newest(); image; image = rig.agent->images().newest())
        held.push_back(std::move(image));
    look();
    EXPECT_EQ(texts(), Texts{});
    held.clear();
    watch->step(now + 1);
    EXPECT_EQ(texts(), Texts{"/worker on is true, was false"});
}

TEST_F(AgentValueWatchTest, LooksFiveTimesASecondAndAllocatesNothingWhereNothingChanges) {
    look();
    worker.data<bool>("on") = true;
    rig.step();
    watch->step(now + lookTime / 2 - 1);
    EXPECT_EQ(texts(), Texts{});
    worker.data<bool>("on") = false;
    std::uint64_t allocated = 0;
    for (int i = 0; i < 100; ++i) {
        reading.data<double>("a") = i;
        cycle();
        const std::uint64_t before = toolkit::test::allocationCount();
        lookAgain();
        allocated += toolkit::test::allocationCount() - before;
    }
    EXPECT_EQ(allocated, 0U);
    EXPECT_EQ(texts(), Texts{});
}

TEST(AgentValueWatchRuns, TellTheSame) {
    Watching one, other;
    for (Watching* each : {&one, &other}) {
        for (int i = 0; i < 60; ++i) {
            each->worker.data<std::int64_t>("mode") = i * i % 5;
            each->reading.array<bool>("on")[static_cast<std::uint32_t>(i) % switches] = i % 3 == 0;
            each->worker.data<double>("gain") = i % 7 * 2.0;
            each->slot("/plates/1007").quality = i % 4 == 1 ? Quality::Bad : Quality::Good;
            each->look();
        }
    }
    const Texts told = one.texts();
    EXPECT_GT(told.size(), 50U);
    EXPECT_EQ(told, other.texts());
}

}  // namespace
}  // namespace cortex::comms
