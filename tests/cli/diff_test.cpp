// SPDX-License-Identifier: Apache-2.0
#include "cli/cortex_process.hpp"
#include "cli/json_schema.hpp"
#include "core/model_folder.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;

// The example of the paper: an axis, and what another agent makes of it.
std::string axis(const std::string& max, const std::string& unit, const std::string& more = "") {
    return "<ontology name=\"t\" version=\"1.0\">\n<type name=\"Axis\">\n"
           "<data name=\"position\" kind=\"float\" unit=\"" +
           unit + "\" min=\"-3\" max=\"" + max + "\"/>\n</type>\n" + more + "</ontology>\n";
}
const std::string extended =
    "<type name=\"AxisWithTorque\" extends=\"Axis\"><data name=\"torque\" kind=\"float\" "
    "unit=\"N.m\"/></type>\n";

struct Files {
    Files() {
        folder.write("axis.xml", axis("3", "rad"));
        folder.write("extended.xml", axis("3", "rad", extended));
        folder.write("corrected.xml", axis("2.5", "rad"));
        folder.write("contradicting.xml", axis("3", "m"));
    }
    Outcome diff(const std::string& theirs, std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"diff", "axis.xml", theirs});
        return cortex(more, {}, folder.path());
    }
    ModelFolder folder;
};

TEST(CortexDiff, FindsNothingBetweenAModelAndItself) {
    const Outcome outcome = Files{}.diff("axis.xml");

    EXPECT_EQ(outcome.exit, 0) << outcome.errors;
    EXPECT_EQ(outcome.output, "no disagreement in 1 common type\n");
}

TEST(CortexDiff, ListsATypeThatOnlyOneModelHasAsNoDisagreement) {
    const Outcome outcome = Files{}.diff("extended.xml");

    EXPECT_EQ(outcome.exit, 0);
    EXPECT_NE(outcome.output.find("only in extended.xml: AxisWithTorque\n"), std::string::npos)
        << outcome.output;
}

TEST(CortexDiff, CallsACorrectedLimitADifference) {
    const Outcome outcome = Files{}.diff("corrected.xml");

    EXPECT_EQ(outcome.exit, 1);
    EXPECT_EQ(outcome.output.find("Axis position: difference, "), 0U) << outcome.output;
    EXPECT_NE(outcome.output.find("0 contradictions, 1 difference in 1 common type"),
              std::string::npos)
        << outcome.output;
}

TEST(CortexDiff, CallsAnotherUnitAContradictionAndNamesTheItem) {
    const Outcome outcome = Files{}.diff("contradicting.xml");

    EXPECT_EQ(outcome.exit, 1);
    EXPECT_EQ(outcome.output.find("Axis position: contradiction, "), 0U) << outcome.output;
}

TEST(CortexDiff, PrintsJsonOfTheCommittedSchema) {
    const Files files;
    for (const char* theirs : {"axis.xml", "extended.xml", "corrected.xml", "contradicting.xml"}) {
        const Outcome outcome = files.diff(theirs, {"--json"});
        EXPECT_EQ(violationsOf("diff", outcome.output), "") << theirs;
    }
    const json contradicting = json::parse(files.diff("contradicting.xml", {"--json"}).output);
    EXPECT_EQ(contradicting["disagreements"][0]["type"], "Axis");
    EXPECT_EQ(contradicting["disagreements"][0]["contradiction"], true);
    EXPECT_EQ(json::parse(files.diff("extended.xml", {"--json"}).output)["only_theirs"],
              json::array({"AxisWithTorque"}));
}

TEST(CortexDiff, NeedsTwoModels) {
    const Files files;

    EXPECT_EQ(cortex({"diff", "axis.xml"}, {}, files.folder.path()).exit, 2);
    EXPECT_EQ(files.diff("none.xml").exit, 3);
    EXPECT_EQ(violationsOf("error", files.diff("none.xml", {"--json"}).output), "");
}

TEST(CortexDiff, SaysOnceOfEachFileThatItIsNotThere) {
    const auto lines = [](const Outcome& outcome) {
        return std::ranges::count(outcome.errors, '\n');
    };
    const Outcome one = Files{}.diff("none.xml");
    const Outcome both = cortex({"diff", "no.xml", "none.xml"});
    const Outcome same = cortex({"diff", "none.xml", "none.xml"});

    for (const Outcome* each : {&one, &both, &same}) EXPECT_EQ(each->exit, 3);
    EXPECT_EQ(one.errors.find("error: there is no file 'none.xml'"), 0U) << one.errors;
    EXPECT_EQ(lines(one), 1) << one.errors;
    EXPECT_NE(both.errors.find("'no.xml'"), std::string::npos) << both.errors;
    EXPECT_NE(both.errors.find("'none.xml'"), std::string::npos) << both.errors;
    EXPECT_EQ(lines(both), 2) << both.errors;
    EXPECT_EQ(lines(same), 1) << same.errors;
}

}  // namespace
}  // namespace cortex::test
