// SPDX-License-Identifier: Apache-2.0
// The agent program from outside: exit codes and what it prints.
#include "teleop.hpp"

#include <cstdio>
#include <fstream>

#include <sys/wait.h>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

struct Ended {
    int exitCode;
    std::string output;
};

Ended agent(const std::string& arguments) {
    const std::string command = std::string{CORTEX_BINARY_DIR} + "/bin/cortex-agent --offline " +
                                arguments + " 2>&1 < /dev/null";
    Ended ended{-1, ""};
    FILE* pipe = popen(command.c_str(), "r");  // NOLINT: a test runs a program
    if (pipe == nullptr) return ended;
    std::array<char, 4096> text{};
    while (fgets(text.data(), text.size(), pipe) != nullptr) ended.output += text.data();
    const int status = pclose(pipe);
    ended.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return ended;
}

bool says(const Ended& ended, const std::string& text) {
    return ended.output.find(text) != std::string::npos;
}

TEST(CortexAgent, RunsTheCaseStudyAndPrintsMetricsAndMonitors) {
    const TeleopFile file;

    const Ended ended = agent(file.path().string() + " --priority 0 --startup --seconds 0.5");

    EXPECT_EQ(ended.exitCode, 0) << ended.output;
    EXPECT_TRUE(says(ended, "all active simplexes are started")) << ended.output;
    EXPECT_TRUE(says(ended, "duty cycle")) << ended.output;
    EXPECT_TRUE(says(ended, "/tracking (TrackingMonitor)")) << ended.output;
}

TEST(CortexAgent, RefusesAnArmWithoutGripperWithRulePlaceAndRemedy) {
    const TeleopFile file{{{"<relate rule=\"gripper\" to=\"/arm/gripper\"/>", ""}}};

    const Ended ended = agent(file.path().string() + " --seconds 0.1");

    EXPECT_EQ(ended.exitCode, 1) << ended.output;
    EXPECT_TRUE(says(ended, "/arm: ")) << ended.output;
    EXPECT_TRUE(says(ended, "'gripper'")) << ended.output;
    EXPECT_TRUE(says(ended, "robotics-morphology.xml:")) << ended.output;
    EXPECT_TRUE(says(ended, "relate ")) << ended.output;
}

TEST(CortexAgent, RefusesASystemWhoseClassesAreMissing) {
    const TeleopFile file{{{"type=\"FollowAxisController\"", "type=\"MyFollow\""}},
                          "<type name=\"MyFollow\" extends=\"FollowAxisController\"/>"};

    const Ended ended = agent(file.path().string() + " --seconds 0.1");

    EXPECT_EQ(ended.exitCode, 1) << ended.output;
    EXPECT_TRUE(says(ended, "/control/follow")) << ended.output;
    EXPECT_TRUE(says(ended, "--plugin")) << ended.output;
}

TEST(CortexAgent, EndsWithTwoForWrongUsage) {
    const TeleopFile file;
    const std::string system = file.path().string();

    EXPECT_EQ(agent("").exitCode, 2);
    EXPECT_EQ(agent(system + " --frequency fast").exitCode, 2);
    EXPECT_EQ(agent(system + " --threads 0").exitCode, 2);
    EXPECT_EQ(agent(system + " --what").exitCode, 2);
    EXPECT_EQ(agent(system + " --set /drives/1.naturalFrequency").exitCode, 2);
    EXPECT_EQ(agent(system + " --set /drives/1.naturalFrequency=soft").exitCode, 2);
    const Ended ended = agent(system + " --set /drives/1.naturalFrequenzy=10");
    EXPECT_EQ(ended.exitCode, 2);
    EXPECT_TRUE(says(ended, "naturalFrequency")) << ended.output;
    EXPECT_EQ(agent(system + " --set /drive/1.naturalFrequency=10").exitCode, 2);
    EXPECT_EQ(agent("--help").exitCode, 0);
}

TEST(CortexAgent, RefusesASettingOutOfItsRange) {
    const TeleopFile file;

    const Ended ended =
        agent(file.path().string() + " --set /drives/1.naturalFrequency=1000 --seconds 0.1");

    EXPECT_EQ(ended.exitCode, 1) << ended.output;
    EXPECT_TRUE(says(ended, "/drives/1")) << ended.output;
}

TEST(CortexAgent, OptionsOutrankTheFile) {
    const TeleopFile file;

    const Ended ended = agent(file.path().string() + " --priority 0 --frequency 200 --seconds 0.3");

    EXPECT_EQ(ended.exitCode, 0) << ended.output;
    EXPECT_TRUE(says(ended, "at 200 Hz")) << ended.output;
}

TEST(CortexAgent, WritesEventsToTheLogFile) {
    const TeleopFile file;
    const std::filesystem::path log = file.path().parent_path() / "events.log";

    const Ended ended =
        agent(file.path().string() + " --priority 0 --startup --seconds 0.3 --log " + log.string());

    EXPECT_EQ(ended.exitCode, 0) << ended.output;
    EXPECT_FALSE(says(ended, "StartingUp")) << ended.output;
    std::ifstream in{log};
    const std::string text{std::istreambuf_iterator<char>{in}, {}};
    EXPECT_NE(text.find("/control/forward"), std::string::npos) << text;
    EXPECT_NE(text.find("StartingUp -> Active"), std::string::npos) << text;
}

}  // namespace
}  // namespace cortex::test
