// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"

#include "support/agent_rig.hpp"

#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::AgentRig;
using test::Hand;

// /boss sends to /worker along an output: same cycle.
struct CommandPort : testing::Test {
    AgentRig rig;
    Hand& boss = rig.hand("/boss", "Boss");
    Hand& worker = rig.hand("/worker");
    CommandSender sender;
    int calls = 0;
    double sum = 0;

    void prepare(std::string_view command, std::uint32_t capacity = 16) {
        rig.tree.relate(boss, "workers", worker);
        rig.make();
        sender = boss.output("workers").command(command, capacity);
    }
    // Sends in the next cycle and steps until the answer stands.
    AnswerHead exchange() {
        boss.run = [this] {
            sender.send();
            boss.run = nullptr;
        };
        rig.step(2);
        return sender.answer();
    }
};

TEST_F(CommandPort, AlongAnOutputTheHandlerRunsInTheSameCycleAndTheAnswerStandsInTheNext) {
    prepare("add");
    auto amount = sender.argument<double>("amount");
    auto result = sender.response<double>("sum");
    const auto in = worker.argument<double>("add", "amount");
    const auto out = worker.result<double>("add", "sum");
    std::int64_t executedIn = 0;
    worker.on("add", [&](Call& call) {
        executedIn = rig.tick.cycle;
        call[out] = call[in] + 1;
        return Outcome::Done;
    });
    rig.start();
    boss.run = [&] {
        if (rig.tick.cycle == 1) {
            amount = 41.0;
            EXPECT_EQ(sender.send(), Outcome::None);
        }
        if (rig.tick.cycle == 2) {
            EXPECT_EQ(sender.answer().outcome, Outcome::Done);
            EXPECT_EQ(result, 42.0);
        }
    };

    rig.step(2);

    EXPECT_EQ(executedIn, 1);
    EXPECT_EQ(sender.answer().number, 1U);
    EXPECT_EQ(sender.answer().latencyCycles, 0);
    EXPECT_GE(sender.answer().latency, 0);
    EXPECT_EQ(sender.sent(), 1U);
    EXPECT_EQ(sender.answered(), 1U);
    EXPECT_EQ(rig.agent->thread(0).commands, 1U);
}

TEST_F(CommandPort, AlongAnInputTheHandlerRunsInTheNextCycle) {
    rig.tree.relate(boss, "peers", worker);
    rig.order = {"/worker", "/boss"};
    rig.make();
    sender = boss.input("peers").command("poke");
    worker.on("poke", [&](Call&) { return ++calls, Outcome::Done; });
    rig.start();
    boss.run = [&] {
        if (rig.tick.cycle == 1) sender.send();
    };

    rig.step();
    EXPECT_EQ(calls, 0);
    rig.step();
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(sender.answer().outcome, Outcome::Done);
    EXPECT_EQ(sender.answer().latencyCycles, 1);
}

TEST_F(CommandPort, AlongADelayedOutputTheHandlerRunsInTheNextCycleWhateverTheOrder) {
    for (const bool workerFirst : {false, true}) {
        AgentRig late;
        Hand& from = late.hand("/boss", "Boss");
        Hand& to = late.hand("/worker");
        late.tree.relate(from, "late", to);
        late.order = workerFirst ? std::vector<std::string>{"/worker", "/boss"}
                                 : std::vector<std::string>{"/boss", "/worker"};
        late.make();
        auto send = from.output("late").command("poke");
        std::vector<std::int64_t> executed, answered;
        to.on("poke", [&](Call&) { return executed.push_back(late.tick.cycle), Outcome::Done; });
        late.start();
        from.run = [&] {
            if (late.tick.cycle == 1) send.send();
            if (send.answered() == 1 && answered.empty()) answered.push_back(late.tick.cycle);
        };

        late.step(5);

        EXPECT_EQ(executed, (std::vector<std::int64_t>{2}));
        EXPECT_EQ(answered, (std::vector<std::int64_t>{3}));
    }
}

TEST_F(CommandPort, DrainsLanesInCanonicalOrderOfTheirSendersThenTheirRelationships) {
    Hand& other = rig.hand("/aBoss", "Boss");
    rig.tree.relate(boss, "aides", worker);
    rig.tree.relate(boss, "workers", worker);
    rig.tree.relate(other, "aides", worker);
    rig.order = {"/boss", "/aBoss", "/worker"};  // canonical: not the order of paths
    rig.make();
    auto first = boss.output("workers").command("add");
    auto second = boss.output("aides").command("add");
    auto third = other.output("aides").command("add");
    first.argument<double>("amount") = 1;
    second.argument<double>("amount") = 2;
    third.argument<double>("amount") = 3;
    const auto in = worker.argument<double>("add", "amount");
    std::vector<double> seen;
    worker.on("add", [&](Call& call) { return seen.push_back(call[in]), Outcome::Done; });
    rig.start();

    rig.begin();  // arrival in another order than the canonical one
    third.send();
    second.send();
    first.send();
    first.send();
    rig.runTasks();
    rig.end();

    // Edges of one owner stand by rule: aides before workers.
    EXPECT_EQ(seen, (std::vector<double>{2, 1, 1, 3}));
}

TEST_F(CommandPort, RejectsByStateInWords) {
    prepare("add");
    worker.on("add", [&](Call&) { return ++calls, Outcome::Done; });
    rig.start();
    worker.state = State::Fault;

    const AnswerHead answer = exchange();

    EXPECT_EQ(answer.outcome, Outcome::Rejected);
    EXPECT_EQ(answer.reason, Reason::State);
    EXPECT_EQ(answer.why.view(), "add needs Active, is Fault");
    EXPECT_EQ(calls, 0);
    EXPECT_EQ(rig.agent->thread(0).rejected, 1U);
    EXPECT_TRUE(rig.hasEvent("/worker: add from /boss: Rejected, add needs Active, is Fault"));
}

TEST_F(CommandPort, RefusalsInARowAreOneEventUntilOneIsAccepted) {
    prepare("poke");
    worker.on("poke", [](Call&) { return Outcome::Done; });
    rig.start();
    boss.run = [&] { sender.send(); };
    worker.state = State::Fault;
    rig.step(5);
    worker.state = State::Active;
    rig.step();
    worker.state = State::Fault;
    rig.step(3);

    int events = 0;
    for (const auto& text : rig.events()) events += text.starts_with("/worker: poke from") ? 1 : 0;
    EXPECT_EQ(events, 2);
    EXPECT_EQ(rig.agent->thread(0).rejected, 8U);
}

TEST_F(CommandPort, RejectsArgumentsOutOfRangeBeforeTheHandler) {
    prepare("add");
    worker.on("add", [&](Call&) { return ++calls, Outcome::Done; });
    sender.argument<double>("amount") = 1000;
    rig.start();

    const AnswerHead answer = exchange();

    EXPECT_EQ(answer.outcome, Outcome::Rejected);
    EXPECT_EQ(answer.reason, Reason::Range);
    EXPECT_EQ(answer.why.view(), "amount: 1000 is above 100");
    EXPECT_EQ(calls, 0);
}

TEST_F(CommandPort, RejectsACommandWithoutHandler) {
    prepare("mute");
    rig.start();

    const AnswerHead answer = exchange();

    EXPECT_EQ(answer.outcome, Outcome::Rejected);
    EXPECT_EQ(answer.reason, Reason::UnknownCommand);
    EXPECT_EQ(answer.why.view(), "mute has no handler");
}

TEST_F(CommandPort, HandlerThatIsSetLaterOrAnewTakesTheNextCommand) {
    prepare("poke");
    rig.start();
    EXPECT_EQ(exchange().reason, Reason::UnknownCommand);

    worker.on("poke", [&](Call&) { return calls += 1, Outcome::Done; });
    EXPECT_EQ(exchange().outcome, Outcome::Done);
    worker.on("poke", [&](Call&) { return calls += 10, Outcome::Done; });
    EXPECT_EQ(exchange().outcome, Outcome::Done);
    EXPECT_EQ(calls, 11);
}

TEST_F(CommandPort, WordsOfAHandlerThatThenIsDoneAreForgottenWhateverItsArguments) {
    prepare("poke");
    worker.on("poke", [](Call& call) {
        call.fail("never mind");
        return Outcome::Done;
    });
    rig.start();
    EXPECT_EQ(exchange().why.view(), "");

    rig.outside.send({.path = "/worker", .command = "poke"});
    rig.step(2);
    EXPECT_EQ(rig.outside.last().outcome, Outcome::Done);
    EXPECT_EQ(rig.outside.last().why, "");
}

TEST_F(CommandPort, HandleMayOutliveTheAgentAndSendsNothingThen) {
    prepare("poke");
    worker.on("poke", [](Call&) { return Outcome::Done; });
    rig.start();
    exchange();
    EXPECT_EQ(sender.sent(), 1U);
    EXPECT_EQ(sender.answered(), 1U);

    rig.agent.reset();
    EXPECT_EQ(sender.sent(), 0U);
    EXPECT_EQ(sender.send(), Outcome::MailboxFull);
}

TEST_F(CommandPort, HandlerFailsInItsOwnWordsWhichTheNextAnswerForgets) {
    prepare("poke");
    bool fail = true;
    worker.on("poke", [&](Call& call) { return fail ? call.fail("too hot") : Outcome::Done; });
    rig.start();

    EXPECT_EQ(exchange().outcome, Outcome::Failed);
    EXPECT_EQ(sender.answer().why.view(), "too hot");
    fail = false;
    EXPECT_EQ(exchange().outcome, Outcome::Done);
    EXPECT_EQ(sender.answer().why.view(), "");
}

TEST_F(CommandPort, AResponseThatIsNoNumberIsAFailureInWordsAndNotSent) {
    prepare("add");
    sender.argument<double>("amount") = 1.0;
    const auto result = sender.response<double>("sum");
    const auto out = worker.result<double>("add", "sum");
    rig.start();
    for (const double wrong :
         {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
        worker.on("add", [&](Call& call) {
            call[out] = wrong;
            return Outcome::Done;
        });
        EXPECT_EQ(exchange().outcome, Outcome::Failed);
        EXPECT_EQ(sender.answer().why.view(), "its response 'sum' is not a number");
        EXPECT_EQ(result, 0.0);
    }
    EXPECT_TRUE(
        rig.hasEvent("/worker: add from /boss: Failed, its response 'sum' is not a number"));
}

TEST_F(CommandPort, AnElementOfAResponseFromOutsideThatIsNoNumberIsAFailureAsWell) {
    rig.make();
    const auto list = worker.arrayResult<double>("mix", "list");
    worker.on("mix", [&](Call& call) {
        call[list][1] = std::numeric_limits<double>::infinity();
        return Outcome::Done;
    });
    rig.start();
    rig.outside.send({.path = "/worker", .command = "mix"});
    rig.step();

    EXPECT_EQ(rig.outside.last().outcome, Outcome::Failed);
    EXPECT_EQ(rig.outside.last().why, "its response 'list' is not a number");
    EXPECT_TRUE(rig.outside.last().response.empty());
}

TEST_F(CommandPort, ShortCommandThatGoesOnRunningHasFailed) {
    prepare("poke");
    worker.on("poke", [](Call&) { return Outcome::Running; });
    rig.start();

    EXPECT_EQ(exchange().outcome, Outcome::Failed);
}

TEST_F(CommandPort, OutcomeThatOnlyTheFrameworkGivesCountsAsFailed) {
    prepare("poke");
    worker.on("poke", [](Call&) { return Outcome::Expired; });
    rig.start();

    EXPECT_EQ(exchange().outcome, Outcome::Failed);
}

TEST_F(CommandPort, WhatAHandlerThrowsPassesThroughAndTheSenderIsAnswered) {
    prepare("poke");
    worker.on("poke", [](Call&) -> Outcome { throw std::runtime_error("boom"); });
    rig.start();
    boss.run = [&] { sender.send(); };

    rig.begin();
    EXPECT_THROW(rig.runTasks(), std::runtime_error);
    rig.end();
    boss.run = nullptr;
    rig.step();

    EXPECT_EQ(sender.answer().outcome, Outcome::Failed);
    EXPECT_EQ(sender.answer().why.view(), "its handler threw");
}

TEST_F(CommandPort, FullMailboxRefusesIsCountedAndIsOneEvent) {
    prepare("poke", 3);
    worker.on("poke", [&](Call&) { return ++calls, Outcome::Done; });
    rig.start();
    std::vector<Outcome> outcomes;
    boss.run = [&] {
        for (int i = 0; i < 5; ++i) outcomes.push_back(sender.send());
        boss.run = nullptr;
    };

    rig.step(2);

    EXPECT_EQ(outcomes, (std::vector{Outcome::None, Outcome::None, Outcome::None,
                                     Outcome::MailboxFull, Outcome::MailboxFull}));
    EXPECT_EQ(calls, 3);
    EXPECT_EQ(sender.sent(), 3U);
    EXPECT_EQ(rig.agent->thread(0).rejected, 2U);
    int events = 0;
    for (const auto& text : rig.events()) {
        events += text == "/boss: poke to /worker: the mailbox is full, not sent" ? 1 : 0;
    }
    EXPECT_EQ(events, 1);
}

TEST_F(CommandPort, ReceiverOfALowerRateTakesWhatWaitsAtItsNextRun) {
    prepare("poke");
    worker.on("poke", [&](Call&) { return ++calls, Outcome::Done; });
    rig.start();
    boss.run = [&] { sender.send(); };
    rig.order = {"/boss"};  // the worker does not run in these cycles
    rig.step(3);
    EXPECT_EQ(calls, 0);

    rig.order = {"/boss", "/worker"};
    rig.step();

    EXPECT_EQ(calls, 4);
}

TEST_F(CommandPort, SeveralHandlesOfOneRelationshipShareItsLaneInTheOrderOfSending) {
    rig.tree.relate(boss, "workers", worker);
    rig.make();
    auto poke = boss.output("workers").command("poke");
    auto add = boss.output("workers").command("add");
    std::string seen;
    worker.on("poke", [&](Call&) { return seen += 'p', Outcome::Done; });
    worker.on("add", [&](Call&) { return seen += 'a', Outcome::Done; });
    rig.start();
    boss.run = [&] {
        poke.send();
        add.send();
        poke.send();
        boss.run = nullptr;
    };

    rig.step(2);

    EXPECT_EQ(seen, "pap");
    EXPECT_EQ(poke.answered(), 2U);
    EXPECT_EQ(add.answered(), 1U);
    EXPECT_EQ(add.answer().number, 2U);
}

// `set`

TEST_F(CommandPort, SetChangesEveryNamedItemOfAnyKind) {
    prepare("set");
    sender.argument<double>("gain") = 2.5;
    sender.argument<std::int64_t>("mode") = 2;
    sender.argument<std::string_view>("title") = "left";
    sender.argument<bool>("on") = true;
    rig.start();

    EXPECT_EQ(exchange().outcome, Outcome::Done);

    EXPECT_EQ(rig.get<double>("/worker", "gain"), 2.5);
    EXPECT_EQ(rig.get<std::int64_t>("/worker", "mode"), 2);
    EXPECT_EQ(rig.get<std::string_view>("/worker", "title"), "left");
    EXPECT_TRUE(rig.get<bool>("/worker", "on"));
}

TEST_F(CommandPort, SetChangesNothingWhereOneValueIsOutOfRange) {
    prepare("set");
    sender.argument<double>("gain") = 11;
    sender.argument<bool>("on") = true;
    rig.start();

    const AnswerHead answer = exchange();

    EXPECT_EQ(answer.reason, Reason::Range);
    EXPECT_EQ(answer.why.view(), "gain: 11 is above 10 m");
    EXPECT_FALSE(rig.get<bool>("/worker", "on"));
}

TEST_F(CommandPort, SetChangesNothingWhereOneItemMayNotBeSetInThisState) {
    prepare("set");
    sender.argument<std::string_view>("title") = "left";
    sender.argument<double>("gain") = 2;
    rig.start();
    worker.state = State::Standby;

    const AnswerHead answer = exchange();

    EXPECT_EQ(answer.reason, Reason::State);
    EXPECT_EQ(answer.why.view(), "title needs Active, is Standby");
    EXPECT_EQ(rig.get<double>("/worker", "gain"), 1);
}

TEST_F(CommandPort, SetOfNoItemIsRejected) {
    prepare("set");
    rig.start();

    EXPECT_EQ(exchange().reason, Reason::Range);
}

TEST_F(CommandPort, SetOfASimplexWithoutTaskIsDoneAtTheNextReadInEveryState) {
    Simplex& plate = rig.tree.add("/plate", "Plate");
    rig.tree.relate(boss, "plates", plate);
    rig.make();
    sender = boss.input("plates").command("set");
    sender.argument<double>("level") = 3;
    sender.argument<std::string_view>("label") = "high";
    rig.start();
    boss.run = [&] {
        if (rig.tick.cycle == 1) sender.send();
    };

    rig.step();
    EXPECT_EQ(rig.get<double>("/plate", "level"), 1);
    rig.begin();
    EXPECT_EQ(plate.data<double>("level"), 3);
    rig.runTasks();
    rig.end();

    EXPECT_EQ(sender.answer().outcome, Outcome::Done);
    EXPECT_EQ(rig.get<std::string_view>("/plate", "label"), "high");
}

// Handles that cannot be had

TEST_F(CommandPort, SendersAndHandlersOfUnknownCommandsThrowWithTheNames) {
    rig.tree.relate(boss, "workers", worker);
    rig.make();

    EXPECT_THROW(boss.output("workers").command("ad"), Error);
    EXPECT_THROW(worker.on("ad", [](Call&) { return Outcome::Done; }), Error);
    EXPECT_THROW(worker.on("set", [](Call&) { return Outcome::Done; }), Error);
    auto add = boss.output("workers").command("add");
    EXPECT_THROW(add.argument<double>("amonut"), Error);
    EXPECT_THROW(add.argument<bool>("amount"), Error);
    EXPECT_THROW(add.response<double>("total"), Error);
    EXPECT_THROW(CommandSender{}.argument<double>("amount"), Error);
    EXPECT_FALSE(CommandSender{}.bound());
    EXPECT_TRUE(add.bound());
}

TEST_F(CommandPort, SetOfMoreThanARelationshipCarriesHasNoSenderButARemedy) {
    rig.tree.relate(boss, "workers", rig.hand("/bulky", "Bulky"));
    rig.make();

    EXPECT_TRUE(boss.output("workers").command("add").bound());
    try {
        boss.output("workers").command("set");
        FAIL() << "more than its lane can hold";
    } catch (const Error& error) {
        EXPECT_NE(std::string_view{error.what()}.find("send it from outside"), std::string::npos)
            << error.what();
    }
}

TEST_F(CommandPort, LifeCycleCommandsHaveNoSender) {
    rig.tree.relate(boss, "workers", worker);
    rig.make();
    try {
        boss.output("workers").command("startup");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string{error.what()}.find("use lifeCycle()"), std::string::npos);
    }
}

TEST_F(CommandPort, SendersAreGotInPopulateOnlyAndSendNothingBefore) {
    prepare("poke");
    EXPECT_EQ(sender.send(), Outcome::MailboxFull);
    rig.start();
    EXPECT_THROW(boss.output("workers").command("poke"), Error);
}

}  // namespace
}  // namespace cortex
