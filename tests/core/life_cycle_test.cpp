// SPDX-License-Identifier: Apache-2.0
// startup, shutdown and clearFaults from outside: sent to a simplex and watched by the router.
#include "core/router_fixture.hpp"

#include <gtest/gtest.h>

namespace cortex {
namespace {

struct LifeCycleFromOutside : test::Router {
    LifeCycle taken = LifeCycle::None;

    void SetUp() override {
        start();
        rig.setState(worker, State::Standby);
        worker.run = [this] {
            const LifeCycle command =
                rig.agent->takeLifeCycle(worker.index(), rig.agent->thread(0));
            if (command != LifeCycle::None) taken = command;
        };
    }
};

TEST_F(LifeCycleFromOutside, IsAnsweredRunningThenDoneWhenTheStateIsReached) {
    EXPECT_EQ(answerTo({.path = "/worker", .command = "startup"}).outcome, Outcome::Running);
    EXPECT_EQ(taken, LifeCycle::Startup);
    rig.setState(worker, State::StartingUp);
    rig.step();
    EXPECT_EQ(rig.outside.answers.size(), 1U);
    rig.setState(worker, State::Active);
    rig.step();

    EXPECT_EQ(rig.outside.last().outcome, Outcome::Done);
    EXPECT_EQ(rig.outside.last().latencyCycles, 2);
    EXPECT_TRUE(rig.hasEvent("/worker: tool: startup(): Done in 2 cycles"));
}

TEST_F(LifeCycleFromOutside, IsRejectedWhereItIsNotAvailable) {
    const auto shutdown = answerTo({.path = "/worker", .command = "shutdown", .sequence = 1});
    EXPECT_EQ(shutdown.reason, Reason::State);
    EXPECT_EQ(shutdown.why, "shutdown needs StartingUp or Active, is Standby");
    EXPECT_EQ(answerTo({.path = "/worker", .command = "clearFaults", .sequence = 2}).reason,
              Reason::State);
    EXPECT_EQ(taken, LifeCycle::None);
}

TEST_F(LifeCycleFromOutside, FailsWhereTheSimplexGoesToFault) {
    answerTo({.path = "/worker", .command = "startup"});
    rig.setState(worker, State::Fault);
    rig.step();

    EXPECT_EQ(rig.outside.last().outcome, Outcome::Failed);
    EXPECT_EQ(rig.outside.last().why, "it went to Fault");
}

TEST_F(LifeCycleFromOutside, FailsWhereTheSimplexComesBackToWhereItWas) {
    answerTo({.path = "/worker", .command = "startup"});
    rig.setState(worker, State::StartingUp);
    rig.step();
    rig.setState(worker, State::Standby);
    rig.step();

    EXPECT_EQ(rig.outside.last().outcome, Outcome::Failed);
    EXPECT_EQ(rig.outside.last().why, "it is back in Standby");
}

TEST_F(LifeCycleFromOutside, FailsAfterTheTimeOfItsTypeAndASecond) {
    rig.setState(worker, State::Active);
    answerTo({.path = "/worker", .command = "shutdown"});
    EXPECT_EQ(taken, LifeCycle::Shutdown);
    rig.setState(worker, State::ShuttingDown);
    rig.step(10'999);
    EXPECT_EQ(rig.outside.answers.size(), 1U);
    rig.step(2);

    EXPECT_EQ(rig.outside.last().outcome, Outcome::Failed);
    EXPECT_EQ(rig.outside.last().why, "it took too long, is ShuttingDown");
}

TEST_F(LifeCycleFromOutside, IsRejectedInTheWordsOfTheSimplex) {
    worker.run = [this] {
        if (rig.agent->takeLifeCycle(worker.index(), rig.agent->thread(0)) != LifeCycle::None) {
            rig.agent->refuseLifeCycle(worker.index(), LifeCycle::Startup, "its arm is not there",
                                       rig.agent->thread(0));
        }
    };
    const auto answer = answerTo({.path = "/worker", .command = "startup"});

    EXPECT_EQ(answer.outcome, Outcome::Rejected);
    EXPECT_EQ(answer.reason, Reason::State);
    EXPECT_EQ(answer.why, "its arm is not there");
}

TEST_F(LifeCycleFromOutside, IsRejectedWhereTheSimplexDoesNotFollow) {
    answerTo({.path = "/worker", .command = "startup"});
    rig.step(2);

    EXPECT_EQ(rig.outside.last().outcome, Outcome::Rejected);
    EXPECT_EQ(rig.outside.last().why, "it did not follow; its events say why");
}

TEST_F(LifeCycleFromOutside, ClearFaultsLeadsToStandby) {
    rig.setState(worker, State::Fault);
    EXPECT_EQ(answerTo({.path = "/worker", .command = "clearFaults"}).outcome, Outcome::Running);
    EXPECT_EQ(taken, LifeCycle::ClearFaults);
    rig.setState(worker, State::Standby);
    rig.step();

    EXPECT_EQ(rig.outside.last().outcome, Outcome::Done);
}

TEST_F(LifeCycleFromOutside, IsCancelledWhenTheAgentStops) {
    answerTo({.path = "/worker", .command = "startup"});
    rig.agent->stop();

    EXPECT_EQ(rig.outside.last().outcome, Outcome::Cancelled);
}

}  // namespace
}  // namespace cortex
