// SPDX-License-Identifier: Apache-2.0
// The verbs that look at a network, against an agent that is a process of its own.
#include "cli/json_schema.hpp"
#include "cli/live_agent.hpp"
#include "common/person_name.hpp"
#include "core/model_folder.hpp"

#include <algorithm>
#include <csignal>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;

TEST_F(CortexLive, ListsEverySimplexWithStateAndQuality) {
    const json list = liveJson({"list"}, "list");

    std::vector<std::string> paths;
    for (const json& each : list) {
        paths.push_back(each["path"]);
        EXPECT_EQ(each["agent"], "mixer");
        EXPECT_NE(each["quality"], "lost") << each;
    }
    EXPECT_EQ(paths, (std::vector<std::string>{"/axis/demanded", "/axis/observed", "/controller",
                                               "/drive", "/mixer"}));
    EXPECT_EQ(list[0]["role"], "modification");
    EXPECT_TRUE(list[0]["state"].is_null());
    EXPECT_EQ(list[3]["type"], "SimulatedAxis");
    EXPECT_EQ(list[3]["state"], "Standby");

    EXPECT_EQ(liveJson({"list", "/axis"}, "list").size(), 2U);
    const Outcome text = live({"list", "/drive"});
    EXPECT_EQ(text.exit, 0);
    EXPECT_EQ(linesOf(text.output).size(), 1U) << text.output;
    EXPECT_EQ(live({"list", "/axes"}).exit, 3);
}

TEST_F(CortexLive, ListSaysWhatIsNotStartedAndHowToStartIt) {
    const std::string words =
        "cortex: nothing of mixer is started: 2 active simplexes are in Standby;"
        " to start them: cortex call /mixer startup prefix=/";
    std::string options;
    for (const std::string& each : network) options += " " + each;

    EXPECT_EQ(live({"list"}).errors, words + options + "\n");
    EXPECT_EQ(live({"list", "/axis"}).errors, "") << "nothing there can be started";

    const Outcome started = live({"call", "/mixer", "startup", "prefix=/drive"});
    EXPECT_EQ(started.exit, 0) << started.output << started.errors;
    EXPECT_EQ(live({"list"}).errors, "");
    const std::string below = live({"list", "/controller"}).errors;
    EXPECT_TRUE(contains(below,
                         "nothing of mixer at or below /controller is started: 1 active "
                         "simplex is in Standby; to start it: cortex call /mixer startup "
                         "prefix=/controller"))
        << below;
}

TEST_F(CortexLive, ShowsThatAnAgentTakesItsOwnCommandsAtAnyTime) {
    const Outcome shown = live({"show", "/mixer"});
    EXPECT_TRUE(contains(shown.output, "takeControl")) << shown.output;
    EXPECT_FALSE(contains(shown.output, "not known")) << shown.output;
}

TEST_F(CortexLive, ShowsTheAgents) {
    const json agents = lookUntil([] { return liveJson({"agents"}, "agents"); },
                                  [](const json& seen) { return seen[0]["state"] == "running"; });

    ASSERT_EQ(agents.size(), 1U);
    EXPECT_EQ(agents[0]["name"], "mixer");
    EXPECT_EQ(agents[0]["state"], "running");
    EXPECT_EQ(agents[0]["simplexes"], 5);
    EXPECT_EQ(agents[0]["loss"], 0);
    EXPECT_EQ(agents[0]["dropped"], "");
    EXPECT_EQ(agents[0]["refused"], "");
    EXPECT_TRUE(contains(live({"agents"}).output, "mixer"));
}

TEST_F(CortexLive, ShowsASimplexWithAllThatIsKnownOfIt) {
    const json shown = liveJson({"show", "/drive"}, "show");

    EXPECT_EQ(shown["state"], "Standby");
    EXPECT_EQ(shown["data"]["startPosition"]["value"], 0.5) << "a constant";
    EXPECT_EQ(shown["data"]["naturalFrequency"]["unit"], "Hz");
    EXPECT_GE(shown["age_ms"], 0);
    EXPECT_TRUE(std::ranges::count(shown["ancestors"], "Device") == 1);
    const json expected{
        {{"rule", "demand"}, {"direction", "input"}, {"to", "/axis/demanded"}, {"max_age_s", 0.05}},
        {{"rule", "observation"},
         {"direction", "output"},
         {"to", "/axis/observed"},
         {"max_age_s", nullptr}}};
    EXPECT_EQ(shown["relationships"], expected);
    for (const json& command : shown["commands"]) {
        if (command["name"] == "startup") {
            EXPECT_EQ(command["available"], true);
        }
        if (command["name"] != "shutdown") continue;
        EXPECT_EQ(command["available"], false);
        EXPECT_EQ(command["reason"], "needs StartingUp Active, is Standby");
    }
    const Outcome text = live({"show", "/drive"});
    EXPECT_EQ(text.exit, 0) << text.errors;
    EXPECT_TRUE(contains(text.output, "naturalFrequency")) << text.output;
    EXPECT_TRUE(contains(text.output, "needs StartingUp Active, is Standby")) << text.output;
}

TEST_F(CortexLive, CallsCommandsAndEndsWithWhatCameOfThem) {
    json answer = liveJson({"call", "/drive", "startup"}, "call");
    EXPECT_EQ(answer["outcome"], "Done");
    answer = liveJson({"call", "/drive", "startup"}, "call", 1);
    EXPECT_EQ(answer["outcome"], "Rejected");
    EXPECT_TRUE(contains(answer["reason"], "Standby")) << answer;
    EXPECT_TRUE(contains(live({"call", "/drive", "startup"}).output, "Rejected"));
    EXPECT_GT(answer["round_trip_us"], answer["latency_us"]);
    live({"call", "/drive", "startup", "--for", "alice"});
    const std::string events = live({"events"}).output;
    EXPECT_TRUE(contains(events, " for alice: startup()")) << events;
    const std::string myself = common::nameInCommand(common::personName(""));
    EXPECT_TRUE(contains(events, " for " + myself + ": startup(): Done")) << events;
    for (const std::string& wrong : {std::string(32, 'x'), std::string{"alice (cortex@desk)"},
                                     std::string{"\xc2\x9b"}, std::string{"alice "}}) {
        const Outcome refused = live({"call", "/drive", "startup", "--for", wrong});
        EXPECT_EQ(refused.exit, 2) << wrong;
        EXPECT_TRUE(contains(refused.errors, "a name has at most 31 bytes")) << refused.errors;
    }
    EXPECT_EQ(liveJson({"call", "/mixer", "startup", "prefix=/"}, "call")["outcome"], "Done");
    EXPECT_EQ(liveJson({"show", "/controller"}, "show")["state"], "Active");
}

TEST_F(CortexLive, SaysWhatIsValidWhereACommandIsNot) {
    Outcome outcome = live({"call", "/drive", "strtup"});
    EXPECT_EQ(outcome.exit, 3);
    EXPECT_TRUE(contains(outcome.errors, "startup")) << outcome.errors;
    outcome = live({"call", "/mixer", "startup", "prefx=/"});
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(contains(outcome.errors, "prefix")) << outcome.errors;
    EXPECT_EQ(live({"call", "/mixer", "startup", "prefix"}).exit, 2);
    outcome = live({"call", "/mixer", "takeControl"});
    EXPECT_EQ(outcome.exit, 2) << "as for one too many";
    EXPECT_TRUE(contains(outcome.errors, "needs the parameter 'prefix' (string)"))
        << outcome.errors;
    outcome = live({"call", "/drve", "startup"});
    EXPECT_EQ(outcome.exit, 3);
    EXPECT_TRUE(contains(outcome.errors, "/drive")) << outcome.errors;
    EXPECT_EQ(live({"call", "drive", "startup"}).exit, 2);
}

TEST_F(CortexLive, SetsItemsWithinTheirRange) {
    EXPECT_EQ(liveJson({"set", "/drive", "naturalFrequency=9.5"}, "call")["outcome"], "Done");
    const json data = liveJson({"show", "/drive"}, "show")["data"];
    EXPECT_EQ(data["naturalFrequency"]["value"], 9.5);

    const json answer =
        liveJson({"set", "/drive", "naturalFrequency=8", "dampingRatio=7"}, "call", 1);
    EXPECT_EQ(answer["outcome"], "Rejected");
    EXPECT_TRUE(contains(answer["reason"], "dampingRatio")) << answer;
    EXPECT_EQ(liveJson({"show", "/drive"}, "show")["data"]["naturalFrequency"]["value"], 9.5)
        << "all or none";
    EXPECT_EQ(live({"set", "/drive", "naturalFrequency=fast"}).exit, 2);
    const Outcome unsettable = live({"set", "/drive", "followingError=1"});
    EXPECT_EQ(unsettable.exit, 2);
    EXPECT_TRUE(contains(unsettable.errors,
                         "followingError is written by the simplex itself; it is not settable; of "
                         "/drive are: "))
        << unsettable.errors;
    const Outcome observed = live({"set", "/axis/observed", "position=1"});
    EXPECT_EQ(observed.exit, 2);
    EXPECT_TRUE(contains(observed.errors,
                         "position is an observation; it is not settable; nothing "
                         "of /axis/observed is"))
        << observed.errors;
    EXPECT_TRUE(contains(live({"set", "/controller", "position=1"}).errors,
                         "nothing of /controller (HoldAxisController) can be set"));
}

TEST_F(CortexLive, APrefixBelowWhichNothingStandsIsNamedWithTheNearest) {
    const Outcome misspelt = live({"call", "/mixer", "startup", "prefix=/drvie"});
    EXPECT_EQ(misspelt.exit, 3);
    EXPECT_TRUE(
        contains(misspelt.errors, "mixer has nothing at or below /drvie; nearest of: /drive"))
        << misspelt.errors;
    EXPECT_TRUE(contains(live({"call", "/mixer", "startup", "prefix=drive"}).errors,
                         "a path begins with '/'"));
}

TEST_F(CortexLive, SetSaysHowItIsWritten) {
    const std::string words = "the path and the items are apart: cortex set /drive ";
    EXPECT_TRUE(contains(live({"set", "/drive.naturalFrequency=5"}).errors,
                         words + "naturalFrequency=5\n"));
    EXPECT_TRUE(contains(live({"set", "/drive.naturalFrequency", "5"}).errors,
                         words + "naturalFrequency=5\n"));
    EXPECT_TRUE(contains(live({"set", "/drive"}).errors, words + "ITEM=VALUE\n"));
    EXPECT_TRUE(contains(live({"show", "/drive.state"}).errors,
                         "an item has no path of its own; name its simplex: /drive\n"));
}

TEST_F(CortexLive, WatchesAllThatThereIs) {
    // Which of them are not good in one moment; a value that is late is stale.
    const auto lacking = [] {
        json values = json::parse(live({"watch", "/", "--json", "--count", "1"}).output)["values"];
        std::string names;
        for (const char* each : {"/drive.state", "/axis/observed.position", "/mixer.commandCount"})
            if (values[each]["quality"] != "good") names += std::string{each} + " ";
        return names;
    };

    EXPECT_EQ(lookUntil(lacking, [](const std::string& names) { return names.empty(); }), "");
}

TEST_F(CortexLive, WatchesValues) {
    const Outcome csv = lookUntil(
        [] {
            return live({"watch", "/mixer.commandCount", "/drive.state", "--csv", "--count", "3",
                         "--rate", "100"});
        },
        [](const Outcome& seen) {  // what is late is stale
            const auto lines = linesOf(seen.output);
            return lines.size() == 4 && contains(lines[3], ",0,good,good");
        });
    EXPECT_EQ(csv.exit, 0) << csv.errors;
    const auto lines = linesOf(csv.output);
    ASSERT_EQ(lines.size(), 4U) << csv.output;
    EXPECT_EQ(lines[0],
              "time,/mixer.commandCount,/drive.state,/mixer.commandCount:quality,"
              "/drive.state:quality,restarted");
    EXPECT_TRUE(contains(lines[3], ",0,good,good")) << lines[3];

    const Outcome labels = live({"watch", "/drive.state", "--csv", "--labels", "--count", "1"});
    EXPECT_TRUE(contains(labels.output, "Z,Standby,")) << labels.output;

    const Outcome objects = live({"watch", "/drive", "--json", "--count", "2"});
    EXPECT_EQ(objects.exit, 0) << objects.errors;
    for (const std::string& line : linesOf(objects.output)) {
        EXPECT_EQ(violationsOf("watch", line), "") << line;
        EXPECT_EQ(json::parse(line)["values"]["/drive.state"]["value"], 0);
    }
    const Outcome text = live({"watch", "/drive.naturalFrequency", "--count", "2"});
    EXPECT_EQ(linesOf(text.output).size(), 1U) << "only what changes: " << text.output;
    EXPECT_TRUE(contains(text.output, "/drive.naturalFrequency  12 Hz")) << text.output;
    const Outcome wrong = live({"watch", "/drive.naturalFrequenzy"});
    EXPECT_EQ(wrong.exit, 3);
    EXPECT_TRUE(contains(wrong.errors, "naturalFrequency")) << wrong.errors;
}

TEST_F(CortexLive, PrintsEventsOfThePast) {
    ASSERT_EQ(live({"call", "/drive", "startup"}).exit, 0);

    const json events = liveJson({"events"}, "events");
    EXPECT_TRUE(std::ranges::any_of(events, [](const json& each) {
        return each["path"] == "/drive" && contains(each["text"], "Standby -> StartingUp");
    })) << events;
    EXPECT_TRUE(std::ranges::any_of(events, [](const json& each) {
        return each["kind"] == "command" && contains(each["text"], "cortex@");
    })) << events;
    for (const json& each : liveJson({"events", "/drive"}, "events")) {
        EXPECT_EQ(each["path"], "/drive");
        EXPECT_GT(each["repeatable"], 0) << each;
    }
    for (const json& each : events) {
        if (each["kind"] == "overflow") {
            EXPECT_EQ(each["repeatable"], 0) << each;
        }
    }
    EXPECT_TRUE(liveJson({"events", "/drive", "--severity", "error"}, "events").empty());
    const Outcome csv = live({"events", "--csv"});
    EXPECT_EQ(linesOf(csv.output).front(), "time,agent,number,cycle,severity,kind,path,text");
}

TEST_F(CortexLive, FindsNoAgentThatWasKilledAndItsNextStart) {
    ASSERT_EQ(live({"list"}).exit, 0);
    const json before = liveJson({"agents"}, "agents");

    agent->end(SIGKILL);
    const Outcome gone = cortex(std::vector<std::string>{"list", "--timeout", "0.3"} + network);
    EXPECT_EQ(gone.exit, 3) << gone.output;
    start();

    EXPECT_EQ(liveJson({"list"}, "list").size(), 5U);
    EXPECT_GT(liveJson({"agents"}, "agents")[0]["epoch"], before[0]["epoch"]);
}

TEST(CortexNetwork, SaysWhatToDoWhereNobodyIs) {
    for (const std::vector<std::string>& verb : {std::vector<std::string>{"list"},
                                                 {"agents"},
                                                 {"show", "/arm"},
                                                 {"watch", "/arm"},
                                                 {"call", "/arm", "startup"},
                                                 {"set", "/arm", "a=1"},
                                                 {"events"}}) {
        const Outcome outcome =
            cortex(verb + network + std::vector<std::string>{"--timeout", "0.05"});
        EXPECT_EQ(outcome.exit, 3) << verb.front();
        EXPECT_EQ(outcome.output, "");
        EXPECT_TRUE(contains(outcome.errors, "no agent on domain " + domain)) << outcome.errors;
        // A tool that has just left may still be counted.
        EXPECT_TRUE(contains(outcome.errors, "was heard within 0.05 s; wait longer (--timeout)") ||
                    contains(outcome.errors, "did not say who it is"))
            << outcome.errors;
    }
    const Outcome asJson =
        cortex(std::vector<std::string>{"list", "--json", "--timeout", "0.05"} + network);
    EXPECT_EQ(violationsOf("error", asJson.output), "");
}

TEST(CortexNetwork, ATimeWithAUnitIsAnsweredWithTheNumber) {
    EXPECT_TRUE(contains(cortex({"list", "--timeout", "3s"}).errors,
                         "'3s' is no number; write seconds as a number: 3"));
    EXPECT_TRUE(contains(cortex({"top", "--rate", "5Hz"}).errors, "write it without a unit: 5"));
}

TEST(CortexNetwork, EndsWith2ForWrongUsage) {
    const std::vector<std::vector<std::string>> wrong{{"show"},
                                                      {"show", "arm"},
                                                      {"list", "/a//b"},
                                                      {"call", "/arm"},
                                                      {"set", "/arm"},
                                                      {"watch"},
                                                      {"watch", "/arm", "--csv", "--json"},
                                                      {"watch", "/arm", "--count", "0"},
                                                      {"events", "--severity", "bad"},
                                                      {"list", "--domain", "231"},
                                                      {"list", "--timeout", "0"},
                                                      {"list", "--timeout", "nan"},
                                                      {"list", "--timeout", "3s"}};
    for (const auto& arguments : wrong) {
        const Outcome outcome = cortex(arguments);
        EXPECT_EQ(outcome.exit, 2) << arguments.front() << outcome.errors;
        EXPECT_NE(outcome.errors, "");
    }
}

}  // namespace
}  // namespace cortex::test
