// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/clock.hpp"

#include "core/router_fixture.hpp"

#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::PlayedInterface;
using test::Router;
using Message = PlayedInterface::Message;

TEST_F(Router, CommandFromOutsideIsExecutedInTheCycleWhoseReadTookIt) {
    rig.make();
    const auto in = worker.argument<double>("add", "amount");
    const auto out = worker.result<double>("add", "sum");
    worker.on("add", [&](Call& call) {
        EXPECT_NE(call.sender(), nullptr);
        call[out] = call[in] + 1;
        return Outcome::Done;
    });
    rig.start();

    const auto answer = answerTo(
        {.path = "/worker", .command = "add", .arguments = {{"amount", Value{std::vector{2.0}}}}});

    EXPECT_EQ(answer.outcome, Outcome::Done);
    EXPECT_EQ(answer.sequence, 1U);
    EXPECT_EQ(answer.latencyCycles, 0);
    ASSERT_EQ(answer.response.size(), 8U);
    EXPECT_EQ(*reinterpret_cast<const double*>(answer.response.data()), 3);
    EXPECT_TRUE(rig.hasEvent("/worker: tool: add(amount=2): Done in the same cycle"));
}

TEST_F(Router, SetOfASimplexWithoutTaskIsDoneAtRead) {
    start();
    rig.outside.send(
        {.path = "/plate", .command = "set", .arguments = {{"level", Value{std::vector{4.0}}}}});
    rig.begin();

    EXPECT_EQ(plate.data<double>("level"), 4);
    rig.end();
    EXPECT_EQ(rig.outside.last().outcome, Outcome::Done);
}

TEST_F(Router, CommandsAreTakenInOrderOfInterfaceThenNameThenEpochThenSequence) {
    PlayedInterface second;
    rig.add(second);
    rig.make();
    std::vector<std::string> seen;
    worker.on("poke", [&](Call& call) {
        seen.push_back(std::string{call.sender()->nameText()});
        return Outcome::Done;
    });
    const auto in = worker.argument<double>("add", "amount");
    worker.on("add", [&](Call& call) {
        seen.push_back(std::to_string(static_cast<int>(call[in])));
        return Outcome::Done;
    });
    rig.start();
    const auto add = [](double amount, std::uint64_t sequence) {
        return Message{.path = "/worker",
                       .command = "add",
                       .arguments = {{"amount", Value{std::vector{amount}}}},
                       .sequence = sequence};
    };
    second.send({.path = "/worker", .command = "poke", .sender = "a"});
    rig.outside.send({.path = "/worker", .command = "poke", .sender = "z"});
    rig.outside.send(add(2, 2));
    rig.outside.send(add(1, 1));
    rig.outside.send({.path = "/worker", .command = "poke", .sender = "b"});

    rig.step();

    EXPECT_EQ(seen, (std::vector<std::string>{"b", "1", "2", "z", "a"}));
    EXPECT_EQ(second.answers.size(), 1U);
    EXPECT_EQ(rig.outside.answers.size(), 4U);
    rig.agent->stop();  // before its second interface ends
}

TEST_F(Router, RepeatIsAnsweredFromTheWindowAndNotExecutedAgain) {
    start();
    answerTo({.path = "/worker", .command = "poke"});
    const auto again = answerTo({.path = "/worker", .command = "poke"});

    EXPECT_EQ(again.outcome, Outcome::Done);
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(rig.outside.answers.size(), 2U);
}

TEST_F(Router, RepeatOfALongCommandIsAnsweredWithWhatItHasComeTo) {
    rig.make();
    Outcome next = Outcome::Running;
    worker.on("watch", [&](Call&) { return ++calls, next; });
    rig.start();
    const Message watch{.path = "/worker", .command = "watch"};
    EXPECT_EQ(answerTo(watch).outcome, Outcome::Running);
    EXPECT_EQ(answerTo(watch).outcome, Outcome::Running);
    EXPECT_EQ(rig.outside.answers.size(), 2U);
    next = Outcome::Done;
    rig.step();
    EXPECT_EQ(answerTo(watch).outcome, Outcome::Done);

    EXPECT_EQ(rig.outside.answers.size(), 4U);
    EXPECT_EQ(calls, 3);
}

TEST_F(Router, WhoKnowsOnlyThatALongCommandRunsIsToldHowItEnded) {
    rig.make();
    Outcome next = Outcome::Running;
    const auto result = worker.result<std::int64_t>("work", "result");
    worker.on("work", [&](Call& call) {
        call[result] = 7;
        return next;
    });
    worker.on("poke", [](Call&) { return Outcome::Done; });
    rig.start();
    const Message work{.path = "/worker", .command = "work"};
    const auto poke = [this](std::uint64_t number) {
        return answerTo(
            {.path = "/worker", .command = "poke", .sequence = number, .answeredBelow = number});
    };
    EXPECT_EQ(answerTo(work).outcome, Outcome::Running);
    poke(2);
    EXPECT_EQ(answerTo(work).outcome, Outcome::Running) << "acknowledged, and runs on";

    next = Outcome::Done;
    rig.step();
    const std::size_t answers = rig.outside.answers.size();
    for (std::uint64_t number = 3; number < 300; ++number) poke(number);
    const auto end = answerTo(work);
    EXPECT_EQ(rig.outside.answers.size(), answers + 298);
    EXPECT_EQ(end.outcome, Outcome::Done);
    EXPECT_EQ(end.sequence, 1U);
    ASSERT_EQ(end.response.size(), 8U);
    EXPECT_EQ(*reinterpret_cast<const std::int64_t*>(end.response.data()), 7);
}

TEST_F(Router, WhoKnowsOnlyThatAStartupRunsIsToldHowItEnded) {
    rig.make();
    rig.start();
    rig.setState(worker, State::Standby);
    const Message startup{.path = "/worker", .command = "startup"};
    EXPECT_EQ(answerTo(startup).outcome, Outcome::Running);
    answerTo({.path = "/worker", .command = "poke", .sequence = 2, .answeredBelow = 2});
    rig.setState(worker, State::Active);
    rig.step();

    EXPECT_EQ(answerTo(startup).outcome, Outcome::Done);
}

TEST_F(Router, AnEndThatAThousandOthersFollowedIsForgottenInWords) {
    rig.make();
    worker.on("rework",
              [](Call& call) { return call.cancelling() ? Outcome::Cancelled : Outcome::Running; });
    rig.start();
    const auto rework = [this](std::uint64_t number) {
        return answerTo(
            {.path = "/worker", .command = "rework", .sequence = number, .answeredBelow = number});
    };
    for (std::uint64_t number = 1; number <= 1025; ++number) rework(number);
    EXPECT_EQ(rework(1).outcome, Outcome::Cancelled) << "1,024 have ended";
    rework(1026);

    const auto first = rework(1);
    EXPECT_EQ(first.outcome, Outcome::Unknown);
    EXPECT_EQ(first.why, "how it ended is forgotten");
    EXPECT_EQ(rework(2).outcome, Outcome::Cancelled);
    EXPECT_EQ(rework(1026).outcome, Outcome::Running);
}

TEST_F(Router, RepeatInTheSameReadIsAnsweredOnce) {
    start();
    rig.outside.send({.path = "/worker", .command = "poke"});
    rig.outside.send({.path = "/worker", .command = "poke"});
    rig.step();

    EXPECT_EQ(calls, 1);
    EXPECT_EQ(rig.outside.answers.size(), 1U);
}

TEST_F(Router, WhatIsAcknowledgedIsForgottenAndALateRepeatOfItIgnored) {
    start();
    answerTo({.path = "/worker", .command = "poke", .sequence = 1});
    answerTo({.path = "/worker", .command = "poke", .sequence = 2, .answeredBelow = 2});
    rig.outside.send({.path = "/worker", .command = "poke", .sequence = 1});
    rig.step();

    EXPECT_EQ(calls, 2);
    EXPECT_EQ(rig.outside.answers.size(), 2U);
}

TEST_F(Router, CommandThatAnotherOneSaysIsAnsweredAlreadyIsRefusedInWords) {
    start();
    answerTo({.path = "/worker", .command = "poke", .sequence = 1});
    answerTo({.path = "/worker", .command = "poke", .sequence = 100, .answeredBelow = 100});
    const auto answer = answerTo({.path = "/worker", .command = "poke", .sequence = 2});

    EXPECT_EQ(answer.sequence, 2U);
    EXPECT_EQ(answer.outcome, Outcome::Rejected);
    EXPECT_EQ(answer.reason, Reason::Window);
    EXPECT_EQ(calls, 2);
    EXPECT_EQ(rig.agent->thread(0).rejected, 1U);
    EXPECT_TRUE(rig.hasEvent("another command of its sender said that this one was answered"));
}

TEST_F(Router, CommandOfAnEarlierStartIsTakenWhenTheLaterOneIsOver) {
    start();
    const auto poke = [&](std::int64_t epoch, std::int64_t notAfter, std::uint64_t sequence = 1) {
        return answerTo({.path = "/worker",
                         .command = "poke",
                         .sequence = sequence,
                         .epoch = epoch,
                         .notAfter = notAfter});
    };
    EXPECT_EQ(poke(2'000, 5).outcome, Outcome::Done);
    EXPECT_EQ(poke(1'000, 100).reason, Reason::Restarted) << "the later one may still repeat";
    rig.step(10);
    EXPECT_EQ(poke(1'000, 100).outcome, Outcome::Unknown) << "what was refused stays refused";
    EXPECT_EQ(poke(1'000, 100, 2).outcome, Outcome::Done);
    EXPECT_EQ(poke(2'000, 100).outcome, Outcome::Done) << "a later start always counts";
}

TEST_F(Router, RefusalIsRepeatedLikeAnyOutcome) {
    start();
    worker.state = State::Fault;
    EXPECT_EQ(answerTo({.path = "/worker", .command = "poke"}).outcome, Outcome::Rejected);
    worker.state = State::Active;

    EXPECT_EQ(answerTo({.path = "/worker", .command = "poke"}).outcome, Outcome::Rejected);
    EXPECT_EQ(calls, 0);
}

TEST_F(Router, RejectsByStateRangeAndMissingHandler) {
    start();
    worker.state = State::Fault;
    const auto state = answerTo({.path = "/worker", .command = "poke", .sequence = 1});
    EXPECT_EQ(state.reason, Reason::State);
    EXPECT_EQ(state.why, "poke needs Standby or Active, is Fault");
    worker.state = State::Active;

    const auto range = answerTo({.path = "/worker",
                                 .command = "add",
                                 .arguments = {{"amount", Value{std::vector{-1.0}}}},
                                 .sequence = 2});
    EXPECT_EQ(range.reason, Reason::Range);

    const auto mute = answerTo({.path = "/worker", .command = "mute", .sequence = 3});
    EXPECT_EQ(mute.reason, Reason::UnknownCommand);
    EXPECT_EQ(rig.agent->thread(0).rejected, 3U);
    EXPECT_TRUE(rig.hasEvent("tool: add(amount=-1): Rejected (range), amount: -1 is below 0"));
}

TEST_F(Router, RejectsWhatItDoesNotHave) {
    start();
    const auto simplex = answerTo({.path = "/nowhere", .command = "poke", .sequence = 1});
    EXPECT_EQ(simplex.reason, Reason::UnknownCommand);
    const auto command = answerTo({.path = "/worker", .command = "nothing", .sequence = 2});
    EXPECT_EQ(command.reason, Reason::UnknownCommand);
    const auto size =
        answerTo({.path = "/worker", .command = "add", .sequence = 3, .sizeError = 8});
    EXPECT_EQ(size.reason, Reason::UnknownCommand);
    EXPECT_EQ(calls, 0);
}

TEST_F(Router, RejectsWhatIsMeantForAnotherStartOfTheAgent) {
    start();
    const auto answer = answerTo({.path = "/worker", .command = "poke", .targetEpoch = 12345});

    EXPECT_EQ(answer.outcome, Outcome::Rejected);
    EXPECT_EQ(answer.reason, Reason::Restarted);
    EXPECT_EQ(calls, 0);
    // Not kept: the same sequence meant for this start is executed.
    EXPECT_EQ(answerTo({.path = "/worker", .command = "poke"}).outcome, Outcome::Done);
}

TEST_F(Router, NewStartOfASenderBeginsAnewAndTheOldOneIsRefused) {
    start();
    answerTo({.path = "/worker", .command = "poke", .epoch = 1});
    EXPECT_EQ(answerTo({.path = "/worker", .command = "poke", .epoch = 2}).outcome, Outcome::Done);
    const auto old = answerTo({.path = "/worker", .command = "poke", .sequence = 2, .epoch = 1});

    EXPECT_EQ(old.reason, Reason::Restarted);
    EXPECT_EQ(calls, 2);
}

TEST_F(Router, CommandThatCameTooLateIsExpiredAndSurelyNotExecuted) {
    start();
    rig.step(5);
    const auto answer = answerTo({.path = "/worker", .command = "poke", .notAfter = 5});

    EXPECT_EQ(answer.outcome, Outcome::Expired);
    EXPECT_EQ(calls, 0);
    EXPECT_EQ(
        answerTo({.path = "/worker", .command = "poke", .sequence = 2, .notAfter = 7}).outcome,
        Outcome::Done);
}

TEST_F(Router, CommandThatWaitedTooLongForASlowSimplexIsExpired) {
    start();
    rig.order = {};
    rig.outside.send({.path = "/worker", .command = "poke", .notAfter = 3});
    rig.step(4);
    EXPECT_TRUE(rig.outside.answers.empty());
    rig.order = {"/worker"};
    rig.step();

    EXPECT_EQ(rig.outside.last().outcome, Outcome::Expired);
    EXPECT_EQ(calls, 0);
}

TEST_F(Router, CommandWhoseTimeHasPassedWhileTheLoopStoodStillIsExpired) {
    start();
    const Message late{.path = "/worker", .command = "poke", .until = monotonicNow() - 1};
    const auto answer = answerTo(late);

    EXPECT_EQ(answer.outcome, Outcome::Expired);
    EXPECT_EQ(calls, 0);
    EXPECT_EQ(answerTo(late).outcome, Outcome::Expired) << "a repeat gets the same answer";
    const std::int64_t hour = 3'600'000'000'000;
    EXPECT_EQ(
        answerTo({.path = "/worker", .command = "poke", .sequence = 2, .until = late.until + hour})
            .outcome,
        Outcome::Done);
}

TEST_F(Router, CommandWhoseTimePassesBeforeItsTurnIsExpiredAlthoughNoCycleCounted) {
    start();
    rig.order = {};
    const std::int64_t until = monotonicNow() + 10'000'000;
    rig.outside.send({.path = "/worker", .command = "poke", .until = until});
    rig.step();
    while (monotonicNow() <= until) {
    }
    rig.order = {"/worker"};
    rig.step();

    EXPECT_EQ(rig.outside.last().outcome, Outcome::Expired);
    EXPECT_EQ(calls, 0);
}

TEST_F(Router, SenderMayHaveOnlyAWindowUnanswered) {
    start();
    const auto beyond =
        answerTo({.path = "/worker", .command = "poke", .sequence = 1 + senderWindow});
    EXPECT_EQ(beyond.outcome, Outcome::Rejected);
    EXPECT_EQ(beyond.reason, Reason::Window);

    for (std::uint64_t i = 1; i <= senderWindow; ++i) {
        const auto within = answerTo({.path = "/worker", .command = "poke", .sequence = i});
        EXPECT_EQ(within.outcome, Outcome::Done);
    }
    EXPECT_EQ(calls, static_cast<int>(senderWindow));
}

TEST_F(Router, PoolOfAllSendersIsBounded) {
    start();
    for (std::uint64_t i = 1; i <= 10; ++i) {
        rig.outside.send({.path = "/worker", .command = "poke", .sequence = i});
    }
    rig.step();

    int full = 0;
    for (const auto& answer : rig.outside.answers) full += answer.outcome == Outcome::MailboxFull;
    EXPECT_EQ(full, 2);
    EXPECT_EQ(calls, 8);
    EXPECT_EQ(rig.agent->thread(0).rejected, 2U);
}

TEST(RouterOfMany, KeepsPlacesForWhatStopsSomething) {
    test::AgentRig rig{"rig", {.outsideCommands = 32}};
    test::Hand& worker = rig.hand("/worker");
    rig.hand("/other");
    rig.make();
    rig.start();
    rig.setState(worker, State::Active);
    rig.order = {"/other"};  // what is sent to the worker stands in its queue
    const auto send = [&](const char* command, std::uint64_t number) {
        rig.outside.send({.path = "/worker", .command = command, .sequence = number});
    };
    for (std::uint64_t number = 1; number <= 33; ++number) send("poke", number);
    send("shutdown", 34);
    rig.step();

    std::map<Outcome, int> outcomes;
    for (const auto& answer : rig.outside.answers) ++outcomes[answer.outcome];
    EXPECT_EQ(outcomes, (std::map<Outcome, int>{{Outcome::MailboxFull, 1}, {Outcome::Running, 1}}));
}

TEST_F(Router, TooManySendersAreRefusedUntilOneIsPastRepeating) {
    start();
    const auto from = [](int i, std::int64_t notAfter) {
        return Message{.path = "/worker",
                       .command = "poke",
                       .sender = "tool" + std::to_string(i),
                       .notAfter = notAfter};
    };
    for (int i = 0; i < 128; ++i) answerTo(from(i, i == 7 ? 140 : 1000));
    EXPECT_EQ(answerTo(from(128, 1000)).reason, Reason::Window);
    rig.step(15);

    EXPECT_EQ(answerTo(from(128, 1000)).outcome, Outcome::Done);
    EXPECT_EQ(answerTo(from(129, 1000)).reason, Reason::Window);
}

TEST_F(Router, WhatIsLeftWhenTheAgentStopsIsCancelled) {
    start();
    rig.order = {};
    rig.outside.send({.path = "/worker", .command = "poke"});
    rig.step();
    rig.agent->stop();

    EXPECT_EQ(rig.outside.last().outcome, Outcome::Cancelled);
    EXPECT_EQ(calls, 0);
}

TEST_F(Router, AnswerToASenderThatStartedAnewInBetweenHarmsNobody) {
    rig.make();
    Outcome next = Outcome::Running;
    worker.on("watch", [&](Call&) { return next; });
    worker.on("poke", [&](Call&) { return ++calls, Outcome::Done; });
    rig.start();
    answerTo({.path = "/worker", .command = "watch", .epoch = 1});
    answerTo({.path = "/worker", .command = "poke", .epoch = 2});
    next = Outcome::Done;
    rig.step();

    EXPECT_EQ(calls, 1);
    EXPECT_EQ(rig.outside.last().outcome, Outcome::Done);
    EXPECT_EQ(answerTo({.path = "/worker", .command = "poke", .epoch = 2}).outcome, Outcome::Done);
    EXPECT_EQ(calls, 1);
}

TEST_F(Router, EventsOfInterfacesAreThoseOfTheCycle) {
    start();
    rig.outside.atRead([&](Inbox& inbox) {
        EXPECT_EQ(inbox.cycle(), 1);
        inbox.event(Severity::Warning, EventKind::Agent, worker.index(), "hello");
    });
    rig.step();

    EXPECT_TRUE(rig.hasEvent("/worker: hello"));
}

// Life-cycle commands

TEST_F(Router, CommandWhoseTimeWouldNeverEndIsRefused) {
    start();
    const auto answer = answerTo({.path = "/worker",
                                  .command = "poke",
                                  .notAfter = std::numeric_limits<std::int64_t>::max()});

    EXPECT_EQ(answer.outcome, Outcome::Rejected);
    EXPECT_EQ(answer.reason, Reason::Range);
    EXPECT_EQ(calls, 0);
}

TEST_F(Router, LateRepeatOfASenderThatWasForgottenIsUnknownAndNotExpired) {
    start();
    const auto from = [](const std::string& sender, std::int64_t notAfter) {
        return Message{
            .path = "/worker", .command = "poke", .sender = sender, .notAfter = notAfter};
    };
    EXPECT_EQ(answerTo(from("early", 5)).outcome, Outcome::Done);
    for (int i = 0; i < 127; ++i) answerTo(from("tool" + std::to_string(i), 1000));
    EXPECT_EQ(answerTo(from("late", 140)).outcome, Outcome::Done);  // takes the place of "early"
    rig.step(15);

    EXPECT_EQ(answerTo(from("early", 5)).outcome, Outcome::Unknown);
    EXPECT_EQ(calls, 129);
}

}  // namespace
}  // namespace cortex
