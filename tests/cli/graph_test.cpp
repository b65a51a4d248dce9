// SPDX-License-Identifier: Apache-2.0
#include "cli/cortex_process.hpp"
#include "cli/json_schema.hpp"
#include "core/model_folder.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;

const std::string example = CORTEX_SOURCE_DIR "/examples/lbr_teleop/lbr_teleop.xml";

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

TEST(CortexGraph, PutsEveryTaskAfterThoseThatItWaitsFor) {
    const json graph = json::parse(cortex({"graph", "--json", "--file", example}).output);

    std::map<std::string, int> levels;
    for (const json& each : graph["simplexes"]) {
        if (!each["level"].is_null()) levels[each["path"]] = each["level"];
    }
    EXPECT_EQ(levels.size(), 15U);  // all that is active but the agent itself
    EXPECT_FALSE(levels.contains("/teleop"));
    EXPECT_LT(levels.at("/control/forward"), levels.at("/control/clutch"));
    EXPECT_LT(levels.at("/control/clutch"), levels.at("/control/inverse"));
    EXPECT_LT(levels.at("/control/inverse"), levels.at("/control/follow"));
    EXPECT_LT(levels.at("/control/selector"), levels.at("/control/hold"));
    EXPECT_LT(levels.at("/control/follow"), levels.at("/drives/1"));
    EXPECT_LT(levels.at("/control/hold"), levels.at("/drives/1"));
    std::size_t listed = 0;
    for (const json& level : graph["levels"]) listed += level.size();
    EXPECT_EQ(listed, levels.size());
}

TEST(CortexGraph, PrintsJsonOfTheCommittedSchema) {
    const Outcome outcome = cortex({"graph", "--json", "--file", example});

    EXPECT_EQ(outcome.exit, 0);
    EXPECT_EQ(violationsOf("graph", outcome.output), "");
    const json graph = json::parse(outcome.output);
    const json delayed{{"owner", "/drives/1"},
                       {"rule", "observation"},
                       {"direction", "output"},
                       {"to", "/arm/lbr/axes/1"},
                       {"delayed", true}};
    EXPECT_EQ(std::ranges::count(graph["relationships"], delayed), 1);
}

TEST(CortexGraph, PrintsOrderAndRelationshipsAsText) {
    const Outcome outcome = cortex({"graph", "--file", example});

    EXPECT_EQ(outcome.exit, 0) << outcome.errors;
    EXPECT_EQ(outcome.output.find("system lbr_teleop: 48 simplexes, "), 0U) << outcome.output;
    for (const char* part :
         {"axes     <- /arm/lbr/axes/1..7\n", "observation  -> /arm/lbr/axes/1 (delayed)\n",
          "written by /control/follow, /control/hold\n", "/teleop"}) {
        EXPECT_EQ(count(outcome.output, part) > 0, true) << part << " in\n" << outcome.output;
    }
}

TEST(CortexGraph, PrintsANodeForEverySimplexAndAnEdgeForEveryRelationshipAsDot) {
    const json graph = json::parse(cortex({"graph", "--json", "--file", example}).output);

    const Outcome outcome = cortex({"graph", "--dot", "--file", example});

    EXPECT_EQ(outcome.exit, 0);
    EXPECT_NE(outcome.output.find("digraph \"lbr_teleop\" {"), std::string::npos);
    EXPECT_EQ(count(outcome.output, "[label=\"/"), graph["simplexes"].size());
    EXPECT_EQ(count(outcome.output, " -> \""), graph["relationships"].size());
    EXPECT_NE(outcome.output.find(
                  "\"/drives/1\" -> \"/arm/lbr/axes/1\" [label=\"observation\" style=dashed"),
              std::string::npos)
        << outcome.output;
    EXPECT_EQ(outcome.output.substr(outcome.output.size() - 2), "}\n");
}

TEST(CortexGraph, EscapesWhatDotWouldRead) {
    const ModelFolder folder;
    folder.write("s.xml", "<system name=\"a&quot;b\\n\"><ontology file=\"base.xml\"/></system>");

    const Outcome outcome = cortex({"graph", "--dot", "--file", "s.xml"}, {}, folder.path());

    EXPECT_EQ(outcome.exit, 0) << outcome.errors;
    EXPECT_NE(outcome.output.find("digraph \"a\\\"b\\\\n\" {"), std::string::npos)
        << outcome.output;
}

TEST(CortexGraph, RefusesALoopAndNamesIt) {
    const ModelFolder folder;
    folder.write("s.xml", R"(<system name="s"><morphology file="robotics-morphology.xml"/>
<simplex path="/a" type="FollowAxisController"><relate rule="axes" to="/x"/><relate rule="targets" to="/y"/>
<relate rule="demands" to="/x"/></simplex>
<simplex path="/x" type="RotaryAxisConcept"/><simplex path="/y" type="RotaryAxisConcept"/></system>)");

    const Outcome outcome = cortex({"graph", "--file", "s.xml"}, {}, folder.path());

    EXPECT_EQ(outcome.exit, 1);
    EXPECT_EQ(outcome.output, "");
    EXPECT_NE(outcome.errors.find("/a -> /x -> /a"), std::string::npos) << outcome.errors;
}

TEST(CortexGraph, AsksForASystem) {
    EXPECT_EQ(cortex({"graph", "--file", "base.xml"}).exit, 2);
    EXPECT_EQ(cortex({"graph", "--file", "none.xml"}).exit, 3);
    EXPECT_EQ(cortex({"graph", "--dot", "--json", "--file", example}).exit, 2);
}

TEST(CortexGraph, SaysThatAGraphIsOfOneSystem) {
    const ModelFolder folder;
    folder.write("one.xml", "<system name=\"one\"/>");
    folder.write("two.xml", "<system name=\"two\"/>");

    const Outcome outcome = cortex({"graph", "--file", "one.xml", "two.xml"}, {}, folder.path());

    EXPECT_EQ(outcome.exit, 2);
    EXPECT_EQ(outcome.errors,
              "cortex: a graph is of one system, these files have 2: give one of them\n");
}

}  // namespace
}  // namespace cortex::test
