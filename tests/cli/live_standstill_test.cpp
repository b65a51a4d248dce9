// SPDX-License-Identifier: Apache-2.0
// What the tools say of a loop that hangs while they begin to look, and of one that is too slow.
#include "cli/hung_agent.hpp"
#include "cli/json_schema.hpp"
#include "cli/live_agent.hpp"

#include <string>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;

TEST(LiveStandstill, IsShownByEveryToolWithTheHookAndTheTime) {
    HungAgent robot{std::stoi(domain)};
    robot.hang();
    const std::string where = "hangs in /ctl.stateStandby for ";
    const json agents = liveJson({"agents"}, "agents");
    ASSERT_EQ(agents.size(), 1U);
    EXPECT_EQ(agents[0]["state"], "standstill");
    EXPECT_TRUE(std::string{agents[0]["standstill"]}.starts_with(where)) << agents;
    EXPECT_GE(agents[0]["age_ms"], 100) << "that of its loop";

    const Outcome list = live({"list"});
    EXPECT_TRUE(contains(list.errors, "robot " + where)) << list.errors;
    EXPECT_TRUE(contains(list.output, "stale")) << list.output;
    EXPECT_FALSE(contains(list.output, "good")) << list.output;

    const json shown = liveJson({"show", "/ctl"}, "show");
    EXPECT_EQ(shown["quality"], "stale");
    EXPECT_GE(shown["age_ms"], 100);
    EXPECT_TRUE(contains(live({"show", "/ctl"}).output, "robot, " + where));

    const json top = liveJson({"top", "--once"}, "top");
    EXPECT_EQ(top["agents"][0]["state"], "standstill");
    EXPECT_EQ(top["tasks"][0]["path"], "/ctl");
    const Outcome screen = live({"top", "--once"});
    EXPECT_TRUE(contains(screen.output, "robot " + where)) << screen.output;
    EXPECT_TRUE(contains(screen.output, "tasks us  /ctl ")) << screen.output;

    EXPECT_TRUE(contains(live({"doctor"}).output, "the loop of robot on ")) << "an error";
}

TEST(LiveOverload, IsShownByEveryToolWithTheRateAndTheNominalOne) {
    HungAgent robot{std::stoi(domain)};
    robot.overload();
    const std::string where = "is overloaded: it runs at ";
    const json agents = liveJson({"agents"}, "agents");
    ASSERT_EQ(agents.size(), 1U);
    EXPECT_EQ(agents[0]["state"], "overloaded");
    EXPECT_LT(agents[0]["rate_hz"], 180) << agents;
    EXPECT_TRUE(contains(live({"agents"}).output, " of 200 Hz"));
    EXPECT_TRUE(contains(live({"list"}).errors, "robot " + where));
    EXPECT_EQ(liveJson({"show", "/ctl"}, "show")["overloaded"], true);
    EXPECT_TRUE(contains(live({"show", "/ctl"}).output, "robot, " + where));
    EXPECT_EQ(liveJson({"top", "--once"}, "top")["agents"][0]["state"], "overloaded");
    const Outcome screen = live({"top", "--once"});
    EXPECT_TRUE(contains(screen.output, "robot " + where)) << screen.output;
    EXPECT_TRUE(contains(screen.output, " of 200 Hz")) << screen.output;
    EXPECT_TRUE(contains(live({"doctor"}).output, where)) << "an error";
}

TEST(LiveStandstill, IsWhyACallHasNoAnswer) {
    HungAgent robot{std::stoi(domain)};
    robot.hang();

    const Outcome call = cortex(std::vector<std::string>{"call", "/ctl", "startup"} + network +
                                std::vector<std::string>{"--timeout", "5"});

    EXPECT_EQ(call.exit, 3) << call.output;
    EXPECT_TRUE(contains(call.output, "the loop of robot hangs in /ctl.stateStandby for "))
        << call.output << call.errors;
}

TEST(LiveStandstill, IsOverWhenTheHookReturns) {
    HungAgent robot{std::stoi(domain)};
    robot.hang();
    robot.release();

    EXPECT_EQ(liveJson({"agents"}, "agents")[0]["state"], "running");
    EXPECT_EQ(live({"list"}).errors, "");
}

}  // namespace
}  // namespace cortex::test
