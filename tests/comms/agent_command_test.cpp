// SPDX-License-Identifier: Apache-2.0
// Commands from a tool of the test's own to an agent, over real DDS on the loopback interface.
#include "comms/network_agent.hpp"
#include "wire/named_values.hpp"

#include <optional>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

std::vector<NamedValue> arguments(const std::string& name, const Value& value) {
    return {namedValue(name, value)};
}

struct DdsCommand : testing::Test {
    DdsCommand() {
        agent.rig.tree.add("/plate", "Plate");
        agent.rig.make();
        worker.on("poke", [this](Call&) {
            ++pokes;
            return Outcome::Done;
        });
    }
    void start() {
        agent.rig.start();
        tool.connect();
    }
    Command command(const std::string& path, const std::string& name,
                    std::vector<NamedValue> with = {}) {
        return tool.command(agent.structure(), path, name, std::move(with));
    }
    // The newest answer to it, once there are so many.
    std::optional<Answer> answer(const Command& command, std::size_t count = 1) {
        std::optional<Answer> found;
        comesTrue([&] {
            agent.rig.step();
            std::size_t number = 0;
            for (const Answer& each : tool.answers.elements()) {
                if (each.sequenceNumber != command.sequenceNumber) continue;
                if (++number >= count && each.outcome != "Running") found = each;
            }
            return found.has_value();
        });
        return found;
    }
    std::optional<Answer> send(const Command& command) {
        EXPECT_TRUE(tool.commands->write(command));
        return answer(command);
    }
    double level() { return agent.rig.get<double>("/plate", "level"); }

    // A test steps fast: at this period a lease of 2 s lasts.
    RawTool tool{"operator"};
    NetworkAgent agent{test::commandTypes(), "robot", {.period = 1'000}};
    test::Hand& worker = agent.rig.hand("/worker");
    int pokes = 0;
};

TEST_F(DdsCommand, IsExecutedAndAnswered) {
    start();
    const auto done = send(command("/plate", "set", arguments("level", Value{std::vector{2.5}})));

    ASSERT_TRUE(done);
    EXPECT_EQ(done->outcome, "Done") << done->why;
    EXPECT_EQ(done->agent, "robot");
    EXPECT_EQ(done->epoch, agent.structure().epoch);
    EXPECT_EQ(done->senderEpoch, tool.epoch);
    EXPECT_EQ(level(), 2.5);
    EXPECT_TRUE(agent.rig.hasEvent("operator@desk: set(level=2.5): Done"));
}

TEST_F(DdsCommand, AnswersCarryTheResponse) {
    agent.rig.tree.at("/worker");
    const auto sum = worker.result<double>("add", "sum");
    worker.on("add", [sum](Call& call) {
        call[sum] = 42;
        return Outcome::Done;
    });
    start();
    const auto done = send(command("/worker", "add"));

    ASSERT_TRUE(done);
    ASSERT_EQ(done->response.size(), 1U);
    EXPECT_EQ(done->response.front(), namedValue("sum", Value{std::vector{42.0}}));
}

TEST_F(DdsCommand, SaysWhoIsBehindItAndIsAnsweredWithThat) {
    start();
    Command poke = command("/worker", "poke");
    poke.extras = {{"onBehalfOf", "alice"}, {"correlation", "order-7"}, {"mood", "good"}};
    const auto done = send(poke);
    ASSERT_TRUE(done);
    EXPECT_EQ(done->outcome, "Done") << done->why;
    const std::vector<Extra> both{{"onBehalfOf", "alice"}, {"correlation", "order-7"}};
    EXPECT_EQ(done->extras, both);
    EXPECT_TRUE(agent.rig.hasEvent("operator@desk for alice: poke(): Done"));

    Command refused = command("/worker", "dance");
    refused.extras = {{"correlation", "order-8"}};
    const auto rejected = send(refused);
    ASSERT_TRUE(rejected);
    EXPECT_EQ(rejected->extras, refused.extras);
}

TEST_F(DdsCommand, SaysNothingOfWhatIsNoNameOfAPerson) {
    start();
    for (const std::string& name : {std::string(32, 'x'), std::string{"a\nb"}, std::string{}}) {
        Command poke = command("/worker", "poke");
        poke.extras = {{"onBehalfOf", name}};
        const auto done = send(poke);
        ASSERT_TRUE(done);
        EXPECT_EQ(done->outcome, "Done");
        EXPECT_TRUE(done->extras.empty());
    }
    EXPECT_FALSE(agent.rig.hasEvent("operator@desk for"));
}

TEST_F(DdsCommand, SentTwiceIsExecutedOnceAndAnsweredTwice) {
    start();
    const Command poke = command("/worker", "poke");
    ASSERT_TRUE(send(poke));
    ASSERT_TRUE(tool.commands->write(poke));
    const auto again = answer(poke, 2);

    ASSERT_TRUE(again);
    EXPECT_EQ(again->outcome, "Done");
    EXPECT_EQ(pokes, 1);
}

TEST_F(DdsCommand, OutOfRangeIsRejectedWithItsReason) {
    start();
    const auto refused =
        send(command("/plate", "set", arguments("level", Value{std::vector{9.0}})));

    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->outcome, "Rejected");
    EXPECT_EQ(refused->reason, "range");
    EXPECT_NE(refused->why.find("level"), std::string::npos) << refused->why;
    EXPECT_EQ(level(), 1);
}

TEST_F(DdsCommand, ThatCannotBeEncodedIsRejectedWithoutTheLoop) {
    start();
    struct Case {
        Command command;
        const char *reason, *why;
    };
    NamedValue mixed = namedValue("level", Value{std::vector{1.0}});
    mixed.ints = {1};
    const std::vector<Case> cases{
        {command("/plaet", "set"), "unknown", "/plate"},
        {command("/plate", "sett"), "unknown", "set"},
        {command("/plate", "set", arguments("levle", Value{std::vector{1.0}})), "range", "level"},
        {command("/plate", "set", arguments("level", Value{std::vector<bool>{true}})), "range",
         "float"},
        {command("/plate", "set", {mixed}), "range", "malformed"},
    };
    const std::int64_t cycle = agent.rig.tick.cycle;
    for (const Case& each : cases) {
        ASSERT_TRUE(tool.commands->write(each.command));
    }
    ASSERT_TRUE(tool.answers.waitFor(cases.size()));

    EXPECT_EQ(agent.rig.tick.cycle, cycle);
    const auto answers = tool.answers.elements();
    for (std::size_t i = 0; i < cases.size(); ++i) {
        EXPECT_EQ(answers[i].outcome, "Rejected");
        EXPECT_EQ(answers[i].reason, cases[i].reason) << answers[i].why;
        EXPECT_NE(answers[i].why.find(cases[i].why), std::string::npos) << answers[i].why;
    }
}

TEST_F(DdsCommand, WhoseTimeIsOverIsExpired) {
    start();
    agent.rig.step(10);
    Command late = command("/plate", "set", arguments("level", Value{std::vector{2.0}}));
    late.notAfter = 5;
    const auto expired = send(late);

    ASSERT_TRUE(expired);
    EXPECT_EQ(expired->outcome, "Expired");
    EXPECT_EQ(level(), 1);
}

TEST_F(DdsCommand, ForAnotherStartOfTheAgentIsRejected) {
    start();
    Command old = command("/worker", "poke");
    --old.targetEpoch;
    const auto refused = send(old);

    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->reason, "restarted");
    EXPECT_EQ(pokes, 0);
}

TEST_F(DdsCommand, ForAnotherAgentOrWithAWrongIdIsNotAnswered) {
    start();
    Command other = command("/worker", "poke");
    other.target = "arm";
    other.link = linkId(tool.name, "arm");
    Command lying = command("/worker", "poke");
    lying.link.front() ^= 1;
    ASSERT_TRUE(tool.commands->write(other));
    ASSERT_TRUE(tool.commands->write(lying));

    Command set = command("/plate", "set", arguments("level", Value{std::vector{2.0}}));
    set.answeredBelow = set.sequenceNumber;  // so that it waits for neither of them
    ASSERT_TRUE(send(set));
    EXPECT_TRUE(comesTrue([&] { return agent.dds.rejected() == 1; })) << agent.dds.rejected();
    EXPECT_EQ(pokes, 0);
}

TEST_F(DdsCommand, OfAToolThatStopsLosesItsControl) {
    start();
    ASSERT_TRUE(tool.presences->write(tool.presence()));
    const auto taken = send(command("/robot", "takeControl",
                                    arguments("prefix", Value{std::vector<std::string>{"/"}})));
    ASSERT_TRUE(taken);
    ASSERT_EQ(taken->outcome, "Done") << taken->why;
    ASSERT_TRUE(tool.presences->write(tool.presence("stopping")));

    EXPECT_TRUE(agent.sees("operator no longer has control of /: it is gone"));
}

TEST_F(DdsCommand, OfAToolThatIsNotHeardForASecondLosesItsControl) {
    start();
    const auto taken = send(command("/robot", "takeControl",
                                    arguments("prefix", Value{std::vector<std::string>{"/"}})));
    ASSERT_TRUE(taken);
    ASSERT_EQ(taken->outcome, "Done") << taken->why;
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds{1100};
    EXPECT_TRUE(comesTrue([&] { return std::chrono::steady_clock::now() > end; }));

    EXPECT_TRUE(agent.sees("operator no longer has control of /: it is gone"));
}

}  // namespace
}  // namespace cortex::comms
