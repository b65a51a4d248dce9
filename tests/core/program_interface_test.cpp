// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/program_interface.hpp"

#include "cortex/core/command_exchange.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/make_structure.hpp"
#include "cortex/core/record.hpp"

#include "support/agent_rig.hpp"

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using namespace std::chrono_literals;
using test::AgentRig;
using test::Hand;

struct ProgramInterface : testing::Test {
    cortex::ProgramInterface program{"program", 8};
    AgentRig rig;
    Hand& worker = rig.hand("/worker");

    void start() {
        rig.add(program);
        rig.make();
        const auto in = worker.argument<double>("add", "amount");
        const auto out = worker.result<double>("add", "sum");
        worker.on("add", [=](Call& call) {
            call[out] = call[in] + 1;
            return Outcome::Done;
        });
        worker.on("watch", [](Call&) { return Outcome::Running; });
        rig.start();
    }
    // A loop without a clock may run all the cycles that a command has while its sender waits for a
    // CPU; then it was surely not executed.
    CallResult callOfFreeLoop() {
        CallResult result;
        do {
            result = program.call("/worker", "add");
        } while (result.outcome == Outcome::Expired);
        return result;
    }
};

TEST_F(ProgramInterface, CarriesACommandAndItsAnswerOnce) {
    start();
    const auto sequence = program.post("/worker", "add", {{"amount", Value{std::vector{4.0}}}});
    CallResult result;
    EXPECT_FALSE(program.poll(sequence, result));
    rig.step();

    ASSERT_TRUE(program.poll(sequence, result));
    EXPECT_TRUE(result.done());
    EXPECT_EQ(result.response["sum"], (Value{std::vector{5.0}}));
    EXPECT_EQ(result.text(), "Done");
    EXPECT_FALSE(program.poll(sequence, result));
}

TEST_F(ProgramInterface, TakesArgumentsOfOneElementAsTheyAre) {
    using Arguments = cortex::ProgramInterface::Arguments;
    const Arguments all{{"speed", 0.5}, {"name", "x"}, {"n", 3}, {"on", true}};
    const Arguments texts{{"name", "x"}};
    start();
    const auto whole = program.post("/worker", "add", {{"amount", 4}});
    const auto list = program.post("/worker", "add", {{"amount", std::vector{5.0}}});
    rig.step();
    CallResult first, second;

    EXPECT_EQ(all, (std::map<std::string, Value>{{"speed", std::vector{0.5}},
                                                 {"name", std::vector<std::string>{"x"}},
                                                 {"n", std::vector<std::int64_t>{3}},
                                                 {"on", std::vector<bool>{true}}}));
    EXPECT_EQ(texts.at("name"), Value{std::vector<std::string>{"x"}});
    ASSERT_TRUE(program.poll(whole, first) && program.poll(list, second));
    EXPECT_EQ(first.response["sum"], Value{std::vector{5.0}});
    EXPECT_EQ(second.response["sum"], Value{std::vector{6.0}});
}

TEST_F(ProgramInterface, AnswerInWords) {
    start();
    worker.state = State::Standby;
    const auto sequence = program.post("/worker", "add");
    rig.step();
    CallResult result;
    ASSERT_TRUE(program.poll(sequence, result));

    EXPECT_EQ(result.text(), "Rejected (state): add needs Active, is Standby");
    EXPECT_FALSE(result.done());
}

TEST_F(ProgramInterface, RunningIsNoAnswer) {
    start();
    const auto sequence = program.post("/worker", "watch");
    CallResult result;
    rig.step(3);
    EXPECT_FALSE(program.poll(sequence, result));
    rig.agent->cancelActivity(worker.index(), rig.agent->thread(0));
    rig.step();

    ASSERT_TRUE(program.poll(sequence, result));
    EXPECT_EQ(result.outcome, Outcome::Cancelled);
}

TEST_F(ProgramInterface, NamesWhatIsUnknown) {
    EXPECT_THROW(program.post("/worker", "add"), Error);  // before start()
    CallResult result;
    EXPECT_FALSE(program.poll(1, result));
    start();
    EXPECT_THROW(program.post("/wroker", "add"), Error);
    EXPECT_THROW(program.post("/worker", "ad"), Error);
    EXPECT_THROW(program.post("/worker", "add", {{"amonut", Value{std::vector{1.0}}}}), Error);
}

TEST_F(ProgramInterface, SaysHowManyValuesAnArgumentNeedsAndHas) {
    start();
    const auto error = [&](const GivenValue& amount) -> std::string {
        try {
            program.post("/worker", "add", {{"amount", amount}});
        } catch (const Error& thrown) {
            return thrown.what();
        }
        return "";
    };

    EXPECT_EQ(error(std::vector{1.0, 2.0}),
              "command 'add': parameter 'amount' is float: expected 1 value, found 2: '1 2'");
    EXPECT_EQ(error(std::vector<double>{}),
              "command 'add': parameter 'amount' is float: expected 1 value, found 0: ''");
    EXPECT_EQ(error(true), "command 'add': parameter 'amount' is float, got bool true");
}

TEST_F(ProgramInterface, FullPipeIsAnsweredAtOnce) {
    start();
    CallResult result;
    for (int i = 0; i < 8; ++i) program.post("/worker", "add");
    const auto ninth = program.post("/worker", "add");

    ASSERT_TRUE(program.poll(ninth, result));
    EXPECT_EQ(result.outcome, Outcome::MailboxFull);
    rig.step();
    EXPECT_FALSE(program.poll(ninth, result));
    EXPECT_NE(program.post("/worker", "add"), 0U);
}

TEST_F(ProgramInterface, WindowOfUnansweredCommandsIsKept) {
    rig.hand("/resting");
    start();
    rig.order = {"/worker"};
    program.post("/resting", "mute");  // waits for a task that does not come
    CallResult result;
    std::uint64_t last = 0;
    for (std::uint32_t i = 1; i < senderWindow - CommandClient::keptForUrgent; ++i) {
        last = program.post("/worker", "add");
        rig.step();
        ASSERT_TRUE(program.poll(last, result)) << i;
        ASSERT_TRUE(result.done());
    }
    last = program.post("/worker", "add");
    ASSERT_TRUE(program.poll(last, result));
    EXPECT_EQ(result.outcome, Outcome::MailboxFull);
}

TEST_F(ProgramInterface, CallWaitsForTheAnswer) {
    start();
    std::atomic<bool> stop{false};
    std::thread loop{[&] {
        while (!stop) rig.step();
    }};
    for (int i = 0; i < 20; ++i) EXPECT_TRUE(callOfFreeLoop().done());
    stop = true;
    loop.join();
}

TEST_F(ProgramInterface, CallGivesUpWhereNoAnswerComes) {
    start();
    const CallResult result = program.call("/worker", "add", {}, 1ms);

    EXPECT_EQ(result.outcome, Outcome::Unknown);
    EXPECT_EQ(result.why, "no answer within 1 ms");
    rig.step();  // its answer is not kept for anybody
    CallResult late;
    EXPECT_FALSE(program.poll(1, late));
}

TEST_F(ProgramInterface, WhatIsOnItsWayWhenTheAgentStopsEnds) {
    start();
    const auto taken = program.post("/worker", "watch");
    rig.step();
    const auto waiting = program.post("/worker", "add");
    rig.agent->stop();
    CallResult result;

    ASSERT_TRUE(program.poll(taken, result));
    EXPECT_EQ(result.outcome, Outcome::Cancelled);
    ASSERT_TRUE(program.poll(waiting, result));
    EXPECT_EQ(result.outcome, Outcome::Unknown);
    EXPECT_THROW(program.post("/worker", "add"), Error);
}

TEST_F(ProgramInterface, CommandsFromManyThreadsAllArrive) {
    start();
    std::atomic<bool> stop{false};
    std::thread loop{[&] {
        while (!stop) rig.step();
    }};
    std::atomic<int> done{0};
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
        threads.emplace_back([&] {
            for (int k = 0; k < 25; ++k) done += callOfFreeLoop().done() ? 1 : 0;
        });
    }
    for (auto& thread : threads) thread.join();
    stop = true;
    loop.join();

    EXPECT_EQ(done, 100);
}

TEST(SenderOfThisProcess, StartsLaterThanTheOnesBefore) {
    const Sender first = makeSender("a"), second = makeSender(std::string(200, 'x'));

    EXPECT_GT(second.epoch, first.epoch);
    EXPECT_EQ(second.nameText().size(), 63U);
    EXPECT_EQ(first.nameText(), "a");
}

struct PreparedCommands : testing::Test {
    static std::shared_ptr<Structure> structure() {
        SimplexTree tree{test::commandTypes()};
        tree.add("/worker", "Worker");
        auto structure = makeStructure("rig", tree);
        structure->epoch = 7;
        return structure;
    }
    const CommandTables tables{structure()};
    CommandClient client{makeSender("tool")};
    CallResult result;

    PreparedCommand prepare() {
        return client.prepare(tables, "/worker", "add",
                              {{"amount", Value{std::vector<std::int64_t>{3}}}}, {50, 70});
    }
};

TEST_F(PreparedCommands, AreNumberedAndEncodedForAnyTransport) {
    const PreparedCommand prepared = prepare();
    const OutsideCommand& message = prepared.message;

    EXPECT_TRUE(prepared.open);
    EXPECT_EQ(message.sender, client.sender());
    EXPECT_EQ(message.sequence, 1U);
    EXPECT_EQ(message.targetEpoch, 7);
    EXPECT_EQ(message.notAfter, 50);
    EXPECT_EQ(message.until, 70);
    EXPECT_EQ(message.simplex, tables.structure().find("/worker"));
    EXPECT_EQ(argumentsOf(tables.of(message.simplex), message.command, prepared.request()),
              (std::map<std::string, Value>{{"amount", Value{std::vector{3.0}}}}));
    EXPECT_EQ(prepare().message.sequence, 2U);
    EXPECT_THROW(client.prepare(tables, "/walker", "add", {}, {50}), Error);
    EXPECT_THROW(client.prepare(tables, "/worker", "ad", {}, {50}), Error);
    EXPECT_THROW(client.prepare(tables, "/worker", "add", {{"a", Value{}}}, {50}), Error);
}

TEST_F(PreparedCommands, AreAnsweredByNames) {
    prepare();
    client.take(1, Outcome::Running, Reason::None, "", 0, {});
    EXPECT_FALSE(client.poll(1, result));
    client.take(1, Outcome::Rejected, Reason::Busy, "it works", 4,
                {{"sum", Value{std::vector{3.5}}}});

    ASSERT_TRUE(client.poll(1, result));
    EXPECT_EQ(result.text(), "Rejected (busy): it works");
    EXPECT_EQ(result.latencyCycles, 4);
    EXPECT_EQ(result.response.at("sum"), (Value{std::vector{3.5}}));
    client.take(1, Outcome::Done, Reason::None, "", 4, {});
    EXPECT_FALSE(client.poll(1, result));
}

TEST_F(PreparedCommands, ThatStopSomethingHavePlacesOfTheirOwn) {
    while (prepare().open) continue;

    const auto isOpen = [&](const char* command) {
        return client.prepare(tables, "/worker", command, {}, {}).open;
    };
    EXPECT_FALSE(isOpen("startup"));
    for (std::uint32_t i = 1; i < CommandClient::keptForUrgent; ++i) {
        EXPECT_TRUE(isOpen("shutdown"));
    }
    EXPECT_TRUE(isOpen("cancel"));
    EXPECT_FALSE(isOpen("shutdown"));
}

TEST_F(PreparedCommands, AreNotToBeSentWhenTooManyAreOnTheirWay) {
    const std::uint32_t most = senderWindow - CommandClient::keptForUrgent;
    for (std::uint32_t i = 0; i < most; ++i) ASSERT_TRUE(prepare().open);

    const PreparedCommand refused = prepare();
    EXPECT_FALSE(refused.open);
    ASSERT_TRUE(client.poll(refused.message.sequence, result));
    EXPECT_EQ(result.outcome, Outcome::MailboxFull);
    client.take(1, Outcome::Done, Reason::None, "", 1, {});
    EXPECT_TRUE(prepare().open);
    EXPECT_FALSE(prepare().open);
    client.take(2, Outcome::Done, Reason::None, "", 1, {});
    EXPECT_TRUE(prepare().open);
}

TEST_F(PreparedCommands, ThatAreNotSentAreAnsweredAndUseNoNumber) {
    const auto refused = client.takeBack(prepare(), Outcome::Expired, "it is not heard");

    ASSERT_TRUE(client.poll(refused, result));
    EXPECT_EQ(result.text(), "Expired: it is not heard");
    const std::uint32_t most = senderWindow - CommandClient::keptForUrgent;
    for (std::uint32_t i = 0; i < most; ++i) {
        EXPECT_EQ(prepare().message.sequence, i + 1U);
    }
    EXPECT_FALSE(prepare().open);
    client.take(1, Outcome::Done, Reason::None, "", 1, {});
    EXPECT_EQ(prepare().message.sequence, most + 1U) << "nothing was left out";
}

TEST(CommandClient, KeepsTheLastThousandResultsThatNobodyFetched) {
    cortex::ProgramInterface program;
    AgentRig rig;
    rig.hand("/worker");
    rig.add(program);
    rig.start();
    for (int i = 0; i < 1100; ++i) {
        program.post("/worker", "mute");
        rig.step();
    }
    CallResult result;
    EXPECT_FALSE(program.poll(1, result));
    EXPECT_TRUE(program.poll(1000, result));
    rig.agent->stop();
}

TEST_F(ProgramInterface, LongCommandThatRunsHoldsUpNoOthers) {
    start();
    const auto watching = program.post("/worker", "watch");
    rig.step(2);
    CallResult result;
    for (std::uint32_t i = 0; i < 2 * senderWindow; ++i) {
        const auto sequence = program.post("/worker", "add");
        rig.step(2);
        ASSERT_TRUE(program.poll(sequence, result));
        ASSERT_TRUE(result.done()) << i << ": " << result.text();
    }
    rig.agent->cancelActivity(worker.index(), rig.agent->thread(0));
    rig.step();

    ASSERT_TRUE(program.poll(watching, result));
    EXPECT_EQ(result.outcome, Outcome::Cancelled);
}

}  // namespace
}  // namespace cortex
