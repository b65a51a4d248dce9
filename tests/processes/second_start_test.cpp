// SPDX-License-Identifier: Apache-2.0
// A second start of an agent's name ends or waits before any of its hooks runs.
#include "processes/agent_process.hpp"
#include "processes/station.hpp"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

namespace fs = std::filesystem;

class SecondStart : public testing::Test {
protected:
    SecondStart() {
        EXPECT_TRUE(station.waitFor([&] { return station.hears("plant"); })) << first.output();
    }
    ~SecondStart() override { unsetenv("ENDS_EARLY"); }

    // One whose first hooks would end it with exit code 3.
    std::unique_ptr<AgentProcess> startAgain(std::vector<std::string> options) const {
        setenv("ENDS_EARLY", "exit hook", 1);
        options.insert(options.end(), {"--plugin", plugin, "--startup"});
        return std::make_unique<AgentProcess>(other, file(other), options);
    }
    std::unique_ptr<AgentProcess> startWaiting() {
        auto agent = startAgain({"--wait"});
        EXPECT_TRUE(agent->prints(
            "another start of its name is there; this one waits until it has ended\n"));
        return agent;
    }
    static fs::path file(const ModelFolder& in) { return plantIn(in, "/stuck", "NeverReturns"); }
    static bool says(const AgentProcess& agent, const std::string& words) {
        return contains(agent.output(), words);
    }

    const std::string plugin = CORTEX_BINARY_DIR "/lib/plugins/ends-early.so";
    const ModelFolder folder, other;
    Station station;
    AgentProcess first{folder, file(folder), {"--plugin", plugin}};
};

TEST_F(SecondStart, EndsWithCodeFiveAndSaysHowToWait) {
    const auto second = startAgain({});

    EXPECT_EQ(second->waitForEnd(), 5);

    EXPECT_TRUE(says(*second,
                     "another start of plant is there; end that one, give one of them another name "
                     "(<cluster name=…>), or wait until it has ended (--wait)\n"))
        << second->output();
    EXPECT_TRUE(station.hears("plant"));
}

TEST_F(SecondStart, ThatWaitsRunsWhenTheFirstHasEnded) {
    const auto waiting = startWaiting();

    EXPECT_EQ(first.endInOrder(SIGINT), 0) << first.output();

    EXPECT_EQ(waiting->waitForEnd(), 3) << waiting->output();
    EXPECT_TRUE(says(*waiting, "in stateStandby of /stuck")) << waiting->output();
    EXPECT_FALSE(says(*waiting, "takes longer than a second")) << waiting->output();
}

TEST_F(SecondStart, ThatWaitsEndsByAnInterrupt) {
    const auto waiting = startWaiting();

    EXPECT_EQ(waiting->endInOrder(SIGINT), 5);

    EXPECT_TRUE(says(*waiting,
                     "another start of plant is there, and this one was stopped before it ended\n"))
        << waiting->output();
}

}  // namespace
}  // namespace cortex::test
