// SPDX-License-Identifier: Apache-2.0
// top, doctor, save, restore, types and graph, against agents that are processes of their own.
#include "cli/json_schema.hpp"
#include "cli/live_agent.hpp"
#include "cli/on_terminal.hpp"
#include "core/model_folder.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;

const std::string program = CORTEX_BINARY_DIR "/bin/cortex";

TEST_F(CortexLive, TopPrintsOneMomentOfEverything) {
    ASSERT_EQ(live({"call", "/mixer", "startup", "prefix=/"}).exit, 0);

    const json top = liveJson({"top", "--once"}, "top");
    ASSERT_EQ(top["agents"].size(), 1U);
    const json& mixer = top["agents"][0];
    EXPECT_EQ(mixer["name"], "mixer");
    EXPECT_EQ(mixer["states"]["Active"], 2);
    EXPECT_EQ(mixer["qualities"]["lost"], 0) << mixer;
    EXPECT_GT(mixer["loop"]["cycleDurationMean"], 0);
    EXPECT_EQ(mixer["loop"]["commandCount"], 1);
    EXPECT_TRUE(top["faults"].empty());

    const json below = liveJson({"top", "--once", "/drive"}, "top");
    EXPECT_EQ(below["agents"][0]["states"]["Active"], 1);
    EXPECT_TRUE(below["agents"][0]["loop"].is_object()) << "whatever the prefix";

    const Outcome text =
        lookUntil([] { return live({"top", "--once"}); },
                  [](const Outcome& seen) { return contains(seen.output, "running"); });
    EXPECT_EQ(text.exit, 0) << text.errors;
    EXPECT_TRUE(contains(text.output, "late us")) << text.output;
    EXPECT_TRUE(contains(text.output, "running")) << text.output;
    EXPECT_FALSE(contains(text.output, "\033")) << "no terminal";
}

TEST_F(CortexLive, TopEndsAfterItsTimeAndWithTheLastAgent) {
    const Outcome lines = live({"top", "--json", "--rate", "30", "--seconds", "0.5"});
    EXPECT_EQ(lines.exit, 0) << lines.errors;
    ASSERT_FALSE(linesOf(lines.output).empty());
    for (const std::string& line : linesOf(lines.output)) EXPECT_EQ(violationsOf("top", line), "");

    const std::string file = (folder.path() / "mixer.xml").string();
    agent->end(SIGTERM);
    agent.emplace(agentCommand(file) + std::vector<std::string>{"--seconds", "3"});
    const Outcome text = live({"top", "--until-gone", "--seconds", "60"});
    EXPECT_EQ(text.exit, 0) << text.errors;
    const auto last = text.output.rfind("cortex top");
    ASSERT_NE(last, std::string::npos) << text.output;
    EXPECT_TRUE(contains(text.output.substr(last), "running")) << "the last moment with an agent";
}

// What a person sees of the last frame, a line an element.
std::vector<std::string> frameOf(const std::string& output) {
    std::string text;
    const std::string frame = output.substr(output.rfind("\033[H") + 3);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        if (frame[i] != '\033') {
            if (frame[i] != '\r') text += frame[i];
            continue;
        }
        while (i + 1 < frame.size() && std::isalpha(static_cast<unsigned char>(frame[i])) == 0) ++i;
    }
    return linesOf(text);
}

constexpr const char* otherScreen = "\033[?1049h";
constexpr const char* ownScreen = "\033[?1049l";

TEST_F(CortexLive, TopFitsTheTerminalAndGivesItBack) {
    ASSERT_EQ(live({"list"}).exit, 0);

    for (const int how : {0, SIGINT, SIGTERM}) {
        OnTerminal top{std::vector<std::string>{program, "top", "--rate", "30"} + network, 60, 18};
        ASSERT_TRUE(top.shows("running")) << top.output();
        ASSERT_TRUE(top.shows("events\033")) << top.output();
        EXPECT_TRUE(contains(top.output(), otherScreen));
        EXPECT_TRUE(contains(top.output(), "\033[32mrunning")) << "coloured";
        const auto lines = frameOf(top.output());
        EXPECT_LE(lines.size(), 18U);
        for (const std::string& each : lines) EXPECT_LE(each.size(), 60U) << each;
        EXPECT_FALSE(contains(top.output(), ownScreen));

        if (how == 0)
            top.type("q");
        else
            top.signal(how);
        EXPECT_TRUE(top.shows(ownScreen)) << how;
        EXPECT_EQ(top.exit(), 0) << how;
    }
}

TEST_F(CortexLive, SavesAndRestoresSettableItems) {
    const std::string file = (folder.path() / "saved.xml").string();
    ASSERT_EQ(live({"set", "/drive", "naturalFrequency=9.333333333333334"}).exit, 0);

    const json saved = liveJson({"save", file}, "save");
    EXPECT_EQ(saved["simplexes"], 1);
    EXPECT_EQ(saved["items"], 2);
    const std::string text = textOf(file);
    EXPECT_TRUE(contains(text,
                         "<set data=\"naturalFrequency\" value=\"9.333333333333334\"/>  "
                         "<!-- Hz, 0.5 .. 15 -->"))
        << text;
    EXPECT_EQ(live({"save", file}).exit, 1) << "the file exists";
    EXPECT_EQ(live({"save", file, "/drive", "--force"}).exit, 0);
    EXPECT_EQ(live({"save", file, "/axis", "--force"}).exit, 3) << "nothing settable";
    const std::string link = (folder.path() / "link.xml").string();
    std::filesystem::create_symlink(file, link);
    EXPECT_TRUE(contains(live({"save", link, "--force"}).errors, "link.xml' is no regular file"));
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_EQ(textOf(file).find("/drive") == std::string::npos, false);

    EXPECT_EQ(liveJson({"restore", file}, "restore")["same"], 2);
    ASSERT_EQ(live({"set", "/drive", "naturalFrequency=8"}).exit, 0);
    const Outcome dry = live({"restore", file, "--dry-run"});
    EXPECT_EQ(dry.exit, 0) << dry.errors;
    EXPECT_TRUE(contains(dry.output, "/drive.naturalFrequency  8 -> 9.333333333333334  Hz"))
        << dry.output;
    const json restored = liveJson({"restore", file}, "restore");
    EXPECT_EQ(restored["differences"][0]["now"], 8) << "a dry run changes nothing";
    EXPECT_EQ(restored["results"][0]["outcome"], "Done");
    EXPECT_EQ(liveJson({"show", "/drive"}, "show")["data"]["naturalFrequency"]["value"],
              9.333333333333334);
}

TEST_F(CortexLive, RestoresNothingWhereSomethingIsWrongAndSaysAllOfIt) {
    const std::string file = folder.write("wrong.xml", R"(<system name="saved">
  <simplex path="/drive" type="SimulatedAxis">
    <set data="naturalFrequency" value="9"/>
    <set data="dampingRatio" value="7"/>
    <set data="dampingRatios" value="1"/>
    <set data="followingError" value="0"/>
    <set data="faultText" value="&quot;"/>
  </simplex>
  <simplex path="/drvie" type="SimulatedAxis"><set data="dampingRatio" value="1"/></simplex>
  <simplex path="/controller" type="SimulatedAxis"><set data="dampingRatio" value="1"/></simplex>
</system>)");
    ASSERT_EQ(live({"set", "/drive", "naturalFrequency=8"}).exit, 0);

    const json outcome = liveJson({"restore", file}, "restore", 1);
    std::vector<std::string> rules;
    for (const json& each : outcome["findings"]) rules.push_back(each["rule"]);
    EXPECT_EQ(rules, (std::vector<std::string>{"out-of-range", "unknown-item", "not-settable",
                                               "not-settable", "unknown-path", "stored-type"}));
    EXPECT_EQ(outcome["findings"][0]["line"], 4);
    EXPECT_TRUE(outcome["results"].empty());
    EXPECT_FALSE(contains(live({"restore", file}).output, "->")) << "what reads as a change made";
    EXPECT_TRUE(contains(live({"restore", file, "--dry-run"}).output, "8 -> 9"));
    EXPECT_EQ(liveJson({"show", "/drive"}, "show")["data"]["naturalFrequency"]["value"], 8);
    EXPECT_EQ(live({"restore", (folder.path() / "none.xml").string()}).exit, 3);
}

// A settable text, which no shipped type has.
TEST(CortexSave, BringsTextBackAsItWas) {
    const ModelFolder folder;
    const std::string system = folder.write("mixer.xml", mixerSystem()).string();
    folder.copyOntology();
    std::string ontology = folder.read("robotics.xml");
    const std::string place = "<data name=\"naturalFrequency\"";
    ASSERT_NE(ontology.find(place), std::string::npos);
    ontology.insert(ontology.find(place), R"(
    <data name="label" kind="string" settable="always" description="What people call it."/>
    <data name="words" kind="string" length="2" settable="always" description="Two of them."/>
    <data name="title" kind="string" capacity="16" settable="always" description="Short."/>
    <data name="mode" kind="int" labels="0:Off 1:On" settable="always" description="Two."/>
    )");
    folder.write("robotics.xml", ontology);
    const Background agent{agentCommand(system)};
    const std::string file = (folder.path() / "saved.xml").string();
    const std::string label = "it's \"left\" & <right>,\n\tüber";
    const std::string words = "\"a b\" c";
    ASSERT_EQ(live({"set", "/drive", "label=" + label, "words=" + words}).exit, 0);

    EXPECT_TRUE(contains(live({"set", "/drive", "title=abcdefghijklmnopq"}).errors,
                         "title: takes 16 bytes, and 17 are given"));
    EXPECT_TRUE(contains(live({"set", "/drive", "mode=7"}).errors,
                         "mode: 7 has no label; labels: 0:Off 1:On"));
    EXPECT_TRUE(contains(live({"set", "/drive", "mode=Onn"}).errors,
                         "mode: no label 'Onn'; nearest of: On; labels: 0:Off 1:On"));
    ASSERT_EQ(live({"save", file}).exit, 0);
    ASSERT_EQ(live({"set", "/drive", "label=other", "words=x y"}).exit, 0);
    ASSERT_EQ(live({"restore", file}).exit, 0);

    const json data = liveJson({"show", "/drive"}, "show")["data"];
    EXPECT_EQ(data["label"]["value"], label);
    EXPECT_EQ(data["words"]["value"], (json{"a b", "c"}));
}

// An agent whose drive has more than fits into one datagram, of which `a` does not fit alone.
struct LargeDrive {
    LargeDrive() {
        folder.copyOntology();
        std::string ontology = folder.read("robotics.xml");
        ontology.insert(ontology.find("<data name=\"naturalFrequency\""), R"(
    <data name="a" kind="float" length="8200" settable="always" description="Too large."/>
    <data name="b" kind="int" length="5000" settable="always" description="Large."/>
    <data name="c" kind="int" length="5000" settable="always" description="Large."/>
    )");
        folder.write("robotics.xml", ontology);
        agent.emplace(agentCommand(folder.write("mixer.xml", mixerSystem()).string()));
    }
    static std::string ones(int count) {
        std::string text;
        for (int i = 0; i < count; ++i) text += "1 ";
        return text;
    }
    static std::string setting(const std::string& item, const std::string& value) {
        return "<set data=\"" + item + "\" value=\"" + value + "\"/>\n";
    }

    ModelFolder folder;
    std::optional<Background> agent;
};

TEST(CortexSave, ASetThatIsTooLargeIsRefusedBeforeItIsSentAndRestoreDividesIt) {
    LargeDrive drive;
    const std::string many = LargeDrive::ones(5000), most = LargeDrive::ones(8200);

    const Outcome alone = live({"set", "/drive", "a=" + most});
    EXPECT_EQ(alone.exit, 1) << alone.errors;
    EXPECT_TRUE(contains(alone.output,
                         "at most 64000 can be sent at once; nothing was sent: give 'a' its value "
                         "in the system file"))
        << alone.output;
    EXPECT_TRUE(contains(live({"set", "/drive", "b=" + many, "c=" + many}).output,
                         "nothing was sent: set fewer items at a time"));
    EXPECT_EQ(live({"set", "/drive", "dampingRatio=0.8"}).exit, 0) << "its number was taken back";

    const std::string settings = LargeDrive::setting("a", most) + LargeDrive::setting("b", many) +
                                 LargeDrive::setting("c", many) +
                                 LargeDrive::setting("dampingRatio", "0.9");
    const std::string file =
        drive.folder
            .write("large.xml",
                   "<system name=\"saved\"><simplex path=\"/drive\" type=\"SimulatedAxis\">" +
                       settings + "</simplex></system>")
            .string();
    std::string done;
    const json restored = liveJson({"restore", file}, "restore", 1);
    for (const json& each : restored["results"])
        done += each["items"].dump() + each["outcome"].dump();
    EXPECT_EQ(done, R"(["a"]"Rejected"["b"]"Done"["c","dampingRatio"]"Done")");
    EXPECT_TRUE(
        contains(live({"restore", file}).errors, "cortex: /drive.a: Rejected: the command"));
    const json data = liveJson({"show", "/drive"}, "show")["data"];
    EXPECT_EQ(data["b"]["value"][4999], 1);
    EXPECT_EQ(data["c"]["value"][4999], 1);
    EXPECT_EQ(data["dampingRatio"]["value"], 0.9);
}

TEST_F(CortexLive, ShowsTypesAndGraphAsFilesDo) {
    const std::string file = (folder.path() / "mixer.xml").string();

    json ofFile = json::parse(cortex({"graph", "--json", "--file", file}).output);
    json ofNetwork = liveJson({"graph"}, "graph");
    ofFile.erase("system");
    ofNetwork.erase("system");
    EXPECT_EQ(ofNetwork, ofFile);
    EXPECT_TRUE(contains(live({"graph", "--dot"}).output, "digraph"));

    const json type = liveJson({"types", "SimulatedAxis"}, "type");
    EXPECT_EQ(type["hash"], json::parse(cortex({"types", "SimulatedAxis", "--json", "--file",
                                                "robotics-morphology.xml"})
                                            .output)["hash"]);
    EXPECT_GT(liveJson({"types"}, "types")["types"].size(), 5U);
    EXPECT_EQ(live({"types", "SimulatedAxi"}).exit, 3);
    EXPECT_EQ(cortex({"types", "--domain", "7", "--file", "base.xml"}).exit, 2);
}

TEST(CortexGraph, JoinsWhatAgentsHaveOfEachOther) {
    const ModelFolder folder;
    std::optional<Background> front{
        agentCommand(systemFile(folder, "front",
                                "<simplex path=\"/front/lbr\" type=\"KukaLbr\"/>"
                                "<simplex path=\"/front/gripper\" type=\"Robotiq2Finger\"/>"))};
    const Background back{agentCommand(
        systemFile(folder, "back",
                   "<simplex path=\"/back/arm\" type=\"Arm\">"
                   "<relate rule=\"manipulator\" to=\"/front/lbr\" remote=\"true\"/>"
                   "<relate rule=\"gripper\" to=\"/front/gripper\" remote=\"true\"/></simplex>"))};
    const json graph =  // the second may not have begun
        lookUntil([] { return liveJson({"graph"}, "graph"); },
                  [](const json& seen) { return seen["simplexes"].size() >= 20; });

    ASSERT_EQ(graph["simplexes"].size(), 20U) << graph;
    for (const json& each : graph["simplexes"]) {
        EXPECT_EQ(each["remote"], false) << each;
        const std::string path = each["path"];
        EXPECT_EQ(each["agent"], path.starts_with("/front") ? "front" : "back") << each;
    }
    const Outcome text =
        lookUntil([] { return live({"graph"}); },
                  [](const Outcome& seen) { return contains(seen.output, "(front)"); });
    EXPECT_TRUE(contains(text.output, "manipulator  <- /front/lbr (front)")) << text.output;

    front->end(SIGTERM);
    const Outcome alone = live({"graph"});
    EXPECT_TRUE(contains(alone.output, "manipulator  <- /front/lbr (another agent)"))
        << alone.output;
}

TEST_F(CortexLive, DoctorLooksAtMachineNetworkAndAgents) {
    const Outcome outcome = live({"doctor", "--json"});
    EXPECT_EQ(violationsOf("doctor", outcome.output), "") << outcome.output << outcome.errors;
    std::vector<std::string> subjects;
    bool errors = false;
    const json doctor = json::parse(outcome.output);
    for (const json& each : doctor["findings"]) {
        subjects.push_back(each["subject"]);
        errors = errors || each["level"] == "error";
        EXPECT_NE(each["message"], "");
        EXPECT_EQ(each["level"] == "ok", each["remedy"] == "") << each;
    }
    EXPECT_EQ(outcome.exit, errors ? 1 : 0);
    for (const char* each :
         {"cpu", "kernel", "priority", "memory", "clock", "timer", "shared memory", "preemption",
          "isolation", "idle", "hypervisor", "interface", "ports", "firewall", "agent"}) {
        EXPECT_EQ(std::ranges::count(subjects, each) > 0, true) << each << outcome.output;
    }
    const Outcome text = live({"doctor"});
    EXPECT_TRUE(contains(text.output, "agent          mixer on ")) << text.output;
}

// On a CPU with FMA the C library has two versions of many functions, with other last bits.
TEST(CortexDoctor, TellsVariantsOfTheMathematicalFunctionsApart) {
    const auto variant = [](const std::vector<std::string>& words) {
        const std::string output = cortex(words).output;
        const std::size_t begin = output.find("variant ");
        return begin == std::string::npos ? output : output.substr(begin, 16);
    };
    const std::vector<std::string> words =
        std::vector<std::string>{"doctor", "--timeout", "0.05"} + network;
    const std::string here = variant(words);
    EXPECT_EQ(here.size(), 16U) << here;
    EXPECT_EQ(variant(words), here);
    if (!__builtin_cpu_supports("fma")) GTEST_SKIP() << "this CPU has no FMA instructions";
    setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA", 1);
    const std::string older = variant(words);
    unsetenv("GLIBC_TUNABLES");
    EXPECT_EQ(older.size(), 16U) << older;
    EXPECT_NE(older, here);
}

TEST(CortexDoctor, SaysThatNobodyIsThereAndGoesOn) {
    const Outcome outcome =
        cortex(std::vector<std::string>{"doctor", "--timeout", "0.05"} + network);

    EXPECT_TRUE(contains(outcome.output, "no agent on domain " + domain)) << outcome.output;
    EXPECT_NE(outcome.exit, 3);
}

}  // namespace
}  // namespace cortex::test
