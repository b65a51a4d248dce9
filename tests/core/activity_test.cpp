// SPDX-License-Identifier: Apache-2.0
#include "support/agent_rig.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::AgentRig;
using test::Hand;

// /boss sends long commands to /worker along an output.
struct Activity : testing::Test {
    AgentRig rig;
    Hand& boss = rig.hand("/boss", "Boss");
    Hand& worker = rig.hand("/worker");
    CommandSender work, rework, watch, cancel;
    std::string calls;  // one letter a call: f first, again, c cancelling
    Outcome next = Outcome::Running;
    Result<std::int64_t> result;
    Data<double> progress;

    void SetUp() override {
        rig.tree.relate(boss, "workers", worker);
        rig.make();
        auto output = boss.output("workers");
        work = output.command("work");
        rework = output.command("rework");
        watch = output.command("watch");
        cancel = output.command("cancel");
        result = worker.result<std::int64_t>("work", "result");
        progress = worker.data<double>("progress");
        for (const char* name : {"work", "rework", "watch"}) {
            worker.on(name, [this](Call& call) {
                calls += call.cancelling() ? 'c' : call.first() ? 'f' : 'a';
                return next;
            });
        }
        rig.start();
    }
    void sendInNextCycle(CommandSender& sender) {
        boss.run = [this, &sender] {
            sender.send();
            boss.run = nullptr;
        };
        rig.step();
    }
    std::string shown(const char* item) {
        return std::string{rig.get<std::string_view>("/worker", item)};
    }
    Outcome shownOutcome() {
        return static_cast<Outcome>(rig.get<std::int64_t>("/worker", "outcome"));
    }
};

TEST_F(Activity, HandlerIsCalledOnceACycleUntilItIsDone) {
    worker.on("work", [this](Call& call) {
        calls += call.first() ? 'f' : 'a';
        call[result] = static_cast<std::int64_t>(calls.size());
        return next;
    });
    auto answered = work.response<std::int64_t>("result");

    sendInNextCycle(work);
    EXPECT_EQ(calls, "f");
    rig.step(2);
    EXPECT_EQ(calls, "faa");
    EXPECT_EQ(work.answer().outcome, Outcome::Running);
    next = Outcome::Done;
    rig.step(2);

    EXPECT_EQ(calls, "faaa");
    EXPECT_EQ(work.answer().outcome, Outcome::Done);
    EXPECT_EQ(work.answer().number, 1U);
    EXPECT_EQ(work.answer().latencyCycles, 3);
    EXPECT_EQ(answered, 4);
    EXPECT_EQ(work.answered(), 1U);
}

TEST_F(Activity, MayBeDoneAtItsFirstCall) {
    next = Outcome::Done;

    sendInNextCycle(work);
    rig.step();

    EXPECT_EQ(work.answer().outcome, Outcome::Done);
    EXPECT_EQ(calls, "f");
    EXPECT_EQ(shownOutcome(), Outcome::Done);
}

TEST_F(Activity, BeginsWithoutTheProgressOfTheOneBefore) {
    worker.on("work", [this](Call&) {
        progress = 0.88;
        return Outcome::Done;
    });
    sendInNextCycle(work);
    rig.step();
    ASSERT_EQ(rig.get<double>("/worker", "progress"), 0.88);

    sendInNextCycle(watch);

    EXPECT_EQ(shownOutcome(), Outcome::Running);
    EXPECT_EQ(rig.get<double>("/worker", "progress"), 0);
}

TEST_F(Activity, IsShownByTheItemsOfItsSimplex) {
    sendInNextCycle(watch);
    EXPECT_EQ(shown("activity"), "watch");
    EXPECT_EQ(shown("requester"), "/boss");
    EXPECT_EQ(shownOutcome(), Outcome::Running);

    next = Outcome::Failed;
    rig.step();

    EXPECT_EQ(shown("activity"), "watch");
    EXPECT_EQ(shownOutcome(), Outcome::Failed);
}

TEST_F(Activity, SecondRequestIsRejectedAsBusy) {
    sendInNextCycle(work);
    sendInNextCycle(watch);
    rig.step();

    EXPECT_EQ(watch.answer().outcome, Outcome::Rejected);
    EXPECT_EQ(watch.answer().reason, Reason::Busy);
    EXPECT_EQ(watch.answer().why.view(), "work is running");
    EXPECT_EQ(work.answer().outcome, Outcome::Running);
}

TEST_F(Activity, RequestThatReplacesCancelsTheFirst) {
    sendInNextCycle(work);
    sendInNextCycle(rework);
    EXPECT_EQ(calls, "fcf");
    rig.step();

    EXPECT_EQ(work.answer().outcome, Outcome::Cancelled);
    EXPECT_EQ(work.answer().why.view(), "replaced by a newer request");
    EXPECT_EQ(rework.answer().outcome, Outcome::Running);
    EXPECT_EQ(shown("activity"), "rework");
}

TEST_F(Activity, IsCancelledByTheBuiltInCommand) {
    sendInNextCycle(work);
    sendInNextCycle(cancel);
    rig.step();

    EXPECT_EQ(calls, "fc");
    EXPECT_EQ(cancel.answer().outcome, Outcome::Done);
    EXPECT_EQ(work.answer().outcome, Outcome::Cancelled);
    EXPECT_EQ(shownOutcome(), Outcome::Cancelled);
}

TEST_F(Activity, CancelWithoutOneIsRejected) {
    sendInNextCycle(cancel);
    rig.step();

    EXPECT_EQ(cancel.answer().outcome, Outcome::Rejected);
    EXPECT_EQ(cancel.answer().reason, Reason::State);
}

TEST_F(Activity, FailsWhenItsTimeIsOver) {
    sendInNextCycle(work);  // timeout 10 ms
    rig.step(9);
    EXPECT_EQ(work.answer().outcome, Outcome::Running);
    rig.step(2);

    EXPECT_EQ(work.answer().outcome, Outcome::Failed);
    EXPECT_EQ(work.answer().why.view(), "work: not done within 0.01 s");
    EXPECT_EQ(calls, "faaaaaaaaac");
}

TEST_F(Activity, IsCancelledWhenItsSimplexLeavesActive) {
    sendInNextCycle(work);

    EXPECT_TRUE(rig.agent->cancelActivity(worker.index(), rig.agent->thread(0)));
    rig.step();

    EXPECT_EQ(calls, "fc");
    EXPECT_EQ(work.answer().outcome, Outcome::Cancelled);
    EXPECT_EQ(work.answer().why.view(), "its simplex left Active");
}

TEST_F(Activity, OfADeadSimplexIsCancelledWithoutItsHandler) {
    sendInNextCycle(work);

    EXPECT_TRUE(rig.agent->cancelActivity(worker.index(), rig.agent->thread(0), false));
    rig.step();

    EXPECT_EQ(calls, "f");
    EXPECT_EQ(work.answer().outcome, Outcome::Cancelled);
}

TEST_F(Activity, CancellingWithoutOneDoesNothing) {
    EXPECT_TRUE(rig.agent->cancelActivity(worker.index(), rig.agent->thread(0)));
    EXPECT_TRUE(rig.agent->cancelActivity(boss.index(), rig.agent->thread(0)));
    EXPECT_EQ(calls, "");
}

TEST_F(Activity, HandlerThatThrowsWhileItIsCancelledIsTold) {
    worker.on("work", [](Call& call) -> Outcome {
        if (call.cancelling()) throw std::runtime_error("boom");
        return Outcome::Running;
    });
    sendInNextCycle(work);

    EXPECT_FALSE(rig.agent->cancelActivity(worker.index(), rig.agent->thread(0)));
    rig.step();

    EXPECT_EQ(work.answer().outcome, Outcome::Cancelled);
    EXPECT_TRUE(rig.hasEvent("threw while it was cancelled"));
}

TEST_F(Activity, HandlerThatThrowsEndsItAsFailed) {
    worker.on("work", [](Call& call) -> Outcome {
        if (!call.first()) throw std::runtime_error("boom");
        return Outcome::Running;
    });
    sendInNextCycle(work);
    rig.begin();
    EXPECT_THROW(rig.runTasks(), std::runtime_error);
    rig.end();
    rig.step();

    EXPECT_EQ(work.answer().outcome, Outcome::Failed);
    EXPECT_EQ(shownOutcome(), Outcome::Failed);
}

TEST_F(Activity, HandlerThatThrowsAtItsFirstCallNeverRan) {
    worker.on("work", [](Call&) -> Outcome { throw std::runtime_error("boom"); });
    boss.run = [this] {
        work.send();
        boss.run = nullptr;
    };
    rig.begin();
    EXPECT_THROW(rig.runTasks(), std::runtime_error);
    rig.end();
    rig.step();

    EXPECT_EQ(work.answer().outcome, Outcome::Failed);
    EXPECT_TRUE(rig.agent->cancelActivity(worker.index(), rig.agent->thread(0)));
}

TEST_F(Activity, LongRunningOneLeavesTheLaneFreeForOtherCommands) {
    sendInNextCycle(watch);
    boss.run = [this] { EXPECT_EQ(work.send(), Outcome::None); };  // each is rejected as busy

    rig.step(200);

    EXPECT_EQ(work.answer().reason, Reason::Busy);
    EXPECT_EQ(watch.answer().outcome, Outcome::Running);
    next = Outcome::Done;
    boss.run = nullptr;
    rig.step(2);
    EXPECT_EQ(watch.answer().outcome, Outcome::Done);
    EXPECT_EQ(watch.answer().latencyCycles, 201);
}

TEST_F(Activity, NeedsTheStateOfItsCommandToBegin) {
    worker.state = State::Standby;
    sendInNextCycle(work);
    sendInNextCycle(watch);  // always available
    rig.step();

    EXPECT_EQ(work.answer().reason, Reason::State);
    EXPECT_EQ(watch.answer().outcome, Outcome::Running);
}

// From outside

TEST_F(Activity, FromOutsideIsAnsweredRunningThenFinally) {
    rig.outside.send({.path = "/worker", .command = "watch", .host = "desk"});
    rig.step(2);
    ASSERT_EQ(rig.outside.answers.size(), 1U);
    EXPECT_EQ(rig.outside.last().outcome, Outcome::Running);
    EXPECT_EQ(shown("requester"), "tool");

    next = Outcome::Done;
    rig.step();

    ASSERT_EQ(rig.outside.answers.size(), 2U);
    EXPECT_EQ(rig.outside.last().outcome, Outcome::Done);
    EXPECT_EQ(rig.outside.last().latencyCycles, 2);
    EXPECT_TRUE(rig.hasEvent("/worker: tool@desk: watch(): Done in 2 cycles"));
}

TEST_F(Activity, IsCancelledFromOutside) {
    sendInNextCycle(watch);
    rig.outside.send({.path = "/worker", .command = "cancel"});
    rig.step(2);

    EXPECT_EQ(rig.outside.last().outcome, Outcome::Done);
    EXPECT_EQ(watch.answer().outcome, Outcome::Cancelled);
}

TEST_F(Activity, OfALostSenderIsCancelledWhereItsCommandSaysSo) {
    worker.on("guard", [this](Call& call) {
        calls += call.cancelling() ? 'c' : 'a';
        return next;
    });
    rig.outside.send({.path = "/worker", .command = "guard"});
    rig.step();
    rig.outside.loseSender("somebody else");
    rig.step();
    EXPECT_EQ(calls, "aa");

    rig.outside.loseSender("tool");
    rig.step();

    EXPECT_EQ(calls, "aac");
    EXPECT_EQ(rig.outside.last().outcome, Outcome::Cancelled);
    EXPECT_EQ(rig.outside.last().why, "its sender was lost");
}

TEST_F(Activity, OfALostSenderGoesOnOtherwise) {
    rig.outside.send({.path = "/worker", .command = "watch"});
    rig.step();
    rig.outside.loseSender("tool");
    rig.step(2);

    EXPECT_EQ(calls, "faa");
}

TEST_F(Activity, IsCancelledWhenTheAgentStops) {
    rig.outside.send({.path = "/worker", .command = "watch"});
    rig.step();

    rig.agent->stop();

    EXPECT_EQ(rig.outside.last().outcome, Outcome::Cancelled);
    EXPECT_EQ(rig.outside.last().why, "the agent stopped");
    EXPECT_TRUE(rig.outside.closed);
}

}  // namespace
}  // namespace cortex
