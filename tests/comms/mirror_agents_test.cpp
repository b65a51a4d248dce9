// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_agents.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"

#include "comms/told_agent.hpp"
#include "peers/sent_commands.hpp"
#include "wire/ids.hpp"
#include "wire/named_values.hpp"
#include "wire/presence_extras.hpp"

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using namespace std::chrono_literals;

const MirrorView everything = viewOf({{{"/"}, 30}});
constexpr std::size_t at30 = 2;  // stream
const MirrorView nothing{};
const Moment begin{1h};

class MirrorAgentsTest : public testing::Test {
protected:
    void tellAll() {
        for (const Model& model : agent.models) agents.take(model, begin);
        agents.take(agent.presence, begin);
    }
    AgentStatus status(Moment now = begin) { return agents.find("rig")->status(now); }

    ToldAgent agent;
    std::vector<std::string> lost;
    MirrorAgents agents{[this](const MirrorAgent& each, const char* why) {
        lost.push_back(each.model.agent() + ": " + why);
    }};
};

TEST_F(MirrorAgentsTest, AreIncompleteUntilAllIsThere) {
    EXPECT_FALSE(agents.complete()) << "nobody is there";
    agents.take(agent.presence, begin);
    EXPECT_EQ(status().state, "incomplete");
    EXPECT_EQ(status().missing, agent.presence.types + agent.presence.simplexes);
    EXPECT_FALSE(agents.complete());

    tellAll();

    EXPECT_EQ(status().state, "running");
    EXPECT_EQ(status().simplexes, agent.presence.simplexes);
    EXPECT_TRUE(agents.complete());
    EXPECT_TRUE(agents.find("rig")->structure);
}

TEST_F(MirrorAgentsTest, KnowFromEachAgentHowManyThereAre) {
    agent.presence.extras = {{"other", "9"}, {agentsHeard, "2"}};
    tellAll();
    EXPECT_EQ(agents.unheard(), 1U) << "rig hears one that is not here";
    EXPECT_EQ(status().hears, 2U);
    agent.presence.extras = {{agentsHeard, "1"}};
    tellAll();
    EXPECT_EQ(agents.unheard(), 0U);

    agent.presence.extras = {{agentsHeard, "2"}};
    tellAll();
    agents.withdraw(agent.presence.agent);
    agents.tick(nothing, begin + 301ms);
    EXPECT_EQ(agents.unheard(), 0U) << "what is lost says nothing";
    agent.presence.extras = {{agentsHeard, "x"}};
    tellAll();
    EXPECT_EQ(agents.unheard(), 0U);
}

TEST_F(MirrorAgentsTest, AreLostAfterASecondAndForgottenAfterAMinute) {
    tellAll();

    agents.tick(nothing, begin + 1s);
    EXPECT_EQ(status().state, "running");
    agents.tick(nothing, begin + 1001ms);
    EXPECT_EQ(status().state, "lost");
    EXPECT_EQ(lost, std::vector<std::string>{}) << "commands wait: it may only stand still";
    EXPECT_TRUE(agents.missesAny());
    EXPECT_FALSE(agents.hearsAny());
    EXPECT_TRUE(agents.awaitsAny(begin + 14999ms)) << "it may only stand still";
    EXPECT_FALSE(agents.awaitsAny(begin + 15s));
    agents.tick(nothing, begin + 60s);
    EXPECT_EQ(lost.size(), 0U);
    ASSERT_NE(agents.find("rig"), nullptr);
    agents.tick(nothing, begin + 62s);
    EXPECT_EQ(lost, std::vector<std::string>{"rig: the agent was not heard for a minute"});
    EXPECT_EQ(agents.find("rig"), nullptr);
}

TEST_F(MirrorAgentsTest, ThatWereSilentMayStillEndOrBeReplaced) {
    tellAll();
    agents.tick(nothing, begin + 2s);
    agents.withdraw(agent.presence.agent);
    agents.tick(nothing, begin + 2s);
    agents.tick(nothing, begin + 62s);
    EXPECT_EQ(lost, std::vector<std::string>{"rig: the agent has ended"}) << "once";

    lost.clear();
    tellAll();
    agents.tick(nothing, begin + 2s);
    ++agent.presence.epoch;
    agents.take(agent.presence, begin + 2s);
    EXPECT_EQ(lost, std::vector<std::string>{"rig: another start of it has taken its place"});
}

TEST_F(MirrorAgentsTest, AreNotLostWhileThisProcessStandsStill) {
    tellAll();
    agents.excuse(30s, begin + 30s);
    agents.tick(nothing, begin + 30s);
    EXPECT_EQ(status().state, "running");
    EXPECT_EQ(lost, std::vector<std::string>{});

    agents.tick(nothing, begin + 31001ms);
    EXPECT_EQ(status().state, "lost") << "it was silent after it as well";
}

TEST_F(MirrorAgentsTest, KeepTheirLastValuesWhenTheyAreLost) {
    tellAll();
    agents.tick(everything, begin);
    agent.worker->data<double>("gain") = 7.0;
    agent.rig.step();
    agents.take(agent.block(1), at30, begin);
    const std::uint32_t worker = agents.find("rig")->structure->find("/work/one");
    EXPECT_FALSE(agents.find("rig")->image().lost());

    agents.tick(everything, begin + 2s);

    const AgentImage last = agents.find("rig")->image();
    EXPECT_TRUE(last.lost());
    EXPECT_TRUE(last.came(worker));
    EXPECT_EQ(last->get<double>("/work/one", "gain"), 7.0);
    EXPECT_EQ(last->state(worker).quality, Quality::Lost);
    EXPECT_TRUE(agents.find("rig")->tables->age(worker, begin + 2s));
}

TEST_F(MirrorAgentsTest, KeepTheirLastValuesAlsoWhenTheyWereNotViewedAnyLonger) {
    tellAll();
    agents.tick(everything, begin);
    agents.take(agent.block(1), at30, begin);
    const std::uint32_t worker = agents.find("rig")->structure->find("/work/one");

    agents.view(nothing);
    EXPECT_FALSE(agents.find("rig")->image()) << "nothing of it is viewed";
    EXPECT_FALSE(agents.find("rig")->tables->age(worker, begin));
    agents.tick(nothing, begin + 2s);

    EXPECT_TRUE(agents.find("rig")->image().came(worker));
    EXPECT_TRUE(agents.find("rig")->tables->age(worker, begin + 2s));
}

TEST_F(MirrorAgentsTest, AreBackWhenTheyAreHeardAgain) {
    tellAll();
    agents.tick(nothing, begin + 2s);

    agents.take(agent.presence, begin + 3s);

    EXPECT_EQ(status(begin + 3s).state, "running");
    EXPECT_TRUE(agents.find("rig")->structure);
}

// Cut off for longer: nobody tells it again what has come.
TEST_F(MirrorAgentsTest, AreBackWithTheirModelAfterTheyWereForgotten) {
    tellAll();
    agents.tick(nothing, begin + 62s);
    ASSERT_EQ(agents.find("rig"), nullptr);

    agents.take(agent.presence, begin + 63s);

    EXPECT_EQ(status(begin + 63s).state, "running");
    EXPECT_TRUE(agents.find("rig")->structure);
}

TEST_F(MirrorAgentsTest, AreLostSoonAfterTheySayGoodbye) {
    tellAll();
    agents.withdraw(agentId("rig"));
    agents.tick(nothing, begin + 301ms);
    EXPECT_EQ(status().state, "lost");

    agents.take(agent.presence, begin + 1s);
    Presence last = agent.presence;
    last.state = "stopping";
    agents.take(last, begin + 1s);
    agents.tick(nothing, begin + 1301ms);
    EXPECT_EQ(status().state, "lost");
    EXPECT_EQ(lost.size(), 2U);
}

TEST_F(MirrorAgentsTest, StayWhenOthersSayGoodbyeInTheirName) {
    tellAll();
    Presence forged = agent.presence;
    forged.state = "stopping";
    for (int tenth = 1; tenth <= 20; ++tenth) {
        const Moment now = begin + tenth * 100ms;
        agents.take(forged, now - 50ms);
        agents.withdraw(agentId("rig"));
        agents.tick(nothing, now - 1ms);
        agents.take(agent.presence, now);
        EXPECT_EQ(status(now).state, "running");
    }
    EXPECT_TRUE(lost.empty());
}

TEST_F(MirrorAgentsTest, AreReplacedByAnotherStartOnlyWhenTheyAreSilent) {
    tellAll();
    const auto structure = agents.find("rig")->structure;
    Presence later = agent.presence;
    ++later.epoch;
    agents.take(later, begin + 300ms);
    EXPECT_EQ(status().epoch, agent.presence.epoch);
    EXPECT_TRUE(lost.empty());

    agents.take(later, begin + 301ms);

    EXPECT_EQ(status().epoch, later.epoch);
    EXPECT_EQ(status().missing, agent.presence.types + agent.presence.simplexes);
    EXPECT_FALSE(agents.find("rig")->structure);
    EXPECT_EQ(lost.size(), 1U);
    tellAll();
    EXPECT_EQ(status().epoch, later.epoch);
    EXPECT_FALSE(agents.find("rig")->structure);
    EXPECT_NE(structure->find("/work/one"), noSimplex) << "its readers keep it";
}

// Its clock was set back between two starts; its models come once.
TEST_F(MirrorAgentsTest, AreReplacedByAnEarlierStartOnceTheyAreLost) {
    tellAll();
    const std::int64_t before = agent.presence.epoch;
    agent.presence.epoch -= 1'000'000;
    for (Model& model : agent.models) model.epoch = agent.presence.epoch;
    tellAll();
    EXPECT_EQ(status().epoch, before);

    agents.tick(nothing, begin + 1001ms);
    agents.take(agent.presence, begin + 1001ms);

    EXPECT_EQ(status().epoch, agent.presence.epoch);
    EXPECT_EQ(status(begin + 1001ms).state, "running");
    EXPECT_TRUE(agents.find("rig")->structure);
}

TEST_F(MirrorAgentsTest, OfAnotherProtocolAreShownAndNotWaitedFor) {
    agent.presence.majors = {2, 3};
    agents.take(agent.presence, begin);

    EXPECT_EQ(status().state, "incomplete");
    EXPECT_NE(status().trouble, "");
    EXPECT_TRUE(agents.complete());
}

TEST_F(MirrorAgentsTest, ThatContradictThemselvesSayHow) {
    agent.lie("/boss", [](SimplexMessage& boss) { boss.role = "observation"; });
    tellAll();

    EXPECT_EQ(status().state, "incomplete");
    EXPECT_NE(status().trouble.find("/boss"), std::string::npos) << status().trouble;
    EXPECT_FALSE(agents.find("rig")->structure);
}

TEST_F(MirrorAgentsTest, SayWhereTheirLoopHangsAndHowLong) {
    agent.presence.extras = {{clockOfAgent, "9000000000"},
                             {ageOfLoop, "8400000000"},
                             {standstill, "hangs in /ctl.stateActive"},
                             {timeStood, "8400000000"}};
    tellAll();

    EXPECT_EQ(status(begin + 100ms).state, "standstill");
    EXPECT_EQ(status(begin + 100ms).standstill, "hangs in /ctl.stateActive for 8.5 s");
    EXPECT_DOUBLE_EQ(status(begin + 100ms).age, 8.5) << "of the loop, not of the last message";

    agent.presence.extras = {{ageOfLoop, "0"}};
    tellAll();
    EXPECT_EQ(status().state, "running");
    EXPECT_EQ(status().standstill, "");
}

TEST_F(MirrorAgentsTest, SayHowFastTheirLoopReallyIsAndWhetherItIsOverloaded) {
    agent.presence.extras = {{rateOfLoop, "9100"}, {overloaded, "1"}};
    tellAll();
    EXPECT_EQ(status().state, "overloaded");
    EXPECT_TRUE(status().overloaded);
    EXPECT_DOUBLE_EQ(status().rate, 9.1);

    agent.presence.extras = {{rateOfLoop, "1000000"}};
    tellAll();
    EXPECT_EQ(status().state, "running");
    EXPECT_DOUBLE_EQ(status().rate, 1000);
}

TEST_F(MirrorAgentsTest, ValuesOfALoopThatStandsStillAreAsOldAsItsLastCycle) {
    agent.rig.step();
    Block again = agent.block(1);
    agent.presence.cycle = again.cycle;
    agent.presence.extras = {{ageOfLoop, "3000000000"}};
    tellAll();
    agents.tick(everything, begin);
    agents.take(again, at30, begin);
    MirrorTables& tables = *agents.find("rig")->tables;
    const std::uint32_t worker = tables.structure().find("/work/one");

    EXPECT_GE(*tables.age(worker, begin), 3);
    EXPECT_EQ(tables.newest().state(worker).quality, Quality::Stale) << "at the first look";
}

TEST_F(MirrorAgentsTest, HaveTablesOnceTheyAreViewedAndImagesWhileTheyAre) {
    tellAll();
    agents.tick(nothing, begin);
    EXPECT_FALSE(agents.find("rig")->tables);
    agents.tick(viewOf({{{"/elsewhere"}, 5}}), begin);
    EXPECT_FALSE(agents.find("rig")->tables);

    agents.tick(everything, begin);
    ASSERT_TRUE(agents.find("rig")->tables);
    EXPECT_FALSE(agents.valuesComplete(everything));
    agents.take(agent.block(1), at30, begin);
    EXPECT_TRUE(agents.valuesComplete(everything));

    EXPECT_TRUE(agents.find("rig")->image());

    agents.view(nothing);
    EXPECT_FALSE(agents.find("rig")->image());
    agents.view(everything);
    EXPECT_TRUE(agents.find("rig")->image());
    EXPECT_FALSE(agents.valuesComplete(everything)) << "what came before is not taken for new";
}

TEST_F(MirrorAgentsTest, CountEventsThatDidNotCome) {
    tellAll();
    EventMessage message;
    message.agent = agentId("rig");
    message.name = "rig";
    message.epoch = agent.epoch();
    message.severity = "warning";
    for (const std::uint64_t number : {7U, 8U, 11U}) {
        message.number = number;
        EXPECT_TRUE(agents.take(message));
    }
    EXPECT_EQ(status().loss, 2U);
    message.severity = "dreadful";
    EXPECT_FALSE(agents.take(message));
    message.severity = "error";
    message.agent[0] ^= 1U;
    EXPECT_FALSE(agents.take(message));
    EXPECT_EQ(agents.refused(), 2U);
}

TEST_F(MirrorAgentsTest, KnowWhetherThePastOfEachAgentHasCome) {
    agent.presence.extras = {{eventsWritten, "12"}};
    EventMessage message;
    message.agent = agentId("rig");
    message.name = "rig";
    message.epoch = agent.epoch() - 1;
    message.severity = "info";
    message.number = 20;
    EXPECT_TRUE(agents.take(message)) << "of a start before this one, and before it is known";
    tellAll();
    EXPECT_FALSE(agents.eventsComplete());
    message.epoch = agent.epoch();
    message.number = 11;
    EXPECT_TRUE(agents.take(message));
    EXPECT_FALSE(agents.eventsComplete());
    message.number = 12;
    EXPECT_TRUE(agents.take(message));
    EXPECT_TRUE(agents.eventsComplete());
    agent.presence.extras = {{eventsWritten, "13"}};
    tellAll();
    EXPECT_FALSE(agents.eventsComplete());
    agents.withdraw(agent.presence.agent);
    agents.tick(nothing, begin + 301ms);
    EXPECT_TRUE(agents.eventsComplete()) << "what is lost says nothing";
    EXPECT_FALSE(agents.awaitsAny(begin + 301ms)) << "it has ended";
}

class MirrorCommandsTest : public MirrorAgentsTest {
protected:
    MirrorCommandsTest() { tellAll(); }

    std::uint64_t send(const std::string& command, const Mirror::Arguments& arguments = {}) {
        return commands.send(agents.find("rig")->target(), "/work/one", command, arguments, 100ms,
                             begin);
    }
    void tick(Moment now) {
        commands.tick(now, [this](const Command& command) {
            sent.push_back(command);
            return true;
        });
    }
    Answer answer(const char* outcome) const {
        Answer message;
        message.agent = "rig";
        message.epoch = agent.epoch();
        message.sender = sender.nameText();
        message.senderEpoch = sender.epoch;
        message.sequenceNumber = sent.back().sequenceNumber;
        message.outcome = outcome;
        message.reason = name(Reason::None);
        message.latency = 1'500;
        return message;
    }

    Sender sender = makeSender("tool");
    SentCommands commands{sender};
    std::vector<Command> sent;
    CommandAnswer result;
};

TEST_F(MirrorCommandsTest, SayUntilWhenTheyAreValidByTheClockThatTheAgentTells) {
    send("add", {{"amount", Value{std::vector{2.0}}}});
    tick(begin);
    agent.presence.extras = {{clockOfAgent, "5000000000"}};
    agents.take(agent.presence, begin - 20ms);
    send("add", {{"amount", Value{std::vector{2.0}}}});
    tick(begin);

    ASSERT_EQ(sent.size(), 2U);
    EXPECT_TRUE(sent[0].extras.empty()) << "a loop that is stepped tells none";
    EXPECT_EQ(numberIn(sent[1], validUntil), 5'121'000'000U) << "20 ms, 100 ms and a cycle later";
}

TEST_F(MirrorCommandsTest, AreSentToAnAgentWhoseClockCannotBe) {
    agent.presence.extras = {{clockOfAgent, "18446744073709551615"}};
    tellAll();
    send("add", {{"amount", Value{std::vector{2.0}}}});
    tick(begin);

    ASSERT_EQ(sent.size(), 1U);
    EXPECT_GT(numberIn(sent[0], validUntil), 0U);
}

TEST_F(MirrorCommandsTest, AreRepeatedAsTheyAreUntilTheyAreAnswered) {
    const std::uint64_t number = send("add", {{"amount", Value{std::vector{2.0}}}});
    tick(begin);
    tick(begin + 1ms);
    ASSERT_EQ(sent.size(), 1U);
    EXPECT_EQ(sent[0].path, "/work/one");
    EXPECT_EQ(sent[0].command, "add");
    EXPECT_EQ(sent[0].arguments, namedValues({{"amount", std::vector{2.0}}}));
    EXPECT_EQ(sent[0].targetEpoch, agent.epoch());
    EXPECT_EQ(sent[0].notAfter, agent.presence.cycle + 100);  // at 1 kHz
    tick(begin + 20ms);
    ASSERT_EQ(sent.size(), 2U);
    EXPECT_EQ(sent[1], sent[0]);
    EXPECT_FALSE(commands.poll(number, result));

    Answer message = answer("Done");
    message.response = namedValues({{"sum", std::vector{5.0}}});
    commands.take(message);

    ASSERT_TRUE(commands.poll(number, result, &result.latency));
    EXPECT_EQ(result.outcome, Outcome::Done);
    EXPECT_EQ(result.response.at("sum"), Value(std::vector{5.0}));
    EXPECT_EQ(result.latency, 1500ns);
    EXPECT_FALSE(commands.poll(number, result)) << "once";
    EXPECT_FALSE(commands.waiting());
    tick(begin + 1s);
    EXPECT_EQ(sent.size(), 2U);
}

TEST_F(MirrorCommandsTest, ThatRunAreAskedForSlowlyUntilTheirEndIsKnown) {
    const std::uint64_t number = send("watch");
    tick(begin);
    commands.take(answer("Running"));
    EXPECT_TRUE(commands.running(number));
    std::vector<int> asked;  // ms
    for (int i = 1; i <= 5000; ++i) {
        tick(begin + i * 1ms);
        if (sent.size() > asked.size() + 1) asked.push_back(i);
        if (i == 700) commands.take(answer("Running"));
    }
    EXPECT_EQ(asked, (std::vector{200, 400, 800, 1600, 2600, 3600, 4600}));
    EXPECT_EQ(sent.back(), sent.front()) << "its number and its time are what they were";
    tick(begin + 1h);
    EXPECT_FALSE(commands.poll(number, result)) << "its time of 100 ms was for its begin";

    commands.take(answer("Cancelled"));
    ASSERT_TRUE(commands.poll(number, result));
    EXPECT_EQ(result.outcome, Outcome::Cancelled);
    EXPECT_FALSE(commands.waiting());
}

TEST_F(MirrorCommandsTest, ThatRanAndOfWhichTheAgentKnowsNothingMoreAreUnknown) {
    for (const Reason reason : {Reason::Authority, Reason::Window, Reason::UnknownCommand}) {
        const std::uint64_t number = send("watch");
        tick(begin);
        commands.take(answer("Running"));
        Answer refusal = answer("Rejected");
        refusal.reason = name(reason);
        refusal.why = "its list is over";
        commands.take(refusal);

        ASSERT_TRUE(commands.poll(number, result));
        EXPECT_EQ(result.text(),
                  "Unknown: it was running, and how it ended the agent does not say: its list is "
                  "over");
    }
    const std::uint64_t number = send("watch");
    tick(begin);
    commands.take(answer("Running"));
    Answer end = answer("Rejected");
    end.reason = name(Reason::State);
    commands.take(end);
    ASSERT_TRUE(commands.poll(number, result));
    EXPECT_EQ(result.outcome, Outcome::Rejected) << "an end that the agent itself gives";
}

// The agent lets all later ones wait for it.
TEST_F(MirrorCommandsTest, OldestWithoutAnAnswerIsSentMostOften) {
    send("poke");
    send("poke");
    for (int i = 0; i < 1000; ++i) tick(begin + i * 1ms);
    const auto sentOf = [&](std::uint64_t number) {
        return std::ranges::count(sent, number, &Command::sequenceNumber);
    };
    EXPECT_EQ(sentOf(1), 28) << "at 0, 5, 15, 35, 75, 115, … ms";
    EXPECT_EQ(sentOf(2), 10) << "at 0, 5, 15, 35, 75, 155, 315, 515, … ms";
    Answer message = answer("Done");
    message.sequenceNumber = 1;
    commands.take(message);
    sent.clear();
    for (int i = 1000; i < 1041; ++i) tick(begin + i * 1ms);

    EXPECT_EQ(sentOf(2), 4) << "at once, as it waited longer than 5 ms, and 5, 15, 35 ms later";
}

TEST_F(MirrorCommandsTest, UseNoNumberForWhatIsNotSent) {
    send("poke");
    auto target = agents.find("rig")->target();
    target.lost = true;
    const std::uint64_t number = commands.send(target, "/work/one", "poke", {}, 100ms, begin);
    send("poke");
    tick(begin);

    ASSERT_TRUE(commands.poll(number, result));
    EXPECT_EQ(result.outcome, Outcome::Expired);
    ASSERT_EQ(sent.size(), 2U);
    EXPECT_EQ(sent[1].sequenceNumber, 2U);
}

TEST_F(MirrorCommandsTest, AreUnknownWithoutAnAnswerInTheirTime) {
    const std::uint64_t number = send("poke");
    tick(begin + 1s);
    EXPECT_FALSE(commands.poll(number, result));

    tick(begin + 2s);

    ASSERT_TRUE(commands.poll(number, result));
    EXPECT_EQ(result.outcome, Outcome::Unknown);
}

TEST_F(MirrorCommandsTest, AreUnknownWhenTheirAgentIsLost) {
    const std::uint64_t number = send("poke");
    tick(begin);

    commands.lose("rig", "gone");

    ASSERT_TRUE(commands.poll(number, result));
    EXPECT_EQ(result.outcome, Outcome::Unknown);
    EXPECT_EQ(result.why, "gone");
}

TEST_F(MirrorCommandsTest, AreNotSentToAnAgentThatIsNotHeard) {
    agents.tick(nothing, begin + 2s);

    const std::uint64_t number = send("poke");

    EXPECT_FALSE(commands.waiting());
    ASSERT_TRUE(commands.poll(number, result));
    EXPECT_EQ(result.outcome, Outcome::Expired);
}

TEST_F(MirrorCommandsTest, BelieveOnlyAnswersToWhatTheyAsked) {
    const std::uint64_t number = send("poke");
    tick(begin);
    const std::vector<std::function<void(Answer&)>> faults{
        [](Answer& message) { message.sender = "other"; },
        [](Answer& message) { ++message.senderEpoch; },
        [](Answer& message) { message.agent = "other"; },
        [](Answer& message) { ++message.epoch; },
        [](Answer& message) { ++message.sequenceNumber; },
        [](Answer& message) { message.outcome = "Fine"; },
        [](Answer& message) { message.reason = "mood"; },
        [](Answer& message) { message.response.push_back({"x", "kind", {}, {}, {}, {}}); }};
    for (const auto& fault : faults) {
        Answer message = answer("Done");
        fault(message);
        commands.take(message);
    }
    EXPECT_FALSE(commands.poll(number, result));
    EXPECT_EQ(commands.refused(), 4U);
}

TEST_F(MirrorCommandsTest, RefuseUnknownNamesAndWrongKindsBeforeTheyAreSent) {
    EXPECT_THROW(send("dance"), Error);
    EXPECT_THROW(send("add", {{"amonut", Value{std::vector{1.0}}}}), Error);
    EXPECT_THROW(send("add", {{"amount", Value{std::vector<bool>{true}}}}), Error);
    EXPECT_FALSE(commands.waiting());
}

}  // namespace
}  // namespace cortex::comms
