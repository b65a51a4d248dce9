// SPDX-License-Identifier: Apache-2.0
#include "cli/cortex_process.hpp"
#include "cli/json_schema.hpp"
#include "core/model_folder.hpp"
#include "support/share.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;

const std::vector<std::string> hostileNames{
    "",  " ",    "a b", "../x", "/etc/x", "a/b",  "\x1b[2J",
    "ä", "a\"b", "<x>", "a&b",  ".",      "a\nb", std::string(200, 'a')};

// The examples of a skeleton stand alone between two lines: without these they count.
std::string withExamples(const std::string& text) {
    std::istringstream stream{text};
    std::string result;
    for (std::string line; std::getline(stream, line);) {
        if (line != "    <!--" && line != "    -->") result += line + "\n";
    }
    return result;
}

std::string validate(std::vector<std::string> files, const ModelFolder& folder) {
    files.insert(files.begin(), "validate");
    const Outcome outcome = cortex(files, {}, folder.path());
    return outcome.exit == 0 && outcome.output.find("warning") == std::string::npos
               ? ""
               : outcome.output + outcome.errors;
}

// Against the schema of editors and other tools, too.
std::string xmllint(const std::string& kind, std::vector<std::string> files,
                    const ModelFolder& folder) {
    const std::string schema = CORTEX_SOURCE_DIR "/ontology/" + kind + ".xsd";
    files.insert(files.begin(), {"--noout", "--schema", schema});
    const Outcome outcome = runProgram("xmllint", files, {}, folder.path());
    return outcome.exit == 0 ? "" : outcome.errors;
}

std::size_t filesIn(const ModelFolder& folder) {
    using std::filesystem::directory_iterator;
    return static_cast<std::size_t>(
        std::distance(directory_iterator{folder.path()}, directory_iterator{}));
}

TEST(CortexNewType, MakesFilesThatAreValidAsTheyAreAndWithTheirExamplesForEveryTypeToExtend) {
    const ModelFolder folder;
    const Outcome listed = cortex({"types", "--json", "--file", "robotics-morphology.xml"});
    const json types = json::parse(listed.output).at("types");
    ASSERT_GT(types.size(), 40U);

    std::vector<std::string> ontologies, morphologies;
    for (std::size_t i = 0; i < types.size(); i += isWhole() ? 1 : 10) {
        const std::string parent = types[i]["name"];
        ontologies.push_back("my-" + parent + ".xml");
        morphologies.push_back("my-" + parent + "-morphology.xml");
        const Outcome made =
            cortex({"new-type", "My" + parent, "--extends", parent, "-o", ontologies.back()}, {},
                   folder.path());
        ASSERT_EQ(made.exit, 0) << parent << made.errors;
    }
    EXPECT_EQ(validate(morphologies, folder), "");
    EXPECT_EQ(validate(ontologies, folder), "");

    for (const auto& files : {ontologies, morphologies}) {
        for (const std::string& file : files) folder.write(file, withExamples(folder.read(file)));
    }
    for (const std::string& file : ontologies) {
        EXPECT_NE(folder.read(file).find("\n    <data name=\"exampleItem\""), std::string::npos);
    }
    EXPECT_EQ(validate(morphologies, folder), "");
    EXPECT_EQ(xmllint("ontology", ontologies, folder), "");
    EXPECT_EQ(xmllint("morphology", morphologies, folder), "");
}

TEST(CortexNewType, OfAnAbstractParentSaysWhichUnitsAreStillToBeStated) {
    const ModelFolder folder;

    const Outcome open =
        cortex({"new-type", "Slide", "--extends", "AxisConcept"}, {}, folder.path());
    const Outcome fixed =
        cortex({"new-type", "Slide", "--extends", "LinearAxisConcept"}, {}, folder.path());

    EXPECT_NE(open.output.find("version=\"1.0\" abstract=\"true\""), std::string::npos)
        << open.output;
    EXPECT_NE(
        open.output.find("Units still open: acceleration, armature, damping, effort, friction, "
                         "position, velocity."),
        std::string::npos)
        << open.output;
    EXPECT_EQ(fixed.output.find("abstract"), std::string::npos) << fixed.output;
}

TEST(CortexNewType, PrintsBothFilesWhereNoneIsNamed) {
    const ModelFolder folder;

    const Outcome outcome = cortex({"new-type", "Pump", "--extends", "Device"}, {}, folder.path());

    EXPECT_EQ(outcome.exit, 0) << outcome.errors;
    EXPECT_NE(outcome.output.find("<type name=\"Pump\" extends=\"Device\""), std::string::npos);
    EXPECT_NE(outcome.output.find("<rules type=\"Pump\">"), std::string::npos);
    EXPECT_EQ(filesIn(folder), 0U);
}

TEST(CortexNewType, GivesBothFilesAsJsonOfTheCommittedSchema) {
    const ModelFolder folder;

    const Outcome outcome = cortex(
        {"new-type", "Pump", "--extends", "Device", "-o", "p.xml", "--json"}, {}, folder.path());

    EXPECT_EQ(outcome.exit, 0) << outcome.output;
    EXPECT_EQ(violationsOf("new-files", outcome.output), "");
    const json files = json::parse(outcome.output)["files"];
    ASSERT_EQ(files.size(), 2U);
    EXPECT_EQ(files[0]["file"], "p.xml");
    EXPECT_EQ(files[1]["file"], "p-morphology.xml");
    EXPECT_EQ(files[0]["text"], folder.read("p.xml"));
    EXPECT_EQ(files[1]["text"], folder.read("p-morphology.xml"));
}

TEST(CortexNewType, RefersToFilesThatWereGivenAsSeenFromTheOnesItWrites) {
    const ModelFolder folder;
    std::filesystem::create_directories(folder.path() / "model");
    std::filesystem::create_directories(folder.path() / "mine");
    folder.write("model/base types.xml",
                 "<ontology name=\"b\" version=\"1.0\"><type name=\"A\"/></ontology>");
    folder.write("model/rules.xml",
                 "<morphology name=\"b\" version=\"1.0\">"
                 "<include file=\"base types.xml\"/></morphology>");

    const Outcome made =
        cortex({"new-type", "B", "--extends", "A", "--file", "model/rules.xml", "-o", "mine"},
               {{"CORTEX_PATH", ""}}, folder.path());

    EXPECT_EQ(made.exit, 0) << made.errors;
    EXPECT_NE(folder.read("mine/B.xml").find("<include file=\"../model/base types.xml\"/>"),
              std::string::npos)
        << folder.read("mine/B.xml");
    EXPECT_EQ(validate({"mine/B-morphology.xml"}, folder), "");
}

TEST(CortexNewType, ExtendsSeveralTypesThatAgree) {
    const ModelFolder folder;

    EXPECT_EQ(
        cortex({"new-type", "Tool", "--extends", "Gripper", "OneDofManipulator", "-o", "t.xml"}, {},
               folder.path())
            .exit,
        0);
    EXPECT_EQ(validate({"t-morphology.xml"}, folder), "");
    const Outcome commas =
        cortex({"new-type", "Tool", "--extends", "Gripper,OneDofManipulator"}, {}, folder.path());
    EXPECT_NE(commas.output.find("extends=\"Gripper OneDofManipulator\""), std::string::npos)
        << commas.errors;

    const Outcome refused = cortex(
        {"new-type", "Odd", "--extends", "RotaryAxisConcept", "LinearAxisConcept", "-o", "o.xml"},
        {}, folder.path());
    EXPECT_EQ(refused.exit, 1);
    EXPECT_NE(refused.errors.find("position"), std::string::npos) << refused.errors;
    EXPECT_EQ(filesIn(folder), 2U);
}

TEST(CortexNewType, NamesTheNearestOfAnUnknownParentAndRefusesATakenName) {
    const Outcome unknown = cortex({"new-type", "Pump", "--extends", "Devise"});
    EXPECT_EQ(unknown.exit, 3);
    EXPECT_NE(unknown.errors.find("Device"), std::string::npos) << unknown.errors;

    const Outcome taken = cortex({"new-type", "Arm", "--extends", "Device"});
    EXPECT_EQ(taken.exit, 1);
    EXPECT_NE(taken.errors.find("robotics.xml:"), std::string::npos) << taken.errors;
    EXPECT_EQ(cortex({"new-type", "Pump"}).exit, 2);
}

TEST(CortexNewType, RefusesHostileNames) {
    const ModelFolder folder;
    for (const std::string& name : hostileNames) {
        const Outcome outcome =
            cortex({"new-type", "--extends", "Device", "--json", "-o", ".", "--", name}, {},
                   folder.path());
        EXPECT_EQ(outcome.exit, 2) << name << outcome.output << outcome.errors;
    }
    EXPECT_EQ(filesIn(folder), 0U);
}

TEST(CortexNewSystem, MakesASystemThatIsValid) {
    const ModelFolder folder;

    const Outcome made = cortex({"new-system", "mixer", "-o", "mixer.xml"}, {}, folder.path());

    EXPECT_EQ(made.exit, 0) << made.errors;
    EXPECT_EQ(made.output, "wrote mixer.xml\n");
    EXPECT_EQ(validate({"mixer.xml"}, folder), "");
    EXPECT_EQ(xmllint("system", {"mixer.xml"}, folder), "");
    EXPECT_NE(folder.read("mixer.xml").find("<system name=\"mixer\">"), std::string::npos);
}

TEST(CortexNewSystem, PrintsTheSameWhereNoFileIsNamed) {
    const ModelFolder folder;

    const Outcome text = cortex({"new-system"}, {}, folder.path());
    const Outcome asJson = cortex({"new-system", "--json"}, {}, folder.path());

    EXPECT_EQ(violationsOf("new-files", asJson.output), "");
    EXPECT_EQ(json::parse(asJson.output)["files"][0]["text"], text.output);
    EXPECT_EQ(json::parse(asJson.output)["files"][0]["written"], false);
    EXPECT_EQ(filesIn(folder), 0U);
    folder.write("plant.xml", text.output);
    EXPECT_EQ(validate({"plant.xml"}, folder), "");
}

TEST(CortexNewSystem, RefusesHostileNames) {
    const ModelFolder folder;
    for (const std::string& name : hostileNames) {
        const Outcome outcome = cortex({"new-system", "-o", ".", "--", name}, {}, folder.path());
        EXPECT_EQ(outcome.exit, 2) << name << outcome.output << outcome.errors;
        EXPECT_EQ(outcome.errors.find('\x1b'), std::string::npos);
    }
    EXPECT_EQ(filesIn(folder), 0U);
}

TEST(CortexNewSystem, KeepsAFileThatExistsUnlessForced) {
    const ModelFolder folder;
    folder.write("s.xml", "precious");

    const Outcome refused = cortex({"new-system", "-o", "s.xml"}, {}, folder.path());
    EXPECT_EQ(refused.exit, 1);
    EXPECT_NE(refused.errors.find("--force"), std::string::npos) << refused.errors;
    EXPECT_EQ(folder.read("s.xml"), "precious");

    EXPECT_EQ(cortex({"new-system", "-o", "s.xml", "--force"}, {}, folder.path()).exit, 0);
    EXPECT_NE(folder.read("s.xml"), "precious");
}

TEST(CortexNewType, WritesNoneOfItsFilesIfOneExists) {
    const ModelFolder folder;
    folder.write("p-morphology.xml", "precious");

    const Outcome refused =
        cortex({"new-type", "Pump", "--extends", "Device", "-o", "p.xml"}, {}, folder.path());

    EXPECT_EQ(refused.exit, 1);
    EXPECT_EQ(filesIn(folder), 1U);
    EXPECT_EQ(folder.read("p-morphology.xml"), "precious");
}

TEST(CortexNewSystem, SaysWhatKeepsItFromWriting) {
    const ModelFolder folder;

    const Outcome absent = cortex({"new-system", "-o", "none/s.xml"}, {}, folder.path());
    EXPECT_EQ(absent.exit, 3);
    EXPECT_NE(absent.errors.find("mkdir -p none"), std::string::npos) << absent.errors;

    const Outcome full = cortex({"new-system", "-o", "/dev/full", "--force"}, {}, folder.path());
    EXPECT_EQ(full.exit, 1);
    EXPECT_NE(full.errors.find("/dev/full"), std::string::npos) << full.errors;
}

}  // namespace
}  // namespace cortex::test
