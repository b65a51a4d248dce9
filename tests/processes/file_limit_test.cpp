// SPDX-License-Identifier: Apache-2.0
// An agent whose files may not grow (RLIMIT_FSIZE, SIGXFSZ).
#include "cli/cortex_process.hpp"
#include "core/model_folder.hpp"

#include <string>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

TEST(AgentWithAFileLimit, GoesOnAndSaysWhatIsNotWritten) {
    const ModelFolder folder;
    const std::string agent =
        CORTEX_BINARY_DIR "/bin/cortex-agent " CORTEX_SOURCE_DIR
                          "/examples/jog_axis/jog_axis.xml --offline --startup --seconds 0.3 ";
    for (const auto& [option, told] : {std::pair{"--memory m", "is not written: m.new: "},
                                       std::pair{"--log l", "cannot write the log file l"}}) {
        const Outcome ended = runProgram(
            "bash",
            {"-c", "set -o pipefail; prlimit --fsize=100 " + agent + option + " 2>&1 | cat"}, {},
            folder.path().string());
        EXPECT_EQ(ended.exit, 0) << ended.output;
        EXPECT_TRUE(contains(ended.output, told)) << ended.output;
        EXPECT_TRUE(contains(ended.output, "cycles in")) << ended.output;
    }
}

}  // namespace
}  // namespace cortex::test
