// SPDX-License-Identifier: Apache-2.0
// What the tools say of a loop that hangs while they begin to look, and of one that is too slow.
#include "cli/controlled_agent.hpp"
#include "cli/hung_agent.hpp"
#include "cli/json_schema.hpp"
#include "cli/live_agent.hpp"
#include "cli/on_terminal.hpp"

#include <chrono>
#include <csignal>
#include <memory>
#include <string>
#include <vector>

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

class CortexSilence : public CortexLive {
protected:
    CortexSilence() : CortexLive{"AxisPoseController"} {}

    // A move of minutes that a call waits for so long, once it is seen to run.
    std::unique_ptr<OnTerminal> longMove(const std::string& timeout) const {
        EXPECT_EQ(live({"call", "/mixer", "startup"}).exit, 0);
        EXPECT_EQ(live({"set", "/controller", "pose=1e5 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0"}).exit, 0);
        const std::vector<std::string> move{"call",      "/controller", "moveTo", "speedShare=0.01",
                                            "--timeout", timeout};
        return lookUntil([&] { return std::make_unique<OnTerminal>(cortexCommand(move)); },
                         [](const auto& each) { return each->shows("moveTo: "); });
    }
};

// Its answer is the agent's own, whatever a move makes of a standstill.
TEST_F(CortexSilence, OfAnAgentIsWaitedOutByACallAsLongAsItsTimeout) {
    const comms::Mirror eye{"eye", ownNetwork()};
    ASSERT_TRUE(eye.waitForOwner("/mixer", patience));
    const auto call = longMove(patient);

    agent->send(SIGSTOP);
    ASSERT_TRUE(becomesTrue([&] { return eye.agents().at(0).state == "lost"; }));
    EXPECT_FALSE(call->shows("Unknown", std::chrono::seconds{1})) << call->output();
    agent->send(SIGCONT);
    live({"call", "/controller", "cancel"});  // it may have ended by itself

    EXPECT_NE(call->exit(), 3) << call->output();
    EXPECT_FALSE(contains(call->output(), "Unknown")) << call->output();
}

TEST_F(CortexSilence, ThatLastsIsNoCommandThatRunsOn) {
    const auto call = longMove("5");

    agent->end(SIGKILL);

    EXPECT_EQ(call->exit(), 3) << call->output();
    EXPECT_TRUE(contains(call->output(), "Unknown: mixer is not heard: ")) << call->output();
}

TEST(LiveFault, ATextThatFillsItsItemIsNotShownAsAWholeOne) {
    HungAgent robot{std::stoi(domain)};
    const std::string text =
        "axis 4 does not follow: 0.052 rad behind, at most 0.050 rad are allowed";
    robot.fail(text);
    const std::string cut = text.substr(0, 48) + "…  <- the rest: cortex events /ctl";
    const Outcome shown =
        lookUntil([] { return live({"show", "/ctl"}); },
                  [&](const Outcome& seen) { return contains(seen.output, cut); });
    EXPECT_TRUE(contains(shown.output, cut)) << shown.output << shown.errors;
    EXPECT_EQ(liveJson({"show", "/ctl"}, "show")["data"]["faultText"]["cut"], true);
    EXPECT_TRUE(contains(live({"events", "/ctl"}).output, text)) << "as show says";
}

// In a moment in which a cycle takes very long, it stands still instead: it is looked at again.
void expectOverload(const std::vector<std::string>& verb, std::string Outcome::* printed,
                    const std::string& words) {
    const Outcome seen =
        lookUntil([&] { return live(verb); },
                  [&](const Outcome& each) { return contains(each.*printed, words); });
    EXPECT_TRUE(contains(seen.*printed, words)) << verb.front() << seen.output << seen.errors;
}

TEST(LiveOverload, IsShownByEveryToolWithTheRateAndTheNominalOne) {
    HungAgent robot{std::stoi(domain)};
    robot.overload();
    const std::string where = "is overloaded: it runs at ";
    const auto isOverloaded = [](const json& seen) { return seen["state"] == "overloaded"; };
    const json agent = lookUntil(
        [] {
            const json agents = liveJson({"agents"}, "agents");
            EXPECT_EQ(agents.size(), 1U);
            return agents[0];
        },
        isOverloaded);
    EXPECT_EQ(agent["state"], "overloaded");
    EXPECT_LT(agent["rate_hz"], 180) << agent;
    const json top =
        lookUntil([] { return liveJson({"top", "--once"}, "top")["agents"][0]; }, isOverloaded);
    EXPECT_EQ(top["state"], "overloaded");
    const json shown = lookUntil([] { return liveJson({"show", "/ctl"}, "show"); },
                                 [](const json& seen) { return seen["overloaded"] == true; });
    EXPECT_EQ(shown["overloaded"], true);
    expectOverload({"agents"}, &Outcome::output, " of 200 Hz");
    expectOverload({"list"}, &Outcome::errors, "robot " + where);
    expectOverload({"show", "/ctl"}, &Outcome::output, "robot, " + where);
    expectOverload({"top", "--once"}, &Outcome::output, "robot " + where);
    expectOverload({"top", "--once"}, &Outcome::output, " of 200 Hz");
    expectOverload({"doctor"}, &Outcome::output, where);
}

TEST(LiveStandstill, IsWhyACallHasNoAnswer) {
    HungAgent robot{std::stoi(domain)};
    robot.hang();

    const std::string why = "the loop of robot hangs in /ctl.stateStandby for ";
    const std::vector<std::string> words{"call", "/ctl", "startup", "--timeout", "2"};
    // Again, where its time was over before the agent was found.
    const Outcome call = lookUntil([&] { return cortex(words + network); },
                                   [&](const Outcome& each) { return contains(each.output, why); });

    EXPECT_EQ(call.exit, 3) << call.output;
    EXPECT_TRUE(contains(call.output, why)) << call.output << call.errors;
}

TEST(LiveStandstill, IsOverWhenTheHookReturns) {
    HungAgent robot{std::stoi(domain)};
    robot.hang();
    robot.release();

    // What stood still counts as overloaded until it has kept its pace for a while.
    const json agents = lookUntil([] { return liveJson({"agents"}, "agents"); },
                                  [](const json& seen) { return seen[0]["state"] == "running"; });
    EXPECT_EQ(agents[0]["state"], "running");
    std::string rests =
        "cortex: nothing of robot is started: 1 active simplex is in Standby; to "
        "start it: cortex call /robot startup prefix=/";
    for (const std::string& each : network) rests += " " + each;
    const Outcome list =
        lookUntil([] { return live({"list"}); },
                  [&](const Outcome& seen) { return seen.errors == rests + "\n"; });
    EXPECT_EQ(list.errors, rests + "\n");
}

}  // namespace
}  // namespace cortex::test
