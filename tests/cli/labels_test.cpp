// SPDX-License-Identifier: Apache-2.0
// Labels of enumerations where people write values.
#include "cli/cortex_process.hpp"
#include "core/model_folder.hpp"

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

struct CortexLabels : testing::Test {
    // A system whose handset has this source.
    std::string systemWith(const std::string& source) const {
        return folder
            .write("labels.xml",
                   "<system name=\"labels\"><morphology file=\"robotics-morphology.xml\"/>"
                   "<cluster name=\"labels\"/><simplex path=\"/hand\" type=\"HandsetPlayback\">" +
                       set("source", source) + "</simplex></system>")
            .string();
    }

    const ModelFolder folder;
};

TEST_F(CortexLabels, MayStandForTheirNumbersInASystemFile) {
    const Outcome labelled = cortex({"validate", systemWith("Keyboard")});
    EXPECT_FALSE(contains(labelled.output, "setting-kind")) << labelled.output;

    const Outcome wrong = cortex({"validate", systemWith("Keybord")});
    EXPECT_TRUE(contains(wrong.output, "setting-kind")) << wrong.output;
    EXPECT_TRUE(contains(wrong.output, "labels: 0:File 1:Keyboard")) << wrong.output;
    EXPECT_TRUE(contains(wrong.output, "write <set data=\"source\" value=\"Keyboard\"/>"))
        << "the nearest, not the first: " << wrong.output;
    EXPECT_TRUE(
        contains(cortex({"validate", systemWith("Radio")}).output, "; write one of the labels"));
}

TEST_F(CortexLabels, MayStandForTheirNumbersWhereAnAgentIsStarted) {
    const std::string agent = CORTEX_BINARY_DIR "/bin/cortex-agent";
    const auto started = [&](const std::string& source) {
        return runProgram(
            agent,
            {systemWith("0"), "--offline", "--seconds", "0.01", "--set", "/hand.source=" + source},
            {{"CORTEX_PATH", CORTEX_SOURCE_DIR "/ontology"}});
    };

    EXPECT_FALSE(contains(started("Keyboard").errors, "--set")) << started("Keyboard").errors;
    EXPECT_TRUE(
        contains(started("Keybord").errors, "nearest of: Keyboard; labels: 0:File 1:Keyboard"));
}

}  // namespace
}  // namespace cortex::test
