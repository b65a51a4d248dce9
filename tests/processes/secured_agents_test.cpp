// SPDX-License-Identifier: Apache-2.0
// The case study with security on, and who looks at it: agents and tools as processes of their own,
// with folders that `cortex security` made.
#include "cli/cortex_process.hpp"
#include "comms/inbox.hpp"
#include "comms/secured_plant.hpp"
#include "processes/agent_process.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cortex::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

enum Exit { Done = 0, Refused = 1, NobodyFound = 3 };

class SecuredAgents : public testing::Test {
protected:
    SecuredAgents() {
        make({"create-authority"});
        for (const char* agent : {"operator", "robot", "station"}) make({"create-agent", agent});
    }

    void make(Words arguments) const {
        arguments.insert(arguments.begin(), "security");
        const Outcome outcome = cortex(arguments, {}, folder.path().string());
        EXPECT_EQ(outcome.exit, Done) << outcome.errors;
    }
    std::string keys(const std::string& name) const { return (folder.path() / name).string(); }

    // An agent of the case study; slow, as busy machines with few cores run the tests too.
    AgentProcess start(const std::string& name, Words options = {}) const {
        const Words more{"--security", keys(name), "--startup", "--frequency", "200"};
        options.insert(options.end(), more.begin(), more.end());
        return {folder, CORTEX_SOURCE_DIR "/examples/lbr_teleop/" + name + ".xml", options};
    }
    // A tool with the keys of that folder; "": with none.
    static Words onNetwork(Words arguments, const std::string& timeout) {
        const comms::NetworkOptions network = comms::loopback();
        arguments.insert(arguments.end(),
                         {"--domain", std::to_string(network.domain), "--interface",
                          network.interfaces.front(), "--timeout", timeout});
        return arguments;
    }
    Outcome tool(const Words& arguments, const std::string& name = "station",
                 const std::string& timeout = "60") const {
        return cortex(onNetwork(arguments, timeout),
                      {{"CORTEX_SECURITY", name.empty() ? "" : keys(name)}});
    }
    json shown(const std::string& path) const {
        const Outcome seen = tool({"show", path, "--json"}, "station", "20");  // and again
        const json simplex = json::parse(seen.output, nullptr, false);
        return simplex.is_object() ? simplex : json::object();
    }
    json value(const std::string& path, const std::string& item) const {
        return shown(path)["data"][item]["value"];
    }
    bool isEvent(const std::string& text) const {
        const Words events{"events", "--severity", "warning"};
        return comms::comesTrue([&] { return contains(tool(events).output, text); });
    }

    const ModelFolder folder;
};

// Moves all the time, and presses once in its two seconds.
std::string movingHand() {
    std::ostringstream text;
    text << "time,x,y,z,qx,qy,qz,qw,trigger\n";
    for (int i = 0; i <= 200; ++i) {
        const double way = 0.03 * (1 - std::cos(std::numbers::pi * i / 50.0));
        text << i / 100.0 << ",0.35," << way - 0.2 << ",1.05,0,0,0,1," << (i >= 20 && i < 180)
             << '\n';
    }
    return text.str();
}

// Names of the agents listed, each of which has security.
Words namesIn(const Outcome& outcome) {
    Words names;
    const json list = json::parse(outcome.output, nullptr, false);
    if (!list.is_array()) return names;
    for (const json& each : list) {
        EXPECT_EQ(each["security"], "authenticated, encrypted") << each;
        names.push_back(each["name"]);
    }
    return names;
}

TEST_F(SecuredAgents, FollowEachOtherAndAreSeenAndCommandedByTools) {
    const std::string path = folder.write("path.csv", movingHand()).string();
    const AgentProcess robot = start("robot");
    const AgentProcess operator_ = start("operator", {"--set", "/playback.file=" + path});

    EXPECT_TRUE(comms::comesTrue([&] { return value("/tracking", "time") > 0.1; }))
        << robot.output() << operator_.output();
    EXPECT_EQ(namesIn(tool({"agents", "--json"})), (Words{"operator", "robot"}));
    EXPECT_TRUE(contains(tool({"doctor"}).output, "security authenticated, encrypted"));
    EXPECT_EQ(tool({"set", "/control/selector", "stillTime=0.25"}).exit, Done) << robot.output();
    EXPECT_EQ(value("/control/selector", "stillTime"), 0.25);
    const Outcome stopped = tool({"call", "/playback", "shutdown"});
    EXPECT_EQ(stopped.exit, Done) << stopped.output << stopped.errors << operator_.output();
    EXPECT_EQ(tool({"watch", "/playback.state", "/tracking.time", "--count", "2"}).exit, Done);
}
TEST_F(SecuredAgents, AreNotSeenOrCommandedWithoutACertificateOfTheirAuthority) {
    make({"create-authority", "elsewhere"});
    make({"create-agent", "stranger", "--authority", "elsewhere"});
    const AgentProcess operator_ = start("operator");
    ASSERT_EQ(namesIn(tool({"agents", "--json"})), Words{"operator"}) << operator_.output();

    const Words look = onNetwork({"agents"}, "2");
    const Words call = onNetwork({"call", "/playback", "shutdown"}, "2");
    Words lookOfStranger = look, callOfStranger = call;
    for (Words* each : {&lookOfStranger, &callOfStranger})
        each->insert(each->end(), {"--security", keys("stranger")});
    for (const Outcome& seen :
         cortexAtOnce({look, call, lookOfStranger, callOfStranger}, {{"CORTEX_SECURITY", ""}})) {
        EXPECT_EQ(seen.exit, NobodyFound) << seen.output;
        EXPECT_TRUE(contains(seen.errors, "no agent on domain")) << seen.errors;
    }
    EXPECT_TRUE(isEvent("it has no certificate of our authority")) << operator_.output();
    EXPECT_TRUE(comms::comesTrue([&] { return shown("/playback")["state"] == "Active"; }));
}

TEST_F(SecuredAgents, RefuseCommandsBeyondTheRightsOfATool) {
    make({"create-agent", "eye", "--read-only"});
    make({"create-agent", "desk", "--may-command", "/handset", "/playback"});
    const AgentProcess operator_ = start("operator");
    ASSERT_TRUE(comms::comesTrue([&] { return shown("/playback")["state"] == "Active"; }))
        << operator_.output();
    ASSERT_EQ(tool({"call", "/playback", "shutdown"}, "desk").exit, Done) << operator_.output();

    const Outcome looked = tool({"call", "/playback", "startup"}, "eye");
    EXPECT_EQ(looked.exit, Refused);
    EXPECT_TRUE(contains(looked.output + looked.errors, "authority): it may only look"))
        << looked.output << looked.errors;
    EXPECT_FALSE(contains(looked.errors, "--take")) << "control is not what it lacks";
    EXPECT_TRUE(contains(looked.errors, "gives it no such right")) << looked.errors;
    const Outcome beyond = tool({"call", "/operator", "startup", "prefix=/"}, "desk");
    EXPECT_EQ(beyond.exit, Refused);
    EXPECT_TRUE(contains(beyond.output + beyond.errors, "ends at /handset, /playback"))
        << beyond.output << beyond.errors;
    EXPECT_TRUE(isEvent("refused: it may only look"));
    EXPECT_TRUE(isEvent("refused: its authority ends at /handset, /playback"));
    EXPECT_EQ(shown("/playback")["state"], "Standby");
}

// A tool gives up after its time, wherever the handshake is by then.
TEST_F(SecuredAgents, OutliveToolsThatLeaveAtAnyMoment) {
    const char* given = std::getenv("CORTEX_SECURED_JOINS");
    const int joins = given != nullptr ? std::stoi(given) : 12;
    const AgentProcess robot = start("robot");
    const auto epoch = [this] {
        const json list = json::parse(tool({"agents", "--json"}).output, nullptr, false);
        return list.is_array() && list.size() == 1 ? list[0]["epoch"] : json{};
    };
    const json before = epoch();
    ASSERT_FALSE(before.is_null()) << robot.output();

    std::mt19937 random{4711};
    std::uniform_real_distribution<double> seconds{0.01, 0.5};
    for (int i = 0; i < joins; ++i) {
        const Words watch{"watch", "/robot", "--count", "1"};
        tool(i % 2 == 0 ? watch : Words{"agents"}, "station", std::to_string(seconds(random)));
    }
    EXPECT_EQ(epoch(), before) << robot.output();
}

TEST_F(SecuredAgents, DoNotStartWithAFolderThatWasChanged) {
    const std::filesystem::path robot = keys("robot");
    comms::tamper(robot / "permissions.smime", "cortex/*", "*");
    std::filesystem::permissions(robot / "key.pem", std::filesystem::perms::others_read,
                                 std::filesystem::perm_options::add);

    AgentProcess agent = start("robot", {"--seconds", "20"});

    EXPECT_EQ(agent.waitForEnd(), 1);
    EXPECT_TRUE(contains(agent.output(), "permissions.smime was changed")) << agent.output();
    EXPECT_TRUE(contains(agent.output(), "key.pem")) << agent.output();
}

}  // namespace
}  // namespace cortex::test
