// SPDX-License-Identifier: Apache-2.0
// In which order the commands of one sender begin: a case for each thing that can come between.
#include "core/order_fixture.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::Answered;
using test::longestWait;
using test::RouterOrder;

using Numbers = std::vector<int>;
using Answers = std::vector<Answered>;

TEST_F(RouterOrder, RunsInItsCycleIfNothingIsMissingHoweverItIsHandedOver) {
    send({3});
    send({1});
    send({2});
    step();
    send({4});
    step();

    EXPECT_EQ(begun, (Numbers{1, 2, 3, 4}));
}

TEST_F(RouterOrder, WaitsForWhatIsMissing) {
    send({3});
    step(2);
    EXPECT_TRUE(begun.empty());
    send({1});
    step();
    EXPECT_EQ(begun, (Numbers{1}));
    send({2});
    step();

    EXPECT_EQ(begun, (Numbers{1, 2, 3}));
    EXPECT_EQ(network.answers,
              (Answers{{1, Outcome::Done}, {2, Outcome::Done}, {3, Outcome::Done}}));
}

TEST_F(RouterOrder, OfANewSenderBeginsWithTheFirstThatIsUnanswered) {
    send({.number = 40, .below = 40});
    step();

    EXPECT_EQ(begun, (Numbers{40}));
}

TEST_F(RouterOrder, RepeatOfAWaitingOneIsNotAnsweredAndItRunsOnce) {
    send({3});
    send({3});
    step();
    send({3});
    step();
    EXPECT_TRUE(network.answers.empty());
    send({1});
    send({2});
    step();

    EXPECT_EQ(begun, (Numbers{1, 2, 3}));
}

TEST_F(RouterOrder, GoesOnAfterTheLongestWaitAndWhatComesThenIsExpired) {
    send({3});
    step(longestWait);
    EXPECT_TRUE(begun.empty());
    step();
    EXPECT_EQ(begun, (Numbers{3}));
    send({2});
    send({.number = 1, .path = "/other"});
    step();
    send({2});
    step();

    EXPECT_EQ(begun, (Numbers{3, 1})) << "what is late for another simplex runs";
    EXPECT_EQ(
        network.answers,
        (Answers{
            {3, Outcome::Done}, {2, Outcome::Expired}, {1, Outcome::Done}, {2, Outcome::Expired}}));
    EXPECT_EQ(network.whys[1].view(),
              "a later command of its sender to this simplex has begun; it came too late");
}

TEST_F(RouterOrder, WaitsForAtMostHalfOfItsTime) {
    send({.number = 3, .budget = 20});
    step(10);
    EXPECT_TRUE(begun.empty());
    step();

    EXPECT_EQ(begun, (Numbers{3}));
    EXPECT_EQ(outcomeOf(3), Outcome::Done);
}

TEST_F(RouterOrder, WhatHasWaitedLongEnoughTakesEarlierOnesAlong) {
    send({.number = 2, .budget = 1000});
    send({.number = 3, .budget = 20});
    send({.number = 4, .budget = 1000});
    step(11);

    EXPECT_EQ(begun, (Numbers{2, 3, 4}));
}

TEST_F(RouterOrder, WhatItsSenderGaveUpDoesNotRun) {
    send({3});
    step();
    send({.number = 4, .below = 4});
    step(longestWait + 1);

    EXPECT_EQ(begun, (Numbers{4}));
    EXPECT_EQ(outcomeOf(3), Outcome::None);
    EXPECT_TRUE(rig.hasEvent("tool: add(amount=3): Expired, its sender gave it up in 1 cycle"));
}

TEST_F(RouterOrder, NumbersThatTheTransportRefusedAreNotWaitedFor) {
    send({3});
    step();
    send({.number = 1, .refused = true});
    send({.number = 2, .refused = true});
    step();
    EXPECT_EQ(begun, (Numbers{3}));
    send({1});
    step();

    EXPECT_EQ(begun, (Numbers{3}));
    EXPECT_EQ(network.answers, (Answers{{3, Outcome::Done}, {1, Outcome::Rejected}}));
}

TEST_F(RouterOrder, WhatIsRefusedOnArrivalIsNotWaitedFor) {
    send({.number = 2});
    send({.number = 1, .budget = -1});
    step();

    EXPECT_EQ(begun, (Numbers{2}));
    EXPECT_EQ(outcomeOf(1), Outcome::Expired);
}

TEST_F(RouterOrder, ShutdownWaitsForNothingAndEarlierOnesToItsSimplexAreWithdrawn) {
    send({3});
    step();
    send({.number = 5, .command = "shutdown"});
    send({.number = 2, .path = "/other"});
    step();
    EXPECT_EQ(begun, (Numbers{2, -2}));
    EXPECT_EQ(outcomeOf(3), Outcome::Expired);
    send({4});
    step();

    EXPECT_EQ(begun, (Numbers{2, -2}));
    EXPECT_EQ(outcomeOf(4), Outcome::Expired);
    EXPECT_TRUE(
        rig.hasEvent("tool: add(amount=3): Expired, withdrawn by a later shutdown of "
                     "its sender in 1 cycle"));
}

TEST_F(RouterOrder, ShutdownOfAnotherSimplexLetsThemRun) {
    send({.number = 3, .path = "/other"});
    step();
    send({.number = 5, .command = "shutdown"});
    step();
    send({.number = 4, .path = "/other"});
    step();

    EXPECT_EQ(begun, (Numbers{3, -2, 4}));
}

TEST_F(RouterOrder, CancelEndsTheLongCommandThatWaitedBeforeIt) {
    send({.number = 3, .command = "watch"});
    step();
    send({.number = 4, .command = "cancel"});
    step();

    EXPECT_EQ(begun, (Numbers{0, 0})) << "its first call and that which says it is cancelled";
    EXPECT_EQ(network.answers, (Answers{{3, Outcome::Cancelled}, {4, Outcome::Done}}));
}

TEST_F(RouterOrder, LifeCycleCommandLetsEarlierOnesInAQueueGoFirst) {
    rig.setState(worker, State::Standby);
    send({.number = 1, .command = "set", .arguments = {{"gain", Value{std::vector{2.0}}}}});
    send({.number = 2, .command = "startup"});
    step();
    EXPECT_TRUE(begun.empty());
    EXPECT_EQ(outcomeOf(1), Outcome::Done);
    step();

    EXPECT_EQ(begun, (Numbers{-1}));
}

TEST_F(RouterOrder, LifeCycleCommandWaitsForTheTurnOfASlowSimplex) {
    rig.setState(worker, State::Standby);
    rig.order = {"/other"};
    send({.number = 1, .command = "set", .arguments = {{"gain", Value{std::vector{2.0}}}}});
    send({.number = 2, .command = "startup"});
    step(20);
    EXPECT_TRUE(network.answers.empty());
    rig.order = {"/worker"};
    step(2);

    EXPECT_EQ(begun, (Numbers{-1}));
    EXPECT_EQ(network.answers, (Answers{{1, Outcome::Done}, {2, Outcome::Running}}));
}

TEST_F(RouterOrder, WhatExpiredInAQueueHasOvertakenNothing) {
    rig.order = {"/other"};
    send({.number = 2, .budget = 4});
    step(6);
    rig.order = {"/worker"};
    step();
    EXPECT_EQ(outcomeOf(2), Outcome::Expired);
    send({1});
    step();

    EXPECT_EQ(begun, (Numbers{1}));
}

TEST_F(RouterOrder, ShutdownOfALaterStartWithdrawsWhatStandsInAQueue) {
    rig.order = {"/other"};
    send({1});
    send({2});
    step();
    send({.number = 1, .command = "shutdown", .epoch = 2});
    step();
    rig.order = {"/worker"};
    step();

    EXPECT_EQ(begun, (Numbers{-2}));
    EXPECT_EQ(outcomeOf(2), Outcome::Expired);
}

TEST_F(RouterOrder, CommandToTheAgentCountsAsOneToEachSimplex) {
    rig.order = {"/other"};
    const test::NamedArguments all{{"prefix", Value{std::vector{std::string{"/"}}}}};
    send({1});
    send({.number = 2, .path = "/rig", .command = "takeControl", .arguments = all});
    step(3);
    EXPECT_TRUE(network.answers.empty()) << "it waits for the first";
    rig.order = {"/worker"};
    step(2);
    EXPECT_EQ(network.answers, (Answers{{1, Outcome::Done}, {2, Outcome::Done}}));
    send({.number = 5, .path = "/rig", .command = "releaseControl", .arguments = all});
    step(longestWait + 1);
    send({4});
    step();

    EXPECT_EQ(begun, (Numbers{1}));
    EXPECT_EQ(outcomeOf(5), Outcome::Done);
    EXPECT_EQ(outcomeOf(4), Outcome::Expired);
}

TEST_F(RouterOrder, RenewalOfControlOvertakesNothing) {
    const test::NamedArguments all{{"prefix", Value{std::vector{std::string{"/"}}}}};
    send({.number = 1, .path = "/rig", .command = "takeControl", .arguments = all});
    step();
    send({.number = 3, .path = "/rig", .command = "renewControl", .arguments = all});
    step(longestWait + 1);
    EXPECT_EQ(outcomeOf(3), Outcome::Done);
    rig.order = {"/other"};
    send({2});
    send({.number = 4, .path = "/rig", .command = "renewControl", .arguments = all});
    step();
    EXPECT_EQ(outcomeOf(4), Outcome::Done) << "it waits for no queue";
    rig.order = {"/worker"};
    step();

    EXPECT_EQ(begun, (Numbers{2}));
}

TEST_F(RouterOrder, LaterStartOfItsSenderEndsWhatWaits) {
    send({3});
    step();
    send({.number = 1, .epoch = 2});
    step();

    EXPECT_EQ(begun, (Numbers{1}));
    EXPECT_EQ(network.answers, (Answers{{3, Outcome::Expired}, {1, Outcome::Done}}));
    EXPECT_EQ(network.whys[0].view(), "its sender has started anew");
}

TEST_F(RouterOrder, LossOfItsSenderEndsWhatWaits) {
    send({3});
    step();
    network.lose = true;
    step();
    network.lose = false;
    send({1});
    send({2});
    send({3});
    step();

    EXPECT_EQ(network.whys[0].view(), "its sender is gone");
    EXPECT_EQ(begun, (Numbers{1, 2}));
    EXPECT_EQ(outcomeOf(3), Outcome::Expired);
}

TEST_F(RouterOrder, WhatWaitsWhenTheAgentStopsIsCancelled) {
    send({3});
    step();
    rig.agent->stop();

    EXPECT_EQ(network.answers, (Answers{{3, Outcome::Cancelled}}));
    EXPECT_TRUE(begun.empty());
}

TEST_F(RouterOrder, WhatWasRefusedOfAnEarlierStartStaysRefusedWhenThatStartCounts) {
    send({.number = 1, .epoch = 2, .budget = 2});
    step();
    send({.number = 7});
    step();
    EXPECT_EQ(outcomeOf(7), Outcome::Rejected);
    step(5);
    send({7});
    step(longestWait + 1);
    EXPECT_EQ(begun, (Numbers{1}));
    send({8});
    step();

    EXPECT_EQ(begun, (Numbers{1, 8}));
}

TEST_F(RouterOrder, CopyOfACommandOfAnEarlierStartDoesNotRunAgain) {
    send({.number = 1, .budget = 1000});
    step();
    send({.number = 1, .epoch = 2, .budget = 2});
    step(10);
    send({.number = 1, .budget = 1000});
    step();

    EXPECT_EQ(begun, (Numbers{1, 1}));
}

TEST_F(RouterOrder, AtMostHalfOfThePoolWaits) {
    for (std::uint64_t i = 2; i <= 6; ++i) send({i});
    step();
    send({7});
    step();
    send({1});
    step();
    EXPECT_EQ(begun, (Numbers{1, 2, 3, 4, 5}));
    EXPECT_EQ(outcomeOf(6), Outcome::None) << "its repeat will come";
    send({6});
    send({7});
    step();

    EXPECT_EQ(begun, (Numbers{1, 2, 3, 4, 5, 6, 7}));
}

struct RouterOrderUnderControl : RouterOrder {
    RouterOrderUnderControl() : RouterOrder{true} {}
};

TEST_F(RouterOrderUnderControl, IsJudgedOnceTheCommandThatTakesControlHasBegun) {
    send({2});
    step();
    send({.number = 1,
          .path = "/rig",
          .command = "takeControl",
          .arguments = {{"prefix", Value{std::vector{std::string{"/"}}}}}});
    step(2);

    EXPECT_EQ(begun, (Numbers{2}));
    EXPECT_EQ(network.answers, (Answers{{1, Outcome::Done}, {2, Outcome::Done}}));
}

}  // namespace
}  // namespace cortex
