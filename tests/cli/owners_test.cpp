// SPDX-License-Identifier: Apache-2.0
// Two agents that have one path: who gets the commands, who takes over, and what every tool says.
#include "cortex/comms/mirror.hpp"

#include "cli/json_schema.hpp"
#include "cli/live_agent.hpp"
#include "comms/network_agent.hpp"
#include "core/model_folder.hpp"
#include "network/host.hpp"
#include "wire/ids.hpp"

#include <csignal>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

const std::string arm =
    "<simplex path=\"/arm/demanded\" type=\"RotaryAxisConcept\"/>"
    "<simplex path=\"/arm/observed\" type=\"RotaryAxisConcept\"/>"
    "<simplex path=\"/arm\" type=\"SimulatedAxis\"><relate rule=\"demand\" to=\"/arm/demanded\"/>"
    "<relate rule=\"observation\" to=\"/arm/observed\"/></simplex>";
const std::string both = "agents one, two both have /arm; commands go to ";

struct CortexOwners : testing::Test {
    void start(const std::string& name, const Words& options = {},
               [[maybe_unused]] const std::string& ahead = "") {
        Words command = launch(name) + Words{"--log", log(name)} + options;
#ifdef CORTEX_SHIFTED_CLOCK
        if (!ahead.empty()) {
            command = Words{"/usr/bin/env", "LD_PRELOAD=" CORTEX_SHIFTED_CLOCK,
                            "SECONDS_AHEAD=" + ahead} +
                      command;
        }
#endif
        agents[name] = std::make_unique<Background>(command);
    }
    // Runs for longer than two starts that count as one.
    void startFirst(const std::string& name, const Words& options = {}) {
        start(name, options);
        lookUntil([&] { return agentOf(name); },
                  [](const json& seen) { return seen.is_object() && seen["cycle"] > 150; });
    }
    std::string log(const std::string& name) const { return (folder.path() / name).string(); }
    bool logs(const std::string& name, const std::string& words) const {
        return lookUntil([&] { return contains(textOf(log(name)), words); }, std::identity{});
    }

    virtual Words launch(const std::string& name) const {
        return agentCommand(systemFile(folder, name, arm));
    }
    virtual Outcome tool(const Words& arguments) const { return live(arguments); }
    json agentOf(const std::string& name) const {
        const json all = json::parse(tool({"agents", "--json"}).output, nullptr, false);
        for (const json& each : all) {
            if (each.is_object() && each["name"] == name) return each;
        }
        return {};
    }
    // How many commands it has executed. Its own simplex is never contested.
    std::int64_t executed(const std::string& name) const {
        const Outcome shown = tool({"show", "/" + name, "--json"});
        const json simplex = json::parse(shown.output, nullptr, false);
        EXPECT_TRUE(simplex.is_object()) << shown.errors;
        return simplex.is_object() ? simplex["data"]["commandCount"]["value"].get<std::int64_t>()
                                   : -1;
    }
    void commandSixTimes() const {
        for (int i = 0; i < 6; ++i) {
            const Words verb = i % 2 == 0 ? Words{"set", "/arm"} : Words{"call", "/arm", "set"};
            const Outcome done = tool(verb + Words{"naturalFrequency=" + std::to_string(5 + i)});
            EXPECT_EQ(done.exit, 0) << done.output << done.errors;
        }
    }
    bool ownedBy(const std::string& name, const std::string& why) const {
        const std::string words = both + name + ", " + why;
        const Outcome seen =
            lookUntil([&] { return tool({"list", "/arm"}); },
                      [&](const Outcome& each) { return contains(each.errors, words); });
        if (contains(seen.errors, words)) return true;
        ADD_FAILURE() << seen.errors;
        return false;
    }
    // Once the other one is gone, it executes commands.
    bool takesOver(const std::string& name) const {
        const std::int64_t before = executed(name);
        const Outcome set =
            lookUntil([&] { return tool({"set", "/arm", "naturalFrequency=7"}); },
                      [](const Outcome& each) { return each.exit == 0 && each.errors.empty(); });
        EXPECT_EQ(set.exit, 0) << set.output << set.errors;
        return executed(name) > before;
    }

    const ModelFolder folder;
    std::map<std::string, std::unique_ptr<Background>> agents;
};

struct Order {
    std::string first, second, ahead;  // of the clock of the second, s
    int signal;                        // that ends the first
};

TEST_F(CortexOwners, TheFirstGetsEveryCommandWhateverNameAndClockOfTheSecondUntilItEnds) {
    for (const auto& [first, second, ahead, signal] :
         {Order{"one", "two", "3600", SIGINT}, {"two", "one", "-3600", SIGKILL}}) {
        startFirst(first);
        start(second, {}, ahead);

        commandSixTimes();

        EXPECT_TRUE(ownedBy(first, "which was there first"));
        EXPECT_EQ(executed(first), 6);
        EXPECT_EQ(executed(second), 0);
        EXPECT_TRUE(logs(second, "agent " + first +
                                     " has it as well and owns it, which was there first; this "
                                     "agent refuses commands to it: stop one, or change its path"));
        agents[first]->end(signal);
        EXPECT_TRUE(takesOver(second));
        EXPECT_TRUE(logs(second, "this agent owns it now, as agent " + first + " is gone"));
        agents.clear();
    }
}

// Both would execute commands, and each tool would send them to whom it met first.
TEST_F(CortexOwners, AStartThatStoodStillEndsWhenASpareOfItsNameHasTakenOver) {
    const Words command = launch("one");
    Background stopped{command + Words{"--log", log("stopped")}, false};
    const auto looks = [&] { return agentOf("one"); };
    const json before =
        lookUntil(looks, [](const json& seen) { return seen.is_object() && seen["cycle"] > 150; });
    stopped.send(SIGSTOP);
    const Background spare{command + Words{"--log", log("spare"), "--wait"}};
    lookUntil(looks, [&](const json& seen) {  // it yields to nobody any more
        return seen.is_object() && seen["epoch"] != before["epoch"] && seen["cycle"] > 800;
    });
    stopped.send(SIGCONT);

    EXPECT_TRUE(logs("stopped", "took over while this one stood still, so this one is silent"));
    lookUntil([&] { return stopped.runs(); }, std::logical_not{});
    EXPECT_FALSE(stopped.runs());
    EXPECT_TRUE(contains(stopped.whyItFailed(), "ended with code 5")) << stopped.whyItFailed();
    EXPECT_TRUE(spare.runs());
    EXPECT_EQ(executed("one"), 0);
}

TEST_F(CortexOwners, TheOtherRefusesWhatIsSentToItAndSaysWhose) {
    startFirst("one");
    start("two");
    ASSERT_TRUE(ownedBy("one", "which was there first"));
    const comms::Mirror eye{"eye", comms::loopback()};
    const auto structure = lookUntil([&] { return eye.structure("two"); },
                                     [](const auto& each) { return each != nullptr; });
    ASSERT_NE(structure, nullptr);
    comms::RawTool desk{"desk"};
    desk.connect(2);

    desk.commands->write(desk.command(*structure, "/arm", "startup"));

    ASSERT_TRUE(desk.answers.waitFor(1));
    const comms::Answer answer = desk.answers.elements().front();
    EXPECT_EQ(answer.agent, "two");
    EXPECT_EQ(answer.outcome, "Rejected");
    EXPECT_EQ(answer.why, "/arm belongs to agent one, which was there first");
    EXPECT_EQ(executed("two"), 0);
}

TEST_F(CortexOwners, EveryVerbSaysIt) {
    startFirst("one");
    start("two");
    ASSERT_TRUE(ownedBy("one", "which was there first"));
    const std::string sentence = both + "one, which was there first";

    for (const Words& verb : {Words{"call", "/arm", "clearFaults"},
                              {"set", "/arm", "naturalFrequency=8"},
                              {"show", "/arm"},
                              {"watch", "/arm.naturalFrequency", "--count", "1"},
                              {"watch", "/", "--count", "1"},
                              {"save", (folder.path() / "all.xml").string(), "/arm"},
                              {"list"},
                              {"agents"},
                              {"graph"}}) {
        const std::string errors = tool(verb).errors;
        EXPECT_TRUE(contains(errors, "cortex: " + sentence)) << verb[0] << ": " << errors;
        EXPECT_EQ(errors.find(both), errors.rfind(both)) << verb[0] << " says it twice: " << errors;
    }
    const std::string top = tool({"top", "--once"}).output;
    EXPECT_TRUE(contains(top, sentence)) << top;
    const Outcome doctor = tool({"doctor"});
    EXPECT_EQ(doctor.exit, 1);
    EXPECT_TRUE(contains(doctor.output, sentence)) << doctor.output;
    EXPECT_TRUE(contains(doctor.output, "let one of them alone own it")) << "both may own it";
    const json contested{{"path", "/arm"},
                         {"agents", {"one", "two"}},
                         {"owner", "one"},
                         {"why", "which was there first"}};
    EXPECT_EQ(liveJson({"agents"}, "agents")[1]["contested"][0], contested);
    EXPECT_EQ(liveJson({"top", "--once"}, "top")["contested"][0], contested);
    EXPECT_EQ(liveJson({"show", "/arm"}, "show")["contested"], contested);
    EXPECT_EQ(liveJson({"call", "/arm", "set", "naturalFrequency=9"}, "call")["contested"],
              contested);
    EXPECT_FALSE(liveJson({"show", "/one"}, "show").contains("contested"));
}

// What is stored is what the owner has, once, and what is restored goes to it.
TEST_F(CortexOwners, SaveAndRestoreAreAboutTheOwner) {
    startFirst("one");
    start("two");
    ASSERT_TRUE(ownedBy("one", "which was there first"));
    ASSERT_EQ(tool({"set", "/arm", "naturalFrequency=8"}).exit, 0);
    const std::string file = (folder.path() / "saved.xml").string();

    const Outcome saved = tool({"save", file, "/arm"});
    EXPECT_EQ(saved.exit, 0) << saved.output << saved.errors;
    const std::string text = textOf(file);
    EXPECT_EQ(text.find("path=\"/arm\""), text.rfind("path=\"/arm\"")) << text;
    EXPECT_TRUE(contains(text, "data=\"naturalFrequency\" value=\"8\"")) << text;

    ASSERT_EQ(tool({"set", "/arm", "naturalFrequency=9"}).exit, 0);
    const Outcome restored = tool({"restore", file});
    EXPECT_EQ(restored.exit, 0) << restored.output << restored.errors;
    EXPECT_TRUE(contains(restored.errors, "cortex: " + both + "one, which was there first"))
        << restored.errors;
    EXPECT_EQ(executed("one"), 3);
    EXPECT_EQ(executed("two"), 0);
}

// With folders of one authority, and a station that may command everything.
struct CortexSecuredOwners : CortexOwners {
    CortexSecuredOwners() { make({"create-authority"}), make({"create-agent", "station"}); }
    void make(const Words& arguments) const {
        const Outcome made =
            cortex(Words{"security"} + arguments, {}, (folder.path() / "").string());
        EXPECT_EQ(made.exit, 0) << made.errors;
    }
    Words keys(const std::string& name) const {
        return {"--security", (folder.path() / ("keys-" + name)).string()};
    }
    Words keysOf(const std::string& name, const Words& rights = {}) const {
        make(Words{"create-agent", name, "--out", keys(name).back()} + rights);
        return keys(name);
    }
    Outcome tool(const Words& arguments) const override {
        return live(arguments + Words{"--security", (folder.path() / "station").string()});
    }
};

TEST_F(CortexSecuredOwners, AReadOnlyMemberTakesNothing) {
    startFirst("two", keysOf("two", {"--read-only"}));
    start("one", keysOf("one"));
    EXPECT_TRUE(ownedBy("one", "as two may only look"));

    commandSixTimes();

    EXPECT_EQ(executed("one"), 6);
    EXPECT_EQ(executed("two"), 0);
}

TEST_F(CortexSecuredOwners, WhoseFolderOwnsThePathTakesItFromTheFirst) {
    startFirst("one", keysOf("one"));
    start("two", keysOf("two", {"--owns", "/arm"}));
    EXPECT_TRUE(ownedBy("two", "which has the right to it (--owns)"));

    commandSixTimes();

    EXPECT_EQ(executed("one"), 0);
    EXPECT_EQ(executed("two"), 6);
    EXPECT_TRUE(logs("one",
                     "agent two has it as well and owns it, which has the right to it (--owns); "
                     "this agent refuses commands to it: stop one, or change its path"));
}

TEST_F(CortexSecuredOwners, AnAgentWhoseFolderOwnsOtherPathsSaysWithWhichCommandItStarts) {
    const Words command = agentCommand(systemFile(folder, "one", arm)) +
                          keysOf("one", {"--owns", "/belt", "--may-command", "/arm", "/belt"});

    const Outcome outcome = runProgram(command.front(), Words(command.begin() + 1, command.end()));

    EXPECT_EQ(outcome.exit, 1);
    const std::string remedy =
        "cortex security create-agent one --owns /belt /arm --may-command /arm /belt --out one-new";
    EXPECT_TRUE(contains(outcome.errors,
                         "the security folder of one owns /belt; /arm is not below it: " + remedy))
        << outcome.errors;
    const Outcome made =
        runProgram("sh", {"-c", CORTEX_BINARY_DIR "/bin/" + remedy}, {}, folder.path().string());
    EXPECT_EQ(made.exit, 0) << made.errors;
}

// Agent one on the first of two hosts, agent two on the second. A tool looks from either.
struct SplitOwners : CortexOwners {
    void SetUp() override {
        if (const std::string why = whyNoHosts(); !why.empty()) GTEST_SKIP() << why;
        hosts.emplace();
        looksFrom = &hosts->first;
    }
    void TearDown() override { agents.clear(); }
    Words launch(const std::string& name) const override {
        const Host& host = name == "one" ? hosts->first : hosts->second;
        return {"/usr/bin/nsenter",
                "--net=" + host.path(),
                CORTEX_BINARY_DIR "/bin/cortex-agent",
                systemFile(folder, name, arm),
                "--domain",
                domain};
    }
    Outcome tool(const Words& arguments) const override {
        Outcome outcome;
        looksFrom->within(
            [&] { outcome = cortex(arguments + Words{"--domain", domain, "--timeout", patient}); });
        return outcome;
    }
    void expectThatAllGoesTo(const std::string& owner, const std::string& other,
                             const std::string& why) {
        for (const Host* host : {&hosts->first, &hosts->second}) {
            looksFrom = host;
            ASSERT_TRUE(ownedBy(owner, why)) << tool({"agents"}).output << textOf(log(other));
            const std::int64_t before = executed(owner), beside = executed(other);
            commandSixTimes();
            EXPECT_EQ(executed(owner), before + 6);
            EXPECT_EQ(executed(other), beside);
        }
    }

    std::optional<TwoHosts> hosts;
    const Host* looksFrom = nullptr;
};

TEST_F(SplitOwners, AgreeAgainOnTheFirstWhenTheNetworkHasHealed) {
    startFirst("two");
    start("one");
    ASSERT_TRUE(ownedBy("two", "which was there first"));

    hosts->cut();
    for (const auto& [host, name] : {std::pair{&hosts->first, "one"}, {&hosts->second, "two"}}) {
        looksFrom = host;
        EXPECT_TRUE(takesOver(name)) << "each side has an owner";
    }
    hosts->join();

    expectThatAllGoesTo("two", "one", "which was there first");
}

TEST_F(SplitOwners, AgreeOnTheFirstAlthoughTheyMetLater) {
    hosts->cut();
    looksFrom = &hosts->second;
    startFirst("two");
    looksFrom = &hosts->first;
    startFirst("one");
    hosts->join();

    expectThatAllGoesTo("two", "one", "which");  // runs longer, or was there first
}

TEST_F(CortexLive, WhoElseSpeaksInTheNameOfAnAgentIsShown) {
    const auto noted = [](const json& each) { return each[0]["other_self"] != ""; };
    const json before = liveJson({"agents"}, "agents");
    comms::RawTool liar{"liar"};
    liar.connect();
    comms::Presence forged = liar.presence("stopping");
    forged.agent = comms::agentId("mixer");
    forged.name = "mixer";
    forged.role = "agent";
    forged.epoch = before[0]["epoch"];

    const json seen = lookUntil(
        [&] {
            liar.presences->write(liar.presence());  // nobody waits for its name
            liar.presences->write(forged);
            return liveJson({"agents"}, "agents");
        },
        noted);

    const std::string words = "somebody else says that mixer is stopping";
    EXPECT_EQ(seen[0]["other_self"], words);
    EXPECT_EQ(seen[0]["state"], "running") << "nobody ends it";
    EXPECT_TRUE(contains(live({"agents"}).output, words));
    const Outcome doctor = live({"doctor"});
    EXPECT_TRUE(contains(doctor.output, "is not alone with its name: " + words)) << doctor.output;
    EXPECT_EQ(doctor.exit, 1);
}

TEST_F(CortexLive, AnotherStartOfAnAgentIsShown) {
    lookUntil([] { return live({"list", "/mixer"}); },
              [](const Outcome& each) { return each.exit == 0; });
    const Background second{agentCommand((folder.path() / "mixer.xml").string()) + Words{"--wait"}};

    const json seen = lookUntil([] { return liveJson({"agents"}, "agents"); },
                                [](const json& each) { return each[0]["other_self"] != ""; });

    const std::string words = "another start of mixer is heard, on host ";
    EXPECT_TRUE(contains(seen[0]["other_self"], words)) << seen;
    EXPECT_TRUE(contains(live({"agents"}).output, words));
    const std::string said = live({"doctor"}).output;
    EXPECT_TRUE(contains(said, "is not alone with its name: " + words)) << said;
    EXPECT_TRUE(contains(said, ": the same system, started at 20")) << said;
    EXPECT_TRUE(contains(said, "the system runs twice: end the other start")) << said;
    EXPECT_FALSE(contains(said, "several agents are called")) << said;
    EXPECT_FALSE(contains(said, "<cluster name=")) << "another name would mend nothing: " << said;
}

}  // namespace
}  // namespace cortex::test
