// SPDX-License-Identifier: Apache-2.0
// Commands along a relationship to a simplex of another agent.
#include "cortex/core/error.hpp"
#include "cortex/core/loopback.hpp"
#include "cortex/core/mailbox.hpp"

#include "support/agent_rig.hpp"
#include "toolkit/allocation_counter.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::AgentRig;
using test::Hand;

// /boss of agent "near" commands /work of agent "away".
struct AgentCalls : testing::Test {
    LoopbackHub hub;
    std::unique_ptr<CommunicationInterface> nearInterface = hub.makeInterface();
    std::unique_ptr<CommunicationInterface> awayInterface = hub.makeInterface();
    AgentRig near{"near"}, away{"away"};
    Hand& boss = near.hand("/boss", "Boss");
    Hand& work = away.hand("/work");
    CommandSender add, poke, guard, set, startup;
    Data<double> amount, gain;
    Data<const double> sum;
    double total = 0;
    bool guarding = true;
    std::vector<Outcome> seen;  // by the boss, each cycle

    AgentCalls() {
        near.tree.relateRemote(boss, "peers", "/work");
        near.add(*nearInterface);
        away.add(*awayInterface);
        near.make();
        const InputSimplex peer = boss.input("peers");
        add = peer.command("add", 4);
        poke = peer.command("poke");
        guard = peer.command("guard");
        set = peer.command("set");
        startup = peer.command("startup");
        amount = add.argument<double>("amount");
        sum = add.response<double>("sum");
        gain = set.argument<double>("gain");
        away.make();
        const Argument<double> howMuch = work.argument<double>("add", "amount");
        const Result<double> all = work.result<double>("add", "sum");
        work.on("add", [this, howMuch, all](Call& call) {
            total += call[howMuch];
            call[all] = total;
            return Outcome::Done;
        });
        work.on("poke", [](Call& call) { return call.fail("it hurts"); });
        work.on("guard", [this](Call&) { return guarding ? Outcome::Running : Outcome::Done; });
    }
    void start() {
        near.start();
        away.start();
        step(2);
    }
    void step(int cycles = 1) {
        for (int i = 0; i < cycles; ++i) {
            near.step();
            hub.carry();
            away.step();
            hub.carry();
        }
    }
    // Of one cycle in which the boss sends.
    template <class Function>
    void inTask(Function function) {
        boss.run = function;
        near.step();
        boss.run = {};
        hub.carry();
        away.step();
        hub.carry();
    }
};

TEST_F(AgentCalls, AreExecutedThereAndAnsweredHere) {
    start();
    inTask([&] {
        amount = 2.5;
        add.send();
    });
    step();

    EXPECT_EQ(total, 2.5);
    EXPECT_EQ(add.answer().outcome, Outcome::Done);
    EXPECT_EQ(add.answer().latencyCycles, 1);
    EXPECT_EQ(static_cast<double>(sum), 2.5);
    EXPECT_TRUE(away.hasEvent("near@"));
}

TEST_F(AgentCalls, AreAnsweredInTheOrderOfSending) {
    start();
    inTask([&] {
        for (const double each : {1.0, 2.0, 3.0}) {
            amount = each;
            EXPECT_EQ(add.send(), Outcome::None);
        }
    });
    step();

    EXPECT_EQ(total, 6);
    EXPECT_EQ(add.answered(), 3U);
    EXPECT_EQ(static_cast<double>(sum), 6) << "the answer to the last one";
}

TEST_F(AgentCalls, SayWhyTheyFailed) {
    start();
    inTask([&] { poke.send(); });
    step();

    EXPECT_EQ(poke.answer().outcome, Outcome::Failed);
    EXPECT_EQ(poke.answer().why.view(), "it hurts");
    EXPECT_TRUE(near.hasEvent("/boss: poke to /work: Failed, it hurts"));
}

TEST_F(AgentCalls, AreCheckedByTheReceiver) {
    start();
    inTask([&] {
        amount = 1000;
        add.send();
    });
    step();

    EXPECT_EQ(total, 0);
    EXPECT_EQ(add.answer().outcome, Outcome::Rejected);
    EXPECT_EQ(add.answer().reason, Reason::Range);
}

TEST_F(AgentCalls, SetItemsOfTheOtherAgent) {
    start();
    inTask([&] {
        gain = 4;
        set.send();
    });
    step();

    EXPECT_EQ(set.answer().outcome, Outcome::Done);
    EXPECT_EQ(away.get<double>("/work", "gain"), 4);
    EXPECT_EQ(near.get<double>("/work", "gain"), 4) << "as it is linked";
}

TEST_F(AgentCalls, ThatRunAreAnsweredTwice) {
    start();
    inTask([&] { guard.send(); });
    step();
    EXPECT_EQ(guard.answer().outcome, Outcome::Running);

    inTask([&] { add.send(); });
    step();
    EXPECT_EQ(add.answer().outcome, Outcome::Done) << "it is not held up";
    EXPECT_EQ(guard.answer().outcome, Outcome::Running);

    guarding = false;
    step(2);
    EXPECT_EQ(guard.answer().outcome, Outcome::Done);
    EXPECT_GT(guard.answer().latencyCycles, 2);
}

TEST_F(AgentCalls, ToAnAgentThatIsNotHeardSurelyDoNotRun) {
    near.start();
    boss.run = [&] { add.send(); };
    near.step();
    boss.run = {};
    near.step();
    EXPECT_EQ(add.answer().outcome, Outcome::Expired);

    away.start();
    step(5);
    EXPECT_EQ(total, 0);
    EXPECT_TRUE(near.hasEvent("its agent is not heard: it was not sent"));
}

TEST_F(AgentCalls, OnTheirWayWhenTheAgentIsCutOffAreUnknown) {
    start();
    boss.run = [&] { add.send(); };
    near.step();
    boss.run = {};
    hub.carry();
    hub.setConnected("away", false);
    hub.carry();
    near.step(2);

    EXPECT_EQ(add.answer().outcome, Outcome::Unknown);
}

TEST_F(AgentCalls, AreNotMoreThanThereIsRoomFor) {
    start();
    inTask([&] {
        for (int i = 0; i < 200; ++i) {
            const Outcome sent = add.send();
            if (sent != Outcome::None) seen.push_back(sent);
        }
    });
    step(2);

    ASSERT_FALSE(seen.empty());
    EXPECT_EQ(seen.front(), Outcome::MailboxFull);
    EXPECT_EQ(total + static_cast<double>(seen.size()), 200) << "each either ran or was refused";
    EXPECT_EQ(add.answered() + seen.size(), 200U);
}

TEST_F(AgentCalls, AreCountedEachUnderCutsAndReturns) {
    start();
    int done = 0, unsure = 0, not_run = 0;
    std::uint64_t answered = 0;
    const auto count = [&] {
        if (add.answered() == answered) return;
        answered = add.answered();
        switch (add.answer().outcome) {
            case Outcome::Done:
                ++done;
                break;
            case Outcome::Unknown:
                ++unsure;
                break;
            default:
                ++not_run;
        }
    };
    boss.run = [&] {
        count();
        if (add.sent() == add.answered()) add.send();
    };
    for (int cut = 0; cut < 50; ++cut) {
        step(cut % 7);
        near.step();
        hub.setConnected("away", false);
        step(cut % 3);
        hub.setConnected("away", true);
        step(3);
    }
    boss.run = count;
    step(5);

    EXPECT_EQ(done + unsure + not_run, static_cast<int>(add.sent()));
    EXPECT_GT(done, 100);
    EXPECT_GT(unsure + not_run, 0);
    EXPECT_GE(total, done) << "what is Done ran";
    EXPECT_LE(total, done + unsure) << "nothing ran twice, and what expired did not run";
}

TEST_F(AgentCalls, TakeNoMemoryInTheTick) {
    start();
    std::uint64_t taken = 0;
    for (int i = 0; i < 20; ++i) {
        const std::uint64_t before = toolkit::test::allocationCount();
        near.begin();
        near.agent->processCommands(boss.index(), State::Active, near.agent->thread(0));
        amount = 2.0;
        add.send();
        poke.send();
        near.end();
        taken += toolkit::test::allocationCount() - before;
        hub.carry();
        away.step();
        hub.carry();
    }
    EXPECT_EQ(taken, 0U);
    EXPECT_GT(add.answered(), 10U);
}

TEST_F(AgentCalls, StartSimplexesOfTheOtherAgent) {
    start();
    boss.run = [&] { startup.send(); };
    near.step();
    boss.run = {};
    hub.carry();
    away.begin();
    EXPECT_EQ(away.agent->takeLifeCycle(work.index(), away.agent->thread(0)), LifeCycle::Startup);
    away.end();
}

// A startup takes long, and the boss pokes on with all that its lane holds. The worker's task does
// not run, so no poke is answered.
TEST(AgentCallLane, TakesAShutdownWhileItIsFullAndAStartupRuns) {
    LoopbackHub hub;
    const std::unique_ptr<CommunicationInterface> nearInterface = hub.makeInterface();
    const std::unique_ptr<CommunicationInterface> awayInterface = hub.makeInterface();
    AgentRig near{"near"}, away{"away"};
    Hand& boss = near.hand("/boss", "Boss");
    Hand& work = away.hand("/work");
    near.tree.relateRemote(boss, "peers", "/work");
    near.add(*nearInterface);
    away.add(*awayInterface);
    near.make();
    const InputSimplex peer = boss.input("peers");
    CommandSender poke = peer.command("poke", 4), startup = peer.command("startup", 1);
    CommandSender shutdown = peer.command("shutdown", 1), clear = peer.command("clearFaults", 1);
    near.start();
    away.start();
    const auto takeLifeCycle = [&] {
        return away.agent->takeLifeCycle(work.index(), away.agent->thread(0));
    };
    const auto cycle = [&](const std::function<void()>& task = {}) {
        boss.run = task;
        near.step();
        hub.carry();
        away.begin();
        const LifeCycle taken = takeLifeCycle();
        away.end();
        hub.carry();
        return taken;
    };
    away.setState(work, State::Standby);
    cycle();
    EXPECT_EQ(cycle([&] { startup.send(); }), LifeCycle::Startup);
    away.setState(work, State::StartingUp);
    cycle();
    cycle();
    EXPECT_EQ(startup.answer().outcome, Outcome::Running);
    EXPECT_EQ(startup.answered(), startup.sent()) << "it holds up nothing";

    const LifeCycle taken = cycle([&] {
        for (int i = 0; i < 4; ++i) EXPECT_EQ(poke.send(), Outcome::None);
        EXPECT_EQ(poke.send(), Outcome::MailboxFull);
        EXPECT_EQ(clear.send(), Outcome::None) << "life-cycle commands have places of their own";
        EXPECT_EQ(startup.send(), Outcome::None);
        EXPECT_EQ(startup.send(), Outcome::MailboxFull);
        EXPECT_EQ(shutdown.send(), Outcome::None) << "and a shutdown one that no other takes";
    });
    EXPECT_EQ(taken, LifeCycle::Shutdown);
}

}  // namespace
}  // namespace cortex
