// SPDX-License-Identifier: Apache-2.0
#include "cli/cortex_process.hpp"
#include "cli/json_schema.hpp"
#include "core/model_folder.hpp"
#include "support/share.hpp"

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;

const std::string robotics = "robotics-morphology.xml";  // found in $CORTEX_PATH

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(CortexTypes, PrintsTheTreeOfInheritance) {
    const Outcome outcome = cortex({"types", "--file", robotics});

    EXPECT_EQ(outcome.exit, 0) << outcome.errors;
    EXPECT_TRUE(contains(outcome.output, "\n  Concept (abstract")) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "\n      RotaryAxisConcept ")) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "\n        KukaLbrAxis1 ")) << outcome.output;
}

TEST(CortexTypes, PrintsATypeUnderEachOfItsParents) {
    const Outcome outcome = cortex({"types", "--file", robotics});

    EXPECT_TRUE(contains(outcome.output, "Robotiq2Finger (also OneDofManipulator)"))
        << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "Robotiq2Finger (also Gripper)")) << outcome.output;
}

TEST(CortexTypes, SaysWhichItemIsAboveWhich) {
    const ModelFolder folder;
    folder.write("t.xml",
                 "<ontology name=\"t\"><type name=\"A\">"
                 "<data name=\"loss\" kind=\"int\" constant=\"true\" default=\"2\" above=\"wait\"/>"
                 "<data name=\"wait\" kind=\"int\" constant=\"true\"/></type></ontology>");

    const Outcome text = cortex({"types", "A", "--file", "t.xml"}, {}, folder.path());
    const Outcome asJson = cortex({"types", "A", "--file", "t.xml", "--json"}, {}, folder.path());

    EXPECT_TRUE(contains(text.output, "above wait")) << text.output;
    EXPECT_EQ(violationsOf("type", asJson.output), "");
    EXPECT_EQ(json::parse(asJson.output)["data"][0]["above"], "wait") << asJson.output;
    EXPECT_EQ(json::parse(asJson.output)["data"][1]["above"], "") << asJson.output;
}

TEST(CortexTypes, ListsAllAsJsonOfTheCommittedSchema) {
    const Outcome outcome = cortex({"types", "--json", "--file", robotics});

    EXPECT_EQ(outcome.exit, 0);
    EXPECT_EQ(violationsOf("types", outcome.output), "");
    EXPECT_GT(json::parse(outcome.output)["types"].size(), 40U);
}

TEST(CortexTypes, PrintsEveryTypeAsJsonOfTheCommittedSchema) {
    const ModelFolder folder;
    const json list = json::parse(cortex({"types", "--json", "--file", robotics}).output)["types"];
    const std::size_t step = isWhole() ? 1 : 10;
    ASSERT_GT(list.size(), step);

    for (std::size_t i = 0; i < list.size(); i += step) {
        const json& each = list[i];
        const Outcome outcome =
            cortex({"types", each["name"].get<std::string>(), "--json", "--file", robotics});
        EXPECT_EQ(outcome.exit, 0);
        EXPECT_EQ(violationsOf("type", outcome.output), "") << each;
        EXPECT_EQ(json::parse(outcome.output)["hash"], each["hash"]);
    }
}

TEST(CortexTypes, PrintsEverythingAboutOne) {
    const ModelFolder folder;
    folder.write("t.xml", R"(<ontology name="t" version="1.0">
<type name="Base" abstract="true" role="active" description="A base.">
  <data name="mode" kind="int" min="0" max="1" default="1" labels="0:Off 1:On" settable="Standby"/>
  <command name="go" available="Standby Active" timeout="2.5">
    <request name="speed" kind="float" unit="m/s" min="0" max="0.5"/>
  </command>
</type>
<type name="Pump" extends="Base" version="3.1" transitionTimeout="4">
  <data name="level" kind="float" length="3" unit="m" min="-0.25" max="1e6" default="0 0 0.1" measured="true" description="How high."/>
</type>
</ontology>)");
    folder.write("r.xml", R"(<morphology name="t" version="1.0"><include file="t.xml"/>
<rules type="Pump"><relationship name="after" direction="input" target="Base" min="0" max="4"
  onLoss="safe" maxAge="0.2"/></rules></morphology>)");

    const Outcome outcome = cortex({"types", "Pump", "--file", "r.xml"}, {}, folder.path());

    EXPECT_EQ(outcome.exit, 0) << outcome.errors;
    for (const char* part : {"Pump\n",
                             "3.1",
                             "active",
                             "Base",
                             "t.xml:8",
                             "within 4 s",
                             "level",
                             "float[3]",
                             "m",
                             "-0.25 .. 1e+06",
                             "default 0 0 0.1",
                             "measured",
                             "How high.",
                             "mode",
                             "0:Off 1:On",
                             "settable: Standby",
                             "from Base",
                             "go",
                             "available: Standby Active",
                             "timeout 2.5 s",
                             "request speed float m/s 0 .. 0.5",
                             "after",
                             "0..4 Base",
                             "on loss safe",
                             "max age 0.2 s"}) {
        EXPECT_TRUE(contains(outcome.output, part)) << part << " in\n" << outcome.output;
    }
}

TEST(CortexTypes, NamesTheNearestOfAnUnknownType) {
    const Outcome outcome = cortex({"types", "KukaLrb", "--file", robotics});

    EXPECT_EQ(outcome.exit, 3);
    EXPECT_EQ(outcome.output, "");
    EXPECT_TRUE(contains(outcome.errors, "KukaLbr")) << outcome.errors;
}

TEST(CortexTypes, RefusesHostileNamesAsUnknown) {
    for (const char* name : {"", " ", "../x", "a b", "\x1b[31m", "A\"B"}) {
        const Outcome outcome = cortex({"types", name, "--json", "--file", robotics});
        EXPECT_EQ(outcome.exit, 3) << name;
        EXPECT_EQ(violationsOf("error", outcome.output), "") << name;
    }
}

TEST(CortexTypes, SaysThatANameAfterTheFilesIsTakenForAFile) {
    const Outcome outcome = cortex({"types", "--file", robotics, "KukaLbr"});

    EXPECT_EQ(outcome.exit, 3);
    EXPECT_TRUE(contains(outcome.errors, "cortex types KukaLbr --file " + robotics))
        << outcome.errors;
}

TEST(CortexTypes, SaysThatAnAgentIsActiveWithoutATaskOfItsOwn) {
    for (const char* name : {"Agent", "Cluster"}) {
        const Outcome outcome = cortex({"types", name, "--file", robotics});
        EXPECT_TRUE(contains(outcome.output, "active: has commands and state items"))
            << outcome.output;
        EXPECT_FALSE(contains(outcome.output, "has a task in every cycle")) << outcome.output;
        EXPECT_FALSE(contains(outcome.output, "transitions")) << outcome.output;
    }
}

TEST(CortexTypes, RefusesAModelWithErrorsAndSaysThem) {
    const ModelFolder folder;
    folder.write(
        "t.xml",
        "<ontology name=\"t\" version=\"1.0\"><type name=\"A\" extends=\"B\"/></ontology>");

    const Outcome text = cortex({"types", "--file", "t.xml"}, {}, folder.path());
    const Outcome asJson = cortex({"types", "--file", "t.xml", "--json"}, {}, folder.path());

    EXPECT_EQ(text.exit, 1);
    EXPECT_TRUE(contains(text.errors, "unknown-parent")) << text.errors;
    EXPECT_EQ(asJson.exit, 1);
    EXPECT_EQ(violationsOf("error", asJson.output), "");
    EXPECT_EQ(json::parse(asJson.output)["findings"].size(), 1U);
}

TEST(CortexTypes, EndsWith3ForAFileThatIsNotThere) {
    EXPECT_EQ(cortex({"types", "--file", "none.xml"}).exit, 3);
}

}  // namespace
}  // namespace cortex::test
