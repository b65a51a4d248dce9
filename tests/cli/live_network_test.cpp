// SPDX-License-Identifier: Apache-2.0
// What the verbs say of agents that are slow, half known, dead, started again or hidden.
#include "cli/json_schema.hpp"
#include "cli/live_agent.hpp"
#include "comms/network_agent.hpp"
#include "core/model_folder.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

Outcome liveWithin(const std::string& seconds, const Words& arguments) {
    return cortex(arguments + network + Words{"--timeout", seconds});
}

// A participant that says it is an agent, and sends nothing of its model.
struct Ghost : comms::RawTool {
    Ghost() : RawTool{"ghost"} {}
    void say() {
        comms::Presence said = presence();
        said.role = "agent";
        said.interval = 1'000'000'000;
        said.types = 3;
        said.simplexes = 2;
        presences->write(said);
    }
};

// Again, where that time was too short to hear of anybody.
Outcome liveUntil(const std::string& words, const std::string& seconds, const Words& arguments) {
    return lookUntil([&] { return liveWithin(seconds, arguments); },
                     [&](const Outcome& seen) { return contains(seen.errors, words); });
}

TEST(CortexTimeout, NamesWhatWasHeardOfAnAgentWhoseModelDoesNotCome) {
    Ghost ghost;
    ghost.say();

    const std::string words = "ghost was heard, but its model did not come";
    const Outcome outcome = liveUntil(words, "1", {"call", "/arm", "startup"});

    EXPECT_EQ(outcome.exit, 3);
    EXPECT_TRUE(contains(outcome.errors, "/arm was not found within 1 s")) << outcome.errors;
    EXPECT_TRUE(contains(outcome.errors, words)) << outcome.errors;
    EXPECT_FALSE(contains(outcome.errors, "no agent has")) << outcome.errors;
}

TEST(CortexTimeout, SaysThatSomebodyWasFoundWhoDidNotSayWhoItIs) {
    const Ghost ghost;

    const std::string words = "1 participant of CorteX was found and did not say who";
    const Outcome outcome = liveUntil(words, "1", {"show", "/arm"});

    EXPECT_EQ(outcome.exit, 3);
    EXPECT_TRUE(contains(outcome.errors, words)) << outcome.errors;
    EXPECT_TRUE(contains(outcome.errors, "--timeout")) << outcome.errors;
}

// Whoever does not say who it is may be the agent that is missed.
TEST_F(CortexLive, ASilentParticipantIsNamedByWhateverTellsOfAllAgents) {
    const Ghost ghost;
    const std::string words = "1 participant of CorteX was found and did not say who it is";
    const std::string file = (folder.path() / "saved.xml").string();
    std::vector<Words> verbs{{"list"}, {"list", "/arm"}, {"agents"}, {"save", file, "--force"}};
    for (Words& each : verbs) each = each + network + Words{"--timeout", "1.5"};
    const auto all =
        lookUntil([&] { return cortexAtOnce(verbs); },
                  [&](const std::vector<Outcome>& seen) {
                      return std::ranges::all_of(seen, [&](const Outcome& each) {
                          return contains(each.errors, words) && !contains(each.errors, "no agent");
                      });
                  });
    for (const Outcome& outcome : all) {
        EXPECT_EQ(outcome.exit, 3) << outcome.errors;
        EXPECT_TRUE(contains(outcome.errors, words)) << outcome.errors;
        EXPECT_FALSE(contains(outcome.errors, "no agent has")) << outcome.errors;
    }
}

TEST(CortexTimeout, IsSharedByFindingTheAgentAndItsAnswer) {
    comms::NetworkAgent deaf{"deaf"};
    deaf.rig.hand("/worker");
    deaf.rig.start();
    deaf.rig.step(3);  // and no more, so no command is read

    const Outcome outcome =  // again, where the agent was not found in that time
        lookUntil([] { return liveWithin("2", {"call", "/worker", "poke", "--json"}); },
                  [](const Outcome& seen) { return contains(seen.output, "\"outcome\""); });
    const json answer = json::parse(outcome.output, nullptr, false);

    ASSERT_TRUE(answer.contains("outcome")) << outcome.output << outcome.errors;
    ASSERT_EQ(answer["outcome"], "Unknown") << answer;
    const std::string reason = answer["reason"];
    EXPECT_FALSE(contains(reason, "no answer within 2000 ms")) << reason;
    EXPECT_TRUE(contains(reason, "of the 2000 ms of --timeout")) << reason;
}

// Two agents: a device, and a controller that looks at what it measures.
struct CortexLoss : testing::Test {
    void SetUp() override {
        cell.emplace(agentCommand(
            systemFile(folder, "cell",
                       "<simplex path=\"/cell/observed\" type=\"RotaryAxisConcept\"/>"
                       "<simplex path=\"/cell/demanded\" type=\"RotaryAxisConcept\"/>"
                       "<simplex path=\"/cell/drive\" type=\"SimulatedAxis\">"
                       "<relate rule=\"demand\" to=\"/cell/demanded\"/>"
                       "<relate rule=\"observation\" to=\"/cell/observed\"/></simplex>")));
        desk.emplace(agentCommand(
            systemFile(folder, "desk",
                       "<simplex path=\"/desk/demanded\" type=\"RotaryAxisConcept\"/>"
                       "<simplex path=\"/desk/controller\" type=\"HoldAxisController\">"
                       "<relate rule=\"axes\" to=\"/cell/observed\" remote=\"true\" "
                       "type=\"RotaryAxisConcept\"/>"
                       "<relate rule=\"demands\" to=\"/desk/demanded\"/></simplex>")));
        for (const char* each : {"/cell", "/desk"}) {  // one is heard before the other
            lookUntil([each] { return live({"list", each}); },
                      [](const Outcome& seen) { return seen.exit == 0; });
        }
    }

    // Looks again while it hears one of the agents alone, which has nothing of the other.
    static Outcome found(const Words& arguments) {
        return lookUntil([&] { return live(arguments); },
                         [](const Outcome& seen) { return seen.exit != 3; });
    }
    static json foundJson(const Words& arguments, const std::string& schema) {
        return jsonOf(found(arguments + Words{"--json"}), schema);
    }
    // What `show` prints once this member of it is so.
    static json shownUntil(const std::string& path, const std::string& member, const json& wanted) {
        const auto isSo = [&](const Outcome& seen) {
            const json shown = json::parse(seen.output, nullptr, false);
            return shown.is_object() && shown.value(member, json()) == wanted;
        };
        const auto look = [&] { return live({"show", path, "--json"}); };
        return jsonOf(lookUntil(look, isSo), "show");
    }

    // Kills the device and waits until the controller has lost its input. Its agent may take the
    // device's values as good a little later than this tool, and refuses a startup until then.
    void loseTheDevice() {
        const auto shown = [] { return live({"list", "/desk/controller", "--json"}); };
        lookUntil(shown, [](const Outcome& seen) {
            return seen.exit == 0 && !contains(seen.output, "\"lost\"");
        });
        const Outcome started =
            lookUntil([] { return live({"call", "/desk/controller", "startup"}); },
                      [](const Outcome& seen) { return seen.exit == 0; });
        ASSERT_EQ(started.exit, 0) << started.output << started.errors;
        cell->end(SIGKILL);
        lookUntil(shown, [](const Outcome& seen) { return contains(seen.output, "\"lost\""); });
    }

    const ModelFolder folder;
    std::optional<Background> cell, desk;
};

TEST_F(CortexLoss, AControllerWhoseInputIsLostShowsItsStateAndCommands) {
    loseTheDevice();

    json shown = liveJson({"show", "/desk/controller"}, "show");
    EXPECT_EQ(shown["quality"], "lost");
    EXPECT_TRUE(shown["state"].is_string()) << shown["state"];
    for (const json& each : shown["commands"]) {
        EXPECT_NE(each["reason"], "its state is not known") << each;
    }
    const json list = liveJson({"list", "/desk/controller"}, "list");
    EXPECT_EQ(list[0]["state"], shown["state"]);
    const json top = liveJson({"top", "--once", "/desk"}, "top");
    for (const json& each : top["agents"]) {
        if (each["name"] == "desk") {
            EXPECT_EQ(each["states"][shown["state"].get<std::string>()], 1) << each;
        }
    }
}

TEST_F(CortexLoss, ADemandSaysWhyItIsItsSafeValue) {
    const std::string rests = "/desk/controller is in Standby";
    EXPECT_EQ(shownUntil("/desk/demanded", "safe", rests)["safe"], rests);
    EXPECT_EQ(foundJson({"list", "/desk/demanded"}, "list")[0]["safe"], rests);
    EXPECT_EQ(foundJson({"show", "/desk/controller"}, "show")["safe"], json());

    loseTheDevice();

    const std::string lost = "/desk/controller has lost an input";
    json seen = shownUntil("/desk/demanded", "safe", lost);
    EXPECT_EQ(seen["safe"], lost);
    EXPECT_EQ(seen["quality"], "stale");
    EXPECT_TRUE(
        contains(live({"show", "/desk/demanded"}).output, "stale, its safe value: " + lost));
    EXPECT_TRUE(contains(live({"list", "/desk/demanded"}).output, "stale, safe"));
    EXPECT_TRUE(
        contains(live({"watch", "/desk/demanded.position", "--count", "1"}).output, "stale, safe"));
}

TEST_F(CortexLoss, IsFollowedThroughOtherAgentsToItsFirstCause) {
    const Background watcher{
        agentCommand(systemFile(folder, "watcher",
                                "<simplex path=\"/watcher/demanded\" type=\"RotaryAxisConcept\"/>"
                                "<simplex path=\"/watcher/controller\" type=\"HoldAxisController\">"
                                "<relate rule=\"axes\" to=\"/desk/demanded\" remote=\"true\" "
                                "type=\"RotaryAxisConcept\"/>"
                                "<relate rule=\"demands\" to=\"/watcher/demanded\"/></simplex>"))};
    loseTheDevice();
    const json expected{{{"path", "/desk/demanded"}, {"agent", "desk"}},
                        {{"path", "/desk/controller"}, {"agent", "desk"}},
                        {{"path", "/cell/observed"}, {"agent", ""}}};

    EXPECT_EQ(shownUntil("/watcher/controller", "causes", expected)["causes"], expected);
    const std::string chain =
        "/desk/demanded of desk <- /desk/controller of desk <- /cell/observed, which is not heard";
    const Outcome text =
        lookUntil([] { return live({"show", "/watcher/controller"}); },
                  [&](const Outcome& seen) { return contains(seen.output, chain); });
    EXPECT_TRUE(contains(text.output, chain)) << text.output;
    EXPECT_EQ(foundJson({"show", "/watcher"}, "show")["causes"], json::array());
}

TEST_F(CortexLoss, AMisspeltRemotePathNamesTheNearestOnceTheOtherAgentIsKnown) {
    const Background other{agentCommand(systemFile(
        folder, "other",
        "<simplex path=\"/other/demanded\" type=\"RotaryAxisConcept\"/>"
        "<simplex path=\"/other/controller\" type=\"HoldAxisController\">"
        "<relate rule=\"axes\" to=\"/cell/obsrved\" remote=\"true\" type=\"RotaryAxisConcept\"/>"
        "<relate rule=\"demands\" to=\"/other/demanded\"/></simplex>"))};
    const std::string words = "cell has no such simplex, nearest of: /cell/observed";

    const Outcome events =
        lookUntil([] { return live({"events", "/cell"}); },
                  [&](const Outcome& seen) { return contains(seen.output, words); });

    EXPECT_TRUE(contains(events.output, words)) << events.output << events.errors;
}

TEST_F(CortexLive, WatchGoesOnWithTheNextStartOfAnAgentAndSaysSo) {
    struct Format {
        std::string option, good, restarted;
    };
    for (const Format& format : {Format{"", "12 Hz", "new start of agent mixer"},
                                 Format{"--json", "\"value\":12", "\"restarted\":[\"mixer\"]"},
                                 Format{"--csv", ",good,good,", ",mixer\n"}}) {
        std::string command = "exec timeout " + patient +
                              " " CORTEX_BINARY_DIR
                              "/bin/cortex watch "
                              "/drive.naturalFrequency /mixer.cycleDurationMean " +
                              format.option;
        for (const std::string& each : network) command += " " + each;
        FILE* output = popen(command.c_str(), "re");
        ASSERT_NE(output, nullptr);
        std::array<char, 4096> line{};
        const auto reads = [&](const std::string& wanted) {
            while (std::fgets(line.data(), line.size(), output) != nullptr) {
                if (contains(line.data(), wanted)) return true;
            }
            return false;
        };

        EXPECT_TRUE(reads(format.good)) << format.option;
        agent->end(SIGKILL);
        start();
        EXPECT_TRUE(reads(format.restarted)) << format.option;
        EXPECT_TRUE(contains(line.data(), format.good) || reads(format.good)) << format.option;
        pclose(output);
    }
}

TEST_F(CortexLive, WatchPrintsMomentsOnAGridOfTheRateAskedFor) {
    const Outcome csv = live({"watch", "/drive.state", "--csv", "--rate", "20", "--count", "5"});

    const auto lines = linesOf(csv.output);
    ASSERT_EQ(lines.size(), 6U) << csv.output << csv.errors;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const std::string fraction = lines[i].substr(lines[i].find('.') + 1, 3);
        EXPECT_EQ(std::stoi(fraction) % 50, 0) << lines[i];
    }
}

TEST_F(CortexLive, LabelsAreShownBesideTheirNumbers) {
    const json shown = liveJson({"show", "/drive"}, "show")["data"]["state"];
    EXPECT_EQ(shown["value"], 0);
    EXPECT_EQ(shown.value("label", ""), "Standby");
    const Outcome watched = live({"watch", "/drive.state", "--json", "--count", "1"});
    EXPECT_TRUE(contains(watched.output, "\"label\":\"Standby\"")) << watched.output;
}

TEST_F(CortexLive, AnAgentThatKeepsToLoopbackIsListedWithTheVariableThatTheDemoPrints) {
    const Outcome outcome =
        cortex({"list", "--domain", domain, "--timeout", patient}, {{"CORTEX_INTERFACE", "lo"}});

    EXPECT_EQ(outcome.exit, 0) << outcome.errors;
    EXPECT_TRUE(contains(outcome.output, "/drive")) << outcome.output;
}

TEST_F(CortexLive, AnAgentThatKeepsToLoopbackIsListedWithoutAnyOption) {
    ASSERT_EQ(live({"list"}).exit, 0) << "it is there";
    const Outcome outcome = cortex({"list", "--domain", domain, "--timeout", patient});

    EXPECT_EQ(outcome.exit, 0) << outcome.errors;
    EXPECT_TRUE(contains(outcome.output, "/drive")) << outcome.output;
    EXPECT_TRUE(contains(outcome.errors, "looks on the loopback interface alone"));
}

TEST(CortexHidden, ListWithoutSecuritySaysThatSecuredAgentsWereHeard) {
    const ModelFolder folder;
    const std::string keys = (folder.path() / "mixer").string();
    const std::string file = folder.write("mixer.xml", mixerSystem()).string();
    ASSERT_EQ(cortex({"security", "create-authority"}, {}, folder.path().string()).exit, 0);
    ASSERT_EQ(cortex({"security", "create-agent", "mixer"}, {}, folder.path().string()).exit, 0);
    const Background agent{agentCommand(file) + Words{"--security", keys}};

    const Outcome outcome = liveUntil("with security", "1", {"list"});

    EXPECT_EQ(outcome.exit, 3);
    EXPECT_TRUE(contains(outcome.errors, "1 participant with security was heard"))
        << outcome.errors;
    EXPECT_TRUE(contains(outcome.errors, "--security FOLDER")) << outcome.errors;
    const Outcome doctor =
        lookUntil([] { return liveWithin("1", {"doctor"}); },
                  [](const Outcome& seen) { return contains(seen.output, "with security"); });
    EXPECT_EQ(doctor.exit, 1) << doctor.output;

    const Background open{agentCommand(
        systemFile(folder, "open", "<simplex path=\"/arm\" type=\"RotaryAxisConcept\"/>"))};
    const Outcome hidden =
        lookUntil([] { return live({"show", "/drive"}); },
                  [](const Outcome& seen) { return contains(seen.errors, "no agent has"); });
    EXPECT_TRUE(contains(hidden.errors,
                         "no agent has a simplex /drive that can be seen without security: 1 "
                         "participant with security was heard"))
        << hidden.errors;
    EXPECT_EQ(live({"doctor"}).exit, 1);
}

TEST(CortexContradiction, TwoAgentsWithOnePathAreNamedByEveryVerbThatShowsThem) {
    const ModelFolder folder;
    const std::string drive = "<simplex path=\"/arm\" type=\"RotaryAxisConcept\"/>";
    const Background one{agentCommand(systemFile(folder, "one", drive))};
    const Background two{agentCommand(systemFile(folder, "two", drive))};
    const std::string words = "agents one, two both have /arm; commands go to ";

    for (const char* verb : {"list", "agents", "graph"}) {
        const Outcome outcome =
            lookUntil([&] { return live({verb}); },
                      [&](const Outcome& seen) { return contains(seen.errors, words); });
        EXPECT_TRUE(contains(outcome.errors, words)) << verb << outcome.errors << outcome.output;
    }
    const Outcome doctor = live({"doctor"});
    EXPECT_TRUE(contains(doctor.output, words)) << doctor.output;
    EXPECT_EQ(doctor.exit, 1);
}

}  // namespace
}  // namespace cortex::test
