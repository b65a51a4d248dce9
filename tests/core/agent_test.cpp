// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"

#include "cortex/core/error.hpp"

#include "support/agent_rig.hpp"
#include "toolkit/allocation_counter.hpp"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::AgentRig;
using test::Hand;

TEST(Agent, HasASimplexOfItsOwn) {
    AgentRig rig;
    rig.start();

    EXPECT_EQ(rig.agent->structure().simplexes[rig.agent->agentSimplex()].path, "/rig");
    EXPECT_TRUE(rig.tree.at("/rig").type().isA("Agent"));
    EXPECT_EQ(rig.agent->name(), "rig");
}

TEST(Agent, WithoutItsTypeSaysWhatToInclude) {
    Report report;
    SimplexTree tree{TypeModel::build({}, report)};
    try {
        AgentRuntime agent{"a", tree, {}};
        FAIL();
    } catch (const ModelError& error) {
        ASSERT_EQ(error.report().findings.size(), 1U);
        EXPECT_EQ(error.report().findings[0].rule, "agent-type");
        EXPECT_EQ(error.report().findings[0].remedy, "include base.xml");
    }
}

TEST(Agent, WhosePathIsTakenByAnotherTypeIsRefused) {
    SimplexTree tree{test::commandTypes()};
    tree.add("/a", "Plate");
    EXPECT_THROW((AgentRuntime{"a", tree, {}}), ModelError);
}

TEST(Agent, NameMustBeThatOfAPath) {
    SimplexTree tree{test::commandTypes()};
    EXPECT_THROW((AgentRuntime{"a b", tree, {}}), Error);
}

TEST(Agent, WithAnInvalidModelThrowsTheWholeReport) {
    SimplexTree tree{test::commandTypes()};
    tree.add("/plate", "Plate").set("level", 99.0);
    tree.add("/plate2", "Plate").set("level", 99.0);
    try {
        AgentRuntime agent{"a", tree, {}};
        FAIL();
    } catch (const ModelError& error) {
        EXPECT_EQ(error.report().errors(), 2U);
    }
}

TEST(Agent, StartsOnceAndStopsOnce) {
    AgentRig rig;
    rig.start();
    EXPECT_THROW(rig.agent->start(), Error);
    rig.agent->stop();
    rig.agent->stop();
    EXPECT_TRUE(rig.outside.closed);
}

TEST(Agent, GatewayOfDescriptiveSimplexesRunsItsOwnCycles) {
    AgentRig rig;
    Simplex& plate = rig.tree.add("/plate", "Plate");
    rig.start();
    rig.begin();
    plate.data<double>("level") = 2;
    rig.end();
    rig.outside.send(
        {.path = "/plate", .command = "set", .arguments = {{"level", Value{std::vector{3.0}}}}});
    EXPECT_EQ(rig.get<double>("/plate", "level"), 2);
    rig.step();

    EXPECT_EQ(rig.get<double>("/plate", "level"), 3);
    EXPECT_EQ(rig.agent->images().newest().cycle(), 2);
    EXPECT_EQ(rig.outside.last().outcome, Outcome::Done);
}

TEST(Agent, LongCommandOfItsOwnSimplexRunsAtTheBeginOfCycles) {
    AgentRig rig;
    rig.tree.add("/rig", "Cluster");
    rig.make();
    int calls = 0;
    rig.agent->registerHandler(rig.agent->agentSimplex(), "startup",
                               {&calls, [](void* count, Call&) {
                                    return ++*static_cast<int*>(count) < 3 ? Outcome::Running
                                                                           : Outcome::Done;
                                }});
    rig.start();
    rig.outside.send({.path = "/rig", .command = "startup"});
    rig.step(3);

    EXPECT_EQ(calls, 3);
    EXPECT_EQ(rig.outside.last().outcome, Outcome::Done);
}

TEST(Agent, HandlerOfItsOwnSimplexThatThrowsIsAnEventAndTheLoopGoesOn) {
    AgentRig rig;
    rig.tree.add("/rig", "Cluster");
    rig.make();
    rig.agent->registerHandler(
        rig.agent->agentSimplex(), "startup",
        {nullptr, [](void*, Call&) -> Outcome { throw std::runtime_error("boom"); }});
    rig.start();
    rig.outside.send({.path = "/rig", .command = "startup"});
    rig.step(2);

    EXPECT_EQ(rig.outside.last().outcome, Outcome::Failed);
    EXPECT_TRUE(rig.hasEvent("/rig: a command handler threw"));
}

TEST(Agent, PendingLifeCycleWordIsNeverFullAndShutdownOutranks) {
    AgentRig rig;
    const Hand& worker = rig.hand("/worker");
    rig.start();
    AgentRuntime& agent = *rig.agent;
    EXPECT_EQ(agent.takeLifeCycle(worker.index(), agent.thread(0)), LifeCycle::None);
    for (int i = 0; i < 1000; ++i) agent.postLifeCycle(worker.index(), LifeCycle::Startup, false);
    EXPECT_EQ(agent.takeLifeCycle(worker.index(), agent.thread(0)), LifeCycle::Startup);
    EXPECT_EQ(agent.takeLifeCycle(worker.index(), agent.thread(0)), LifeCycle::None);

    agent.postLifeCycle(worker.index(), LifeCycle::Shutdown, false);
    agent.postLifeCycle(worker.index(), LifeCycle::Startup, false);
    EXPECT_EQ(agent.takeLifeCycle(worker.index(), agent.thread(0)), LifeCycle::Shutdown);
    EXPECT_EQ(agent.takeLifeCycle(worker.index(), agent.thread(0)), LifeCycle::None);

    agent.postLifeCycle(worker.index(), LifeCycle::ClearFaults, false);
    EXPECT_EQ(agent.takeLifeCycle(worker.index(), agent.thread(0)), LifeCycle::ClearFaults);
}

TEST(Agent, LaterLifeCycleWordIsSeenFromTheNextCycleOn) {
    AgentRig rig;
    const Hand& worker = rig.hand("/worker");
    rig.start();
    rig.step();
    rig.agent->postLifeCycle(worker.index(), LifeCycle::Startup, true);
    EXPECT_EQ(rig.agent->takeLifeCycle(worker.index(), rig.agent->thread(0)), LifeCycle::None);
    rig.step();

    EXPECT_EQ(rig.agent->takeLifeCycle(worker.index(), rig.agent->thread(0)), LifeCycle::Startup);
}

TEST(Agent, EventsOfACycleStandInCanonicalOrderBeginTasksEnd) {
    AgentRig rig;
    Hand& first = rig.hand("/a");
    Hand& second = rig.hand("/b");
    rig.order = {"/b", "/a"};
    rig.start();
    const auto post = [&](const Hand& hand, const char* text) {
        rig.agent->post(rig.agent->thread(0), Severity::Info, EventKind::Message, hand.index(),
                        text);
    };
    rig.begin();
    post(first, "task");
    post(second, "task");
    rig.end();
    rig.outside.atRead([&](Inbox& inbox) {
        inbox.event(Severity::Info, EventKind::Message, first.index(), "read");
    });
    rig.begin();
    post(first, "task");
    rig.end();

    EXPECT_EQ(rig.events(),
              (std::vector<std::string>{"/b: task", "/a: task", "/a: read", "/a: task"}));
}

TEST(Agent, EventsAfterTheLastCycleStandBehindThoseOfIt) {
    AgentRig rig;
    Hand& first = rig.hand("/a");
    Hand& second = rig.hand("/b");
    rig.start();
    const auto post = [&](const Hand& hand, const char* text) {
        rig.agent->post(rig.agent->thread(0), Severity::Info, EventKind::Message, hand.index(),
                        text);
    };
    rig.begin();
    post(second, "task");
    rig.end();
    post(first, "afterwards");
    rig.agent->stop();

    EXPECT_EQ(rig.events(), (std::vector<std::string>{"/b: task", "/a: afterwards"}));
}

// The whole path of commands: along relationships, from outside, refused, long, set, life cycle.
TEST(Agent, AllocatesNothingAfterStart) {
    AgentRig rig;
    Hand& boss = rig.hand("/boss", "Boss");
    Hand& worker = rig.hand("/worker");
    rig.tree.relate(boss, "workers", worker);
    ProgramInterface program;
    rig.add(program);
    rig.make();
    auto add = boss.output("workers").command("add");
    auto work = boss.output("workers").command("work");
    auto set = boss.output("workers").command("set");
    set.argument<double>("gain") = 3;
    int calls = 0;
    worker.on("add", [](Call&) { return Outcome::Done; });
    worker.on("work", [&](Call& call) {
        return ++calls % 3 == 0 ? call.fail("every third") : Outcome::Running;
    });
    rig.start();
    boss.run = [&] {
        for (int i = 0; i < 20; ++i) add.send();
        work.send();
        set.send();
    };
    rig.step(10);
    for (int i = 0; i < 20; ++i) program.post("/worker", i % 2 == 0 ? "add" : "shutdown");
    program.post("/rig", "takeControl", {{"prefix", Value{std::vector<std::string>{"/"}}}});

    const std::uint64_t before = toolkit::test::allocationCount();
    for (int i = 0; i < 50; ++i) {
        rig.begin();
        for (Hand* hand : {&boss, &worker}) {
            rig.agent->processCommands(hand->index(), State::Active, rig.agent->thread(0));
            if (hand->run) hand->run();
        }
        rig.end();
    }

    EXPECT_EQ(toolkit::test::allocationCount(), before);
    EXPECT_GT(rig.agent->thread(0).commands, 100U);
    rig.agent->stop();
}

}  // namespace
}  // namespace cortex
