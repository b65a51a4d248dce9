// SPDX-License-Identifier: Apache-2.0
// `cortex events` of what agents keep of the past, and of what was before a fault.
#include "cli/controlled_agent.hpp"
#include "cli/hung_agent.hpp"
#include "cli/json_schema.hpp"
#include "cli/on_terminal.hpp"
#include "comms/network_agent.hpp"

#include <algorithm>
#include <csignal>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

const std::string byAlice = " for alice: startup(prefix=\"/\")";

json eventsSince(const Words& more, const std::string& since = "1h") {
    return liveJson(Words{"events", "--since", since} + more, "events");
}

bool hasText(const json& events, const std::string& text) {
    return std::ranges::any_of(events,
                               [&](const json& each) { return contains(each["text"], text); });
}

// An agent whose task, /ctl, was started for alice, by a command to the agent.
struct CortexKept : testing::Test {
    CortexKept() {
        EXPECT_EQ(live({"call", "/robot", "startup", "prefix=/", "--for", "alice"}).exit, 0);
    }
    HungAgent robot{std::stoi(domain)};
};

TEST_F(CortexKept, ACommandIsFoundAfterMoreChatterThanTheEventsHold) {
    robot.chatter(1'500);
    EXPECT_FALSE(contains(live({"events"}).output, byAlice)) << "it is in the memory alone";

    const Outcome all = live({"events", "--since", "1h"});
    EXPECT_EQ(all.exit, 0) << all.errors;
    EXPECT_TRUE(contains(all.output, byAlice)) << all.output;
    const auto lines = linesOf(all.output);
    const std::regex began{
        "cortex: robot: keeps what happened since 20[0-9-]+T[0-9:.]+Z, when it started\n"};
    EXPECT_TRUE(std::regex_match(all.errors, began)) << all.errors;
    EXPECT_GT(lines.size(), 1'000U) << "with chatter, as far as it is there";
    const auto timeOf = [](const std::string& line) { return line.substr(0, line.find(' ')); };
    EXPECT_TRUE(std::ranges::is_sorted(lines, {}, timeOf));
    EXPECT_EQ(std::set<std::string>(lines.begin(), lines.end()).size(), lines.size()) << "twice";
}

TEST_F(CortexKept, IsLimitedByTimeKindAndPath) {
    const json some = eventsSince({"--kind", "command", "--kind", "state-change"});
    EXPECT_TRUE(hasText(some, byAlice)) << some;
    EXPECT_TRUE(hasText(some, "StartingUp -> Active")) << some;
    for (const json& each : some) {
        EXPECT_TRUE(each["kind"] == "command" || each["kind"] == "state change") << each;
    }
    for (const json& each : eventsSince({"/ctl"})) EXPECT_EQ(each["path"], "/ctl");
    EXPECT_TRUE(eventsSince({"--until", "2000-01-01"}, "1970-01-01").empty());
    const Outcome now = live({"events", "--since", "0s", "--until", "0s", "--csv"});
    EXPECT_EQ(now.output, "time,agent,number,cycle,severity,kind,path,text\n");
    EXPECT_EQ(now.errors, "") << "all that happened since then is kept";
}

TEST_F(CortexKept, WhoHadControlOfAPathIsFoundAtIt) {
    EXPECT_EQ(live({"call", "/robot", "takeControl", "prefix=/ctl", "--for", "bob"}).exit, 0);
    const json taken = eventsSince({"/ctl", "--kind", "control"});
    EXPECT_TRUE(hasText(taken, " for bob: takeControl(prefix=\"/ctl\"): Done")) << taken;
}

TEST_F(CortexKept, APathThatNobodyHasIsRefusedWithTheNearest) {
    const Words all = network + Words{"--timeout", patient};
    for (const Outcome& seen : cortexAtOnce({Words{"events", "/ctk", "--since", "1h"} + all,
                                             Words{"events", "/ctk", "--before-fault"} + all})) {
        EXPECT_EQ(seen.exit, 3) << seen.output;
        EXPECT_TRUE(contains(seen.errors, "no agent has anything at or below /ctk; ") &&
                    contains(seen.errors, "/ctl"))
            << seen.errors;
    }
    EXPECT_EQ(live({"events", "/ctl", "--since", "1h", "--kind", "loss"}).exit, 0) << "no event";
}

TEST_F(CortexKept, FollowGoesOnWithoutAGapOrADouble) {
    OnTerminal follow{cortexCommand({"events", "--since", "1h", "--follow"})};
    ASSERT_TRUE(follow.shows(byAlice)) << follow.output();
    EXPECT_EQ(live({"call", "/ctl", "shutdown", "--for", "bob"}).exit, 0);
    ASSERT_TRUE(follow.shows("ShuttingDown -> Standby")) << follow.output();
    EXPECT_EQ(live({"call", "/ctl", "startup", "--for", "carol"}).exit, 0);
    ASSERT_TRUE(follow.shows(" for carol: startup()")) << follow.output();
    follow.signal(SIGINT);
    EXPECT_EQ(follow.exit(), -SIGINT);

    const std::string& output = follow.output();
    for (const std::string& each :
         {byAlice, std::string{" for bob: shutdown()"}, std::string{" for carol: startup()"}}) {
        const auto first = output.find(each);
        ASSERT_NE(first, std::string::npos) << each << output;
        EXPECT_EQ(output.find(each, first + 1), std::string::npos) << each << " twice: " << output;
    }
}

TEST_F(CortexKept, BeforeAFaultAreTheCommandWithItsPersonAndTheChangesOfState) {
    const Outcome none = live({"events", "--before-fault", "/ctl"});
    EXPECT_EQ(none.exit, 1) << none.output;
    EXPECT_TRUE(contains(none.errors, "cortex: no fault at or below /ctl is kept\n"))
        << none.errors;
    EXPECT_TRUE(contains(none.errors, "robot: faults are kept since 20")) << none.errors;

    robot.fail("no power");
    const Outcome before =
        lookUntil([] { return live({"events", "--before-fault", "/ctl", "--seconds", "3600"}); },
                  [](const Outcome& seen) { return seen.exit == 0; });
    const auto lines = linesOf(before.output);
    ASSERT_GE(lines.size(), 4U) << before.output << before.errors;
    const std::string at = "20[0-9-]+T[0-9:.]+Z ";
    const std::regex last{at + " +0\\.000 s error /ctl fault 7: no power  <- the fault"};
    EXPECT_TRUE(std::regex_match(lines.back(), last)) << before.output;
    const std::string info = at + " *-[0-9]+\\.[0-9]{3} s info ";
    const std::regex command{info + "/robot cortex@[^ ]+ for alice: startup\\(.*: Done.*"};
    const std::regex change{info + "/ctl StartingUp -> Active"};
    for (const std::regex& each : {command, change}) {
        EXPECT_EQ(std::ranges::count_if(
                      lines, [&](const std::string& line) { return std::regex_match(line, each); }),
                  1)
            << before.output;
    }

    const Outcome earlier = live({"events", "--before-fault", "--until", "2000-01-01"});
    EXPECT_EQ(earlier.exit, 1) << earlier.output;
    EXPECT_TRUE(contains(earlier.errors, "cortex: no fault of that time is kept\n"));
    const json list =
        liveJson({"events", "--before-fault", "--until", "0s", "--seconds", "3600"}, "events");
    EXPECT_EQ(list.back()["kind"], "fault");
    EXPECT_TRUE(hasText(list, byAlice)) << list;
    EXPECT_TRUE(contains(live({"show", "/ctl"}).output,
                         "\ncortex events --before-fault /ctl shows the ten seconds before\n"));
}

TEST(CortexPast, AnAgentThatWasBuiltBeforeCannotSayIt) {
    comms::RawTool old{"old"};
    comms::Presence presence = old.presence();
    presence.role = "agent";
    presence.interval = 1'000'000'000;
    const HungAgent robot{std::stoi(domain)};
    const std::string words = "cortex: old: it was built before agents kept a memory\n";

    for (const char* what : {"--since=1h", "--before-fault"}) {
        const Outcome seen = lookUntil(
            [&] {
                old.presences->write(presence);
                return cortex(Words{"events", what, "--timeout", "2"} + network);
            },
            [&](const Outcome& each) {
                return contains(each.errors, words) && contains(each.errors, "cortex: robot: ");
            });
        EXPECT_EQ(seen.exit, 3) << what << seen.errors;
        EXPECT_TRUE(contains(seen.errors, "cortex: robot: ")) << "the others do: " << seen.errors;
    }
}

TEST(CortexPast, AWrongTimeIsRefusedWithTheFormsThatAreRight) {
    const struct {
        Words arguments;
        const char* said;
    } table[] = {
        {{"--since", "yesterday"}, "--since 'yesterday' is no time; write 90s, 10m, 1h, 2d (ago)"},
        {{"--since", "2262-01-01"}, "in UTC, of the years 1970 to 2261"},
        {{"--since", ""}, "--since '' is no time"},
        {{"--since", "1h", "--until", "1"}, "--until '1' is no time; write 90s"},
        {{"--since", "2200-01-01"},
         "--since '2200-01-01' is in the future: by this machine it is "},
        {{"--since", "1h", "--until", "2h"}, ", after --until, which is "},
        {{"--until", "1h"}, "--until needs --since or --before-fault"},
        {{"--since", "1h", "--before-fault"}, "excludes"},
        {{"--seconds", "5"}, "--seconds requires --before-fault"},
        {{"--before-fault", "--seconds", "5s"}, "write seconds as a number: 5"},
        {{"--kind", "value"}, "--kind value needs --since or --before-fault"},
        {{"--since", "1h", "--follow", "--kind", "value"}, "--follow cannot show values"},
        {{"--kind", "noise"}, "--kind is one of state-change, fault, refusal"}};
    for (const auto& each : table) {
        const Outcome outcome = cortex(Words{"events"} + each.arguments + network);
        EXPECT_EQ(outcome.exit, 2) << each.said << outcome.errors;
        EXPECT_TRUE(contains(outcome.errors, each.said)) << outcome.errors;
    }
    const Outcome shell = cortex(Words{"events", "--since", std::string(10'000, 'x')} + network);
    EXPECT_LT(shell.errors.size(), 300U) << shell.errors;
}

}  // namespace
}  // namespace cortex::test
