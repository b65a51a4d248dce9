// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_tools.hpp"

#include "wire/ids.hpp"

#include <chrono>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using namespace std::chrono_literals;

const Moment begin{1h};

Presence of(const std::string& name, std::vector<Extra> extras, std::int64_t epoch = 1) {
    Presence presence;
    presence.agent = agentId(name);
    presence.name = name;
    presence.host = "desk";
    presence.epoch = epoch;
    presence.role = "tool";
    presence.state = "running";
    presence.interval = 100'000'000;
    presence.extras = std::move(extras);
    return presence;
}

Presence usedBy(const std::string& name, const std::string& person) {
    return of(name, {{"person", person}});
}

struct MirrorToolsTest : testing::Test {
    std::vector<std::string> persons() const {
        std::vector<std::string> all;
        for (const ToolStatus& each : tools.list()) all.push_back(each.person);
        return all;
    }
    using Names = std::vector<std::string>;
    MirrorTools tools{"self"};
};

TEST_F(MirrorToolsTest, AreThoseOfOthersThatSayWhoUsesThem) {
    tools.take(usedBy("window", "Zoë"), begin);
    tools.take(usedBy("self", "me"), begin);
    tools.take(of("verb", {}), begin);
    Presence agent = usedBy("robot", "alice");
    agent.role = "agent";
    tools.take(agent, begin);
    ASSERT_EQ(tools.list().size(), 1U);
    const ToolStatus tool = tools.list().front();
    EXPECT_EQ(tool.name, "window");
    EXPECT_EQ(tool.host, "desk");
    EXPECT_EQ(tool.person, "Zoë");
    EXPECT_EQ(tool.asks, ControlAsk{});
}

TEST_F(MirrorToolsTest, SayOnlyWhatCanBeTheNameOfAPerson) {
    tools.take(usedBy("lines", "alice\nbob"), begin);
    tools.take(usedBy("long", std::string(64, 'a')), begin);
    tools.take(usedBy("latin", "Zo\xeb"), begin);
    tools.take(usedBy("none", ""), begin);
    tools.take(usedBy("blank", " "), begin);
    tools.take(usedBy("brackets", "alice (window)"), begin);
    Presence forged = usedBy("window", "alice");
    forged.agent = agentId("other");
    tools.take(forged, begin);
    EXPECT_TRUE(tools.list().empty());
    tools.take(usedBy("longest", std::string(63, 'a')), begin);
    EXPECT_EQ(tools.list().size(), 1U);
}

TEST_F(MirrorToolsTest, SayWhatTheyAskForAndRefuse) {
    const ToolWords words{"alice", {7, "/arm/left"}, {{"shell@desk 1", 3}, {"other", 12}}};
    tools.take(of("window", words.extras()), begin);
    ASSERT_EQ(tools.list().size(), 1U);
    const ToolStatus tool = tools.list().front();
    EXPECT_EQ(tool.asks, words.asks);
    EXPECT_EQ(tool.refuses, words.refuses);
    tools.take(usedBy("window", "alice"), begin);
    EXPECT_EQ(tools.list().front().asks, ControlAsk{});
}

TEST_F(MirrorToolsTest, AskForNothingWhereTheirWordsAreNoAsk) {
    for (const char* each : {"", "7", "7 ", "/arm", "0 /arm", "x /arm", "7 arm", "-7 /arm",
                             "99999999999999999999 /arm", "7 /arm\x1b[2J", "7/arm", "7 //",
                             "7 /arm/", "7 /arm//left", "7 /arm left"}) {
        tools.take(of("window", {{"person", "alice"}, {"asks", each}}), begin);
        EXPECT_EQ(tools.list().front().asks, ControlAsk{}) << each;
    }
    const std::string tooLong = "1 /" + std::string(127, 'a');
    tools.take(of("window", {{"person", "alice"}, {"asks", tooLong}}), begin);
    EXPECT_EQ(tools.list().front().asks, ControlAsk{});
    std::vector<Extra> many{{"person", "alice"}, {"refuses", "x"}};
    for (int i = 1; i < 100; ++i) many.push_back({"refuses", std::to_string(i) + " other"});
    tools.take(of("window", many), begin);
    EXPECT_EQ(tools.list().front().refuses.size(), 8U);
}

TEST_F(MirrorToolsTest, AreGoneWhenTheyAreSilentOrSaidGoodbye) {
    tools.take(usedBy("one", "alice"), begin);
    tools.take(usedBy("two", "bob"), begin);
    Presence goodbye = usedBy("two", "bob");
    goodbye.state = "stopping";
    tools.take(goodbye, begin);
    tools.tick(begin + 200ms);
    EXPECT_EQ(persons(), (Names{"alice", "bob"})) << "nobody ends another by a word in its name";
    tools.tick(begin + 400ms);
    EXPECT_EQ(persons(), Names{"alice"});
    tools.tick(begin + 1000ms);
    EXPECT_EQ(persons(), Names{"alice"});
    tools.excuse(2s, begin + 3s);
    tools.tick(begin + 3s);
    EXPECT_EQ(persons(), Names{"alice"}) << "this process stood still";
    tools.tick(begin + 4s);
    EXPECT_EQ(persons(), Names{});
}

TEST_F(MirrorToolsTest, KeepTheirNameWhileTheyAreHeard) {
    tools.take(usedBy("window", "alice"), begin);
    tools.take(of("window", {{"person", "mallory"}}, 2), begin + 200ms);
    EXPECT_EQ(persons(), Names{"alice"});
    tools.take(of("window", {{"person", "mallory"}}, 2), begin + 400ms);
    EXPECT_EQ(persons(), Names{"mallory"}) << "the other one is silent";
}

TEST_F(MirrorToolsTest, AreBoundedInTheirNumber) {
    for (int i = 0; i < 3000; ++i) tools.take(usedBy(std::to_string(i), "alice"), begin);
    EXPECT_EQ(tools.list().size(), 1024U);
}

}  // namespace
}  // namespace cortex::comms
