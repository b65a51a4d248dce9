// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_past.hpp"

#include "comms/told_agent.hpp"
#include "wire/ids.hpp"
#include "wire/presence_extras.hpp"

#include <chrono>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using namespace std::chrono_literals;

const Moment begin{1h};

PastMessage partFor(const PastAsk& ask, std::uint64_t last, bool more) {
    PastMessage message;
    message.name = ask.agent;
    message.agent = agentId(ask.agent);
    message.epoch = 7;
    message.tool = "tool";
    message.ask = ask.number;
    message.after = ask.after;
    message.last = last;
    message.more = more;
    for (std::uint64_t place = ask.after + 1; place <= last; ++place) {
        message.events.push_back(
            {7, place, 1, 2, "info", "command", "/a", "text " + std::to_string(place)});
    }
    message.kept = {{"command", 5}, {"fault", 6}};
    return message;
}

struct MirrorPastTest : testing::Test {
    MirrorPastTest() { hear("rig"); }
    void hear(const std::string& name, const std::string& remembers = "1") {
        Presence presence = agent.presence;
        presence.name = name;
        presence.agent = agentId(name);
        if (!remembers.empty()) presence.extras.push_back({ofThePast, remembers});
        agents.take(presence, begin);
    }
    std::vector<PastAsk> asks(Moment now = begin) {
        past.tick(agents, now);
        std::vector<PastAsk> all;
        for (const std::string& each : past.words()) all.push_back(*pastAskFrom(each));
        return all;
    }
    std::optional<PastEvents> answer(std::uint64_t number) {
        PastEvents found;
        if (!past.poll(number, found)) return {};
        return found;
    }

    ToldAgent agent;
    MirrorAgents agents{[](const MirrorAgent&, const char*) {}};
    MirrorPast past{"tool"};
};

TEST(PastAskText, IsReadAsItWasWritten) {
    const PastAsk ask{3, -5, std::numeric_limits<std::int64_t>::max(), 9, "an agent"};
    EXPECT_EQ(textOf(ask), "3 -5 9223372036854775807 9 an agent");
    EXPECT_EQ(pastAskFrom(textOf(ask)), ask);
    for (const char* wrong : {"", "3", "3 4 5 6", "3 4 5 6 ", "0 1 2 3 a", "x 1 2 3 a",
                              "1 2 3 -4 a", "1  2 3 4 a", "99999999999999999999 1 2 3 a"}) {
        EXPECT_EQ(pastAskFrom(wrong), std::nullopt) << wrong;
    }
}

TEST_F(MirrorPastTest, ComesInPartsWithoutAGapOrADouble) {
    const std::uint64_t number = past.ask("rig", 10, 20);
    const auto first = asks();
    ASSERT_EQ(first.size(), 1U);
    EXPECT_EQ(first[0], (PastAsk{number, 10, 20, 0, "rig"}));

    past.take(partFor(first[0], 3, true), begin);
    past.take(partFor(first[0], 3, true), begin);  // said again, before the tool could ask on
    EXPECT_EQ(answer(number), std::nullopt);
    const auto second = asks();
    ASSERT_EQ(second.size(), 1U);
    EXPECT_EQ(second[0].after, 3U);
    past.take(partFor(second[0], 5, false), begin);

    EXPECT_TRUE(asks().empty());
    const auto all = answer(number);
    ASSERT_TRUE(all);
    EXPECT_EQ(all->trouble, "");
    EXPECT_EQ(all->agent, "rig");
    ASSERT_EQ(all->events.size(), 5U);
    for (std::uint64_t i = 0; i < 5; ++i) EXPECT_EQ(all->events[i].number, i + 1);
    ASSERT_EQ(all->since.size(), 2U);
    EXPECT_EQ(all->since[1].kind, "fault");
    EXPECT_EQ(all->since[1].time, 6);
    EXPECT_EQ(answer(number), std::nullopt) << "it is told once";
}

TEST_F(MirrorPastTest, TakesNothingThatItDidNotAskFor) {
    const std::uint64_t number = past.ask("rig", 10, 20);
    const PastAsk ask = asks().front();
    const PastMessage good = partFor(ask, 1, false);
    PastMessage other = good;
    other.tool = "another";
    past.take(other, begin);
    other = good;
    other.ask = 99;
    past.take(other, begin);
    other = good;
    other.after = 1;
    past.take(other, begin);
    other = good;
    other.agent = agentId("zoo");
    past.take(other, begin);
    other.name = "zoo";
    past.take(other, begin);
    EXPECT_EQ(answer(number), std::nullopt);

    other = good;
    other.more = true;
    other.last = ask.after;  // it would go on for ever
    past.take(other, begin);
    EXPECT_EQ(past.refused(), 1U);
    other = good;
    other.events[0].severity = "terrible";
    past.take(other, begin);
    EXPECT_EQ(past.refused(), 2U);
    ASSERT_TRUE(answer(number));
}

TEST_F(MirrorPastTest, BeginsAnewWhereTheAgentWasStartedAnew) {
    const std::uint64_t number = past.ask("rig", 10, 20);
    past.take(partFor(asks().front(), 3, true), begin);
    PastMessage later = partFor(asks().front(), 4, false);
    later.epoch = 8;
    past.take(later, begin);
    EXPECT_EQ(answer(number), std::nullopt);

    const PastAsk again = asks().front();
    EXPECT_EQ(again.after, 0U);
    PastMessage all = partFor(again, 2, false);
    all.epoch = 8;
    past.take(all, begin);
    const auto found = answer(number);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->events.size(), 2U);
}

TEST_F(MirrorPastTest, SaysWhyNothingComes) {
    hear("old", "");
    const std::uint64_t old = past.ask("old", 0, 9), none = past.ask("nobody", 0, 9);
    const std::uint64_t slow = past.ask("rig", 0, 9);
    past.take(partFor(asks().front(), 3, true), begin + 4s);
    EXPECT_EQ(answer(old)->trouble, "it was built before agents kept a memory");
    EXPECT_EQ(answer(none)->trouble, "it is not heard");

    hear("rig");
    agents.find("rig")->heard = begin + 9001ms;
    past.tick(agents, begin + 9s);
    EXPECT_EQ(answer(slow), std::nullopt) << "each part has its time";
    past.tick(agents, begin + 9001ms);
    const auto late = answer(slow);
    ASSERT_TRUE(late);
    EXPECT_EQ(late->trouble, "it did not answer within 5 s");
    EXPECT_EQ(late->events.size(), 3U) << "what came is there";
}

TEST_F(MirrorPastTest, AsksFewAtOnceAndAnAgentOnce) {
    std::vector<std::uint64_t> numbers{past.ask("rig", 0, 1)};
    for (const char* each : {"a", "b", "c", "d", "e"}) {
        hear(each);
        numbers.push_back(past.ask(each, 0, 1));
    }
    numbers.push_back(past.ask("rig", 2, 3));
    std::size_t answered = 0;
    while (answered < numbers.size()) {
        const auto now = asks();
        ASSERT_FALSE(now.empty());
        EXPECT_LE(now.size(), 4U);
        for (const PastAsk& each : now) past.take(partFor(each, 1, false), begin);
        for (std::uint64_t& each : numbers) answered += answer(each) ? 1 : 0;
    }
    EXPECT_FALSE(past.waiting());
}

TEST_F(MirrorPastTest, AsksNoLongerForWhatNobodyWillFetch) {
    const std::uint64_t number = past.ask("rig", 0, 9);
    past.take(partFor(asks().front(), 3, true), begin);
    EXPECT_EQ(past.giveUp(number).events.size(), 3U);
    EXPECT_TRUE(asks().empty());
    EXPECT_EQ(answer(number), std::nullopt);
    EXPECT_TRUE(past.giveUp(number).events.empty());
}

}  // namespace
}  // namespace cortex::comms
