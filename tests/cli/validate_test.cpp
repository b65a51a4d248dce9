// SPDX-License-Identifier: Apache-2.0
#include "cli/cortex_process.hpp"
#include "cli/json_schema.hpp"
#include "core/model_folder.hpp"

#include <filesystem>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;

const std::string example = CORTEX_SOURCE_DIR "/examples/lbr_teleop/lbr_teleop.xml";
const std::string ontology = CORTEX_SOURCE_DIR "/ontology/";

std::string systemOf(const std::string& simplexes) {
    return "<system name=\"test\">\n<morphology file=\"robotics-morphology.xml\"/>\n"
           "<cluster name=\"test\"/>\n" +
           simplexes + "</system>\n";
}

json findingsOf(const Outcome& outcome) { return json::parse(outcome.output).at("findings"); }

TEST(CortexValidate, CountsTheSimplexesOfAValidSystemWithThoseThatRulesCreate) {
    const Outcome outcome = cortex({"validate", example});

    EXPECT_EQ(outcome.exit, 0) << outcome.output << outcome.errors;
    EXPECT_EQ(outcome.output, example + ": valid, 48 simplexes, 16 active\n");
    EXPECT_EQ(outcome.errors, "");
}

TEST(CortexValidate, ChecksTypesAndRulesWithoutASystem) {
    const ModelFolder folder;
    folder.write("t.xml",
                 "<ontology name=\"t\" version=\"1.0\">\n<type name=\"A\">\n"
                 "<data name=\"x\" kind=\"float\" unit=\"furlong\"/></type></ontology>\n");

    const Outcome outcome = cortex({"validate", "t.xml"}, {}, folder.path());

    EXPECT_EQ(outcome.exit, 1);
    EXPECT_NE(outcome.output.find("error: A"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("[t.xml:3]"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("\n1 error in 1 file\n"), std::string::npos) << outcome.output;
}

TEST(CortexValidate, AcceptsEveryShippedOntologyFile) {
    for (const char* name :
         {"base.xml", "base-morphology.xml", "robotics.xml", "robotics-morphology.xml"}) {
        const Outcome outcome = cortex({"validate", ontology + name});
        EXPECT_EQ(outcome.exit, 0) << outcome.output;
        EXPECT_NE(outcome.output.find(": valid, "), std::string::npos) << outcome.output;
    }
}

TEST(CortexValidate, PrintsOneFindingALineWithPlaceAndRemedy) {
    const ModelFolder folder;
    folder.write("arm.xml", systemOf("<simplex path=\"/arm\" type=\"Arm\">\n"
                                     "<relate rule=\"manipulator\" to=\"/lbr\"/></simplex>\n"
                                     "<simplex path=\"/lbr\" type=\"KukaLbr\"/>\n"));

    const Outcome outcome = cortex({"validate", "arm.xml"}, {}, folder.path());

    EXPECT_EQ(outcome.exit, 1);
    EXPECT_EQ(outcome.output.find("error: /arm: "), 0U) << outcome.output;
    EXPECT_NE(outcome.output.find("Gripper"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find(".xml:"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("<relate rule=\"gripper\""), std::string::npos) << outcome.output;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 2) << outcome.output;
}

TEST(CortexValidate, GivesFindingsAsJsonOfTheCommittedSchema) {
    const ModelFolder folder;
    folder.write("arm.xml", systemOf("<simplex path=\"/arm\" type=\"Arm\"/>\n"));

    const Outcome outcome = cortex({"validate", "arm.xml", "--json"}, {}, folder.path());

    EXPECT_EQ(outcome.exit, 1);
    EXPECT_EQ(violationsOf("validate", outcome.output), "");
    const json findings = findingsOf(outcome);
    ASSERT_EQ(findings.size(), 2U) << outcome.output;
    EXPECT_EQ(findings[0]["severity"], "error");
    EXPECT_EQ(findings[0]["path"], "/arm");
    EXPECT_GT(findings[0]["line"], 0);
    EXPECT_NE(findings[0]["remedy"], "");
}

TEST(CortexValidate, GivesAnEmptyListForAValidModel) {
    const Outcome outcome = cortex({"validate", "--json", example});

    EXPECT_EQ(outcome.exit, 0);
    EXPECT_EQ(violationsOf("validate", outcome.output), "");
    EXPECT_TRUE(findingsOf(outcome).empty());
}

TEST(CortexValidate, KnowsTheSimplexOfTheAgentItself) {
    const ModelFolder folder;
    folder.write("clash.xml", systemOf("<simplex path=\"/test\" type=\"RotaryAxisConcept\"/>\n"));

    const Outcome outcome = cortex({"validate", "clash.xml", "--json"}, {}, folder.path());

    EXPECT_EQ(outcome.exit, 1);
    EXPECT_EQ(findingsOf(outcome).at(0)["path"], "/test");
}

// The two agents of the case study, with what one of them reads written otherwise.
Outcome validateTwo(const std::string& written, const std::string& instead) {
    const ModelFolder folder;
    const std::filesystem::path files = std::filesystem::path{example}.parent_path();
    for (const char* name :
         {"arm.xml", "hand.xml", "robot.xml", "operator.xml", "synthetic_hand_path.csv"}) {
        std::string text = textOf(files / name);
        const std::size_t at = text.find(written);
        if (at != std::string::npos) text.replace(at, written.size(), instead);
        folder.write(name, text);
    }
    return cortex({"validate", "robot.xml", "operator.xml"}, {}, folder.path());
}

TEST(CortexValidate, LooksForThePathsOfAnotherAgentInTheOtherSystem) {
    const std::string clutch = "rule=\"enable\" to=\"/handset/trigger\" remote=\"true\"";
    const Outcome right = validateTwo(clutch, clutch);
    EXPECT_EQ(right.exit, 0) << right.output;
    EXPECT_FALSE(contains(right.output, "remote-path")) << right.output;

    const Outcome misspelt =
        validateTwo(clutch, "rule=\"enable\" to=\"/handset/triger\" remote=\"true\"");
    EXPECT_EQ(misspelt.exit, 0) << misspelt.output;
    EXPECT_TRUE(contains(misspelt.output,
                         "rule 'enable' names /handset/triger of another agent, but no system "
                         "given has it [arm.xml:69]; nearest of: /handset/trigger"))
        << misspelt.output;

    const Outcome other = validateTwo(clutch, "rule=\"enable\" to=\"/playback\" remote=\"true\"");
    EXPECT_EQ(other.exit, 1) << other.output;
    EXPECT_TRUE(contains(other.output, "rule 'enable' reads /playback (HandsetPlayback, "))
        << other.output;
    EXPECT_TRUE(contains(other.output, "is needed, the other agent has a HandsetPlayback"))
        << other.output;
    EXPECT_TRUE(contains(other.output, "[arm.xml:69]")) << other.output;
}

TEST(CortexValidate, OfSeveralSystemsFindsAgentsOfOneNameAndPathsThatTwoHave) {
    const ModelFolder folder;
    const auto write = [&](const std::string& file, const std::string& agent,
                           const std::string& path) {
        folder.write(file,
                     "<system name=\"t\"><morphology file=\"cortex-morphology.xml\"/>\n"
                     "<cluster name=\"" +
                         agent +
                         "\" frequency=\"100\"/>\n"
                         "<simplex path=\"" +
                         path + "\" type=\"RotaryAxisConcept\"/></system>");
    };
    write("left.xml", "robot", "/arm");
    write("right.xml", "robot", "/arm");
    write("other.xml", "line", "/arm");
    write("third.xml", "third", "/table");
    const auto validate = [&](std::vector<std::string> files) {
        files.insert(files.begin(), {"validate", "--json"});
        return cortex(files, {}, folder.path());
    };

    const Outcome names = validate({"left.xml", "right.xml"});
    EXPECT_EQ(names.exit, 1) << names.output;
    ASSERT_EQ(findingsOf(names).size(), 2U) << names.output;
    EXPECT_EQ(findingsOf(names).at(0)["rule"], "agent-twice");
    EXPECT_EQ(findingsOf(names).at(0)["path"], "/robot");
    EXPECT_EQ(findingsOf(names).at(0)["line"], 2);

    const Outcome paths = validate({"left.xml", "other.xml", "third.xml"});
    EXPECT_EQ(paths.exit, 0) << "one may be the spare of the other";
    ASSERT_EQ(findingsOf(paths).size(), 1U) << paths.output;
    EXPECT_EQ(findingsOf(paths).at(0)["rule"], "path-twice");
    EXPECT_EQ(findingsOf(paths).at(0)["path"], "/arm");
    EXPECT_EQ(validate({"left.xml", "third.xml"}).exit, 0);
}

// The plant examples/ds402_dual_axis with two lines exchanged: each axis would run to the place of
// the other one.
TEST(CortexValidate, RefusesADriveThatIsToldWhatItsOtherAxisIsToDo) {
    const std::filesystem::path files = CORTEX_SOURCE_DIR "/examples/ds402_dual_axis";
    const ModelFolder folder;
    folder.write("table-types.xml", textOf(files / "table-types.xml"));
    std::string text = textOf(files / "ds402_dual_axis.xml");
    const std::size_t a = text.find("rule=\"setpoints\" to=\"/set/a\""), b = text.find("/set/b", a);
    text.replace(b, 6, "/set/a");
    text.replace(text.find("/set/a", a), 6, "/set/b");
    folder.write("crossed.xml", text);

    const Outcome outcome = cortex({"validate", "crossed.xml", "--json"}, {}, folder.path());

    EXPECT_EQ(outcome.exit, 1) << outcome.output;
    ASSERT_EQ(findingsOf(outcome).size(), 1U) << outcome.output;
    EXPECT_EQ(findingsOf(outcome).at(0)["rule"], "pair-crossed");
    EXPECT_EQ(findingsOf(outcome).at(0)["path"], "/processor");
}

// A drive of one agent, and what leads it in another one; the remote axes are known by their type.
Outcome validateDriveElsewhere(const std::string& first, const std::string& second) {
    const auto simplexes = [](const std::string& path, const std::string& type) {
        return "<simplex path=\"" + path + "/a\" type=\"" + type + "\"/>\n<simplex path=\"" + path +
               "/b\" type=\"" + type + "\"/>\n";
    };
    const auto both = [](const std::string& rule, const std::string& path,
                         const std::string& more = "") {
        return "<relate rule=\"" + rule + "\" to=\"" + path + "/a\"" + more +
               "/>\n<relate rule=\"" + rule + "\" to=\"" + path + "/b\"" + more + "/>\n";
    };
    const auto remote = [](const std::string& type) {
        return " remote=\"true\" type=\"Ds402Rotary" + type + "\"";
    };
    const auto system = [](const std::string& name, const std::string& text) {
        return "<system name=\"" + name + "\">\n<morphology file=\"cortex-morphology.xml\"/>\n" +
               text + "<cluster name=\"" + name + "\"/>\n</system>\n";
    };
    const ModelFolder folder;
    folder.write("drive.xml",
                 system("far", "<simplex path=\"/drive\" type=\"Ds402SimulatedDrive\">\n" +
                                   both("demands", "/set", remote("Modification")) +
                                   both("observations", "/axis") + "</simplex>\n" +
                                   simplexes("/axis", "Ds402RotaryObservation")));
    folder.write(
        "lead.xml",
        system("lead", "<simplex path=\"/processor\" type=\"Ds402AxisProcessor\">\n" +
                           both("drives", "/axis", remote("Observation")) +
                           both("demands", "/demand") + "<relate rule=\"setpoints\" to=\"" + first +
                           "\"/>\n<relate rule=\"setpoints\" to=\"" + second +
                           "\"/>\n</simplex>\n" + simplexes("/set", "Ds402RotaryModification") +
                           simplexes("/demand", "RotaryAxisConcept") +
                           "<simplex path=\"/pose\" type=\"AxisPoseController\">\n" +
                           both("axes", "/axis", remote("Observation")) +
                           both("demands", "/demand") + "</simplex>\n"));
    return cortex({"validate", "drive.xml", "lead.xml"}, {}, folder.path());
}

TEST(CortexValidate, RefusesADriveOfAnotherAgentThatIsToldWhatItsOtherAxisIsToDo) {
    const Outcome straight = validateDriveElsewhere("/set/a", "/set/b");
    EXPECT_EQ(straight.exit, 0) << straight.output;

    const Outcome crossed = validateDriveElsewhere("/set/b", "/set/a");
    EXPECT_EQ(crossed.exit, 1) << crossed.output;
    EXPECT_TRUE(contains(crossed.output,
                         "error: /processor: /set/b (rule 'setpoints') stands in "
                         "the place of /axis/a (rule 'drives', lead.xml:4)"))
        << crossed.output;
    EXPECT_TRUE(contains(crossed.output, "in /drive /set/b (rule 'demands', drive.xml:5)"))
        << crossed.output;
}

TEST(CortexValidate, NotesWhatItCannotCheckOfASystemAlone) {
    const Outcome alone =
        cortex({"validate", (std::filesystem::path{example}.parent_path() / "robot.xml").string()});

    EXPECT_EQ(alone.exit, 0) << alone.output;
    const std::string note =
        "note: /control/clutch: not checked: /handset/trigger of another agent";
    EXPECT_TRUE(contains(alone.output, note)) << alone.output;
    EXPECT_TRUE(contains(alone.output, "; add its system file")) << alone.output;
    EXPECT_TRUE(contains(alone.output, " notes\n")) << alone.output;
    EXPECT_FALSE(contains(alone.output, "warning")) << alone.output;
}

// As cortex-agent has it.
TEST(CortexValidate, WantsOneClusterWithANameThatCanBeAPath) {
    const ModelFolder folder;
    const auto check = [&](const std::string& clusters) {
        folder.write("s.xml", "<system name=\"s\">\n<ontology file=\"base.xml\"/>\n" + clusters +
                                  "</system>\n");
        return cortex({"validate", "s.xml"}, {}, folder.path());
    };

    EXPECT_EQ(check("<cluster name=\"a\"/>").output, "s.xml: valid, 1 simplex, 1 active\n");
    EXPECT_NE(check("").output.find("warning: the system has no cluster"), std::string::npos);
    EXPECT_NE(check("").output.find("s.xml: valid as a model, 0 simplexes, 0 active, 1 warning"),
              std::string::npos);
    EXPECT_EQ(check("").exit, 0);
    const std::vector<std::string> wrong{"<cluster name=\"a\"/><cluster name=\"b\"/>",
                                         "<cluster name=\"../x\"/>", "<cluster name=\"a/b\"/>",
                                         "<cluster name=\"\"/>", "<cluster name=\"a b\"/>"};
    for (const std::string& clusters : wrong) {
        const Outcome outcome = check(clusters);
        EXPECT_EQ(outcome.exit, 1) << clusters << outcome.output;
        EXPECT_NE(outcome.output.find("[s.xml:3]"), std::string::npos) << outcome.output;
    }
}

TEST(CortexValidate, TakesSeveralFilesAsOneModel) {
    const ModelFolder folder;
    folder.write("t.xml", "<ontology name=\"t\" version=\"1.0\"><type name=\"A\"/></ontology>\n");
    folder.write("r.xml",
                 "<morphology name=\"t\" version=\"1.0\"><rules type=\"A\">"
                 "<relationship name=\"to\" direction=\"input\" target=\"A\"/></rules>"
                 "</morphology>\n");

    EXPECT_EQ(cortex({"validate", "r.xml"}, {}, folder.path()).exit, 1);
    const Outcome outcome = cortex({"validate", "r.xml", "t.xml"}, {}, folder.path());

    EXPECT_EQ(outcome.exit, 0) << outcome.output;
    EXPECT_EQ(outcome.output, "2 files: valid, 1 type, 1 rule\n");
}

TEST(CortexValidate, ChecksEachOfSeveralSystemsAlone) {
    const ModelFolder folder;
    folder.write("one.xml", systemOf("<simplex path=\"/axis\" type=\"RotaryAxisConcept\"/>\n"));
    std::string two = systemOf("<simplex path=\"/table\" type=\"LinearAxisConcept\"/>\n");
    const std::string name = "cluster name=\"test\"";
    ASSERT_NE(two.find(name), std::string::npos) << two;
    folder.write("two.xml", two.replace(two.find(name), name.size(), "cluster name=\"two\""));

    const Outcome outcome = cortex({"validate", "one.xml", "two.xml"}, {}, folder.path());

    EXPECT_EQ(outcome.exit, 0) << outcome.output;
    EXPECT_EQ(outcome.output,
              "one.xml: valid, 2 simplexes, 1 active\ntwo.xml: valid, 2 simplexes, 1 active\n");
}

TEST(CortexValidate, EndsWith3ForAFileThatIsNotThereAndChecksTheOthers) {
    const ModelFolder folder;
    folder.write("t.xml", "<ontology name=\"t\" version=\"1.0\"><type nam=\"A\"/></ontology>\n");

    const Outcome outcome = cortex({"validate", "none.xml", "t.xml", "--json"}, {}, folder.path());

    EXPECT_EQ(outcome.exit, 3);
    EXPECT_EQ(violationsOf("validate", outcome.output), "");
    EXPECT_NE(outcome.output.find("none.xml"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("unknown-attribute"), std::string::npos) << outcome.output;
}

TEST(CortexValidate, ChecksEachSystemWhereAFileIsNotThere) {
    const ModelFolder folder;
    folder.write("one.xml", systemOf("<simplex path=\"/one\" type=\"Arm\"/>\n"));
    folder.write("two.xml", systemOf("<simplex path=\"/two\" type=\"Arm\"/>\n"));

    const Outcome outcome =
        cortex({"validate", "one.xml", "none.xml", "two.xml"}, {}, folder.path());

    EXPECT_EQ(outcome.exit, 3);
    for (const char* part : {"there is no file 'none.xml'", "error: /one: ", "error: /two: "}) {
        EXPECT_NE(outcome.output.find(part), std::string::npos) << part << outcome.output;
    }
    EXPECT_EQ(outcome.output.find("none.xml'"), outcome.output.rfind("none.xml'"))
        << "said once\n"
        << outcome.output;
}

TEST(CortexValidate, DoesNotMissTypesThatMayStandInAFileThatCannotBeRead) {
    const ModelFolder folder;
    folder.write("plant.xml",
                 "<system name=\"plant\"><ontology file=\"types.xml\"/>"
                 "<cluster name=\"plant\" frequency=\"10\"/></system>\n");

    const Outcome missing = cortex({"validate", "plant.xml"}, {}, folder.path());
    folder.write("types.xml", "<ontology name=\"types\" version=\"1.0\"><type></ontology>\n");
    const Outcome malformed = cortex({"validate", "plant.xml"}, {}, folder.path());
    folder.write("types.xml", "<ontology name=\"types\" version=\"1.0\"/>\n");
    const Outcome empty = cortex({"validate", "plant.xml"}, {}, folder.path());

    EXPECT_NE(missing.output.find("there is no file 'types.xml'"), std::string::npos);
    EXPECT_EQ(missing.output.find("agent-type"), std::string::npos) << missing.output;
    EXPECT_NE(malformed.output.find("xml-syntax"), std::string::npos) << malformed.output;
    EXPECT_EQ(malformed.output.find("agent-type"), std::string::npos) << malformed.output;
    EXPECT_NE(empty.output.find("agent-type"), std::string::npos) << empty.output;
}

TEST(CortexValidate, SaysThatAFolderIsNoFile) {
    const Outcome outcome = cortex({"validate", ontology});

    EXPECT_EQ(outcome.exit, 3);
    EXPECT_NE(outcome.output.find("this is a folder"), std::string::npos) << outcome.output;
}

TEST(CortexValidate, SurvivesFilesThatAreNoXml) {
    const ModelFolder folder;
    std::string garbage;
    for (int i = 0; i < 4096; ++i) garbage += static_cast<char>(i * 7919 >> 3);
    folder.write("garbage.xml", garbage);
    folder.write("empty.xml", "");

    for (const char* name : {"garbage.xml", "empty.xml"}) {
        const Outcome outcome = cortex({"validate", "--json", name}, {}, folder.path());
        EXPECT_EQ(outcome.exit, 1) << name;
        EXPECT_EQ(violationsOf("validate", outcome.output), "") << name;
        EXPECT_FALSE(findingsOf(outcome).empty()) << name;
    }
}

// A terminal would obey what a file's text contains.
TEST(CortexValidate, PrintsControlCharactersAsEscapes) {
    const ModelFolder folder;
    folder.write("t.xml", systemOf("<simplex path=\"/a&#27;[31m\xC2\x9B\" type=\"Arm\"/>\n"));

    const Outcome outcome = cortex({"validate", "t.xml"}, {}, folder.path());

    EXPECT_EQ(outcome.exit, 1);
    EXPECT_EQ(outcome.output.find('\x1b'), std::string::npos);
    EXPECT_EQ(outcome.output.find("\xC2\x9B"), std::string::npos);
}

TEST(CortexValidate, IsNotColouredWhereItsOutputIsNoTerminal) {
    const Outcome outcome = cortex({"validate", "none.xml"}, {{"TERM", "xterm"}, {"NO_COLOR", ""}});

    EXPECT_EQ(outcome.output.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace cortex::test
