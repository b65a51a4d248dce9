// SPDX-License-Identifier: Apache-2.0
// The agent program from outside: exit codes and what it prints.
#include "cli/cortex_process.hpp"
#include "teleop.hpp"

#include <fstream>
#include <regex>

#include <sys/stat.h>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

struct Ended {
    int exitCode;
    std::string output;
};

Ended agent(const std::string& arguments) {
    const Outcome outcome = runProgram(
        "sh",
        {"-c", "exec " CORTEX_BINARY_DIR "/bin/cortex-agent --offline " + arguments + " 2>&1"});
    return {outcome.exit, outcome.output};
}

// The same with --startup, which ends right after that.
Ended startedAgent(const TeleopFile& file, const std::string& arguments) {
    return agent(file.path().string() + " --startup --seconds 0.001 " + arguments);
}

bool says(const Ended& ended, const std::string& text) {
    return ended.output.find(text) != std::string::npos;
}

TEST(CortexAgent, RunsTheCaseStudyAndPrintsMetricsAndMonitors) {
    const TeleopFile file;

    const Ended ended = startedAgent(file, "--priority 0");

    EXPECT_EQ(ended.exitCode, 0) << ended.output;
    EXPECT_TRUE(says(ended, "all active simplexes are started")) << ended.output;
    EXPECT_FALSE(says(ended, "not started")) << ended.output;
    EXPECT_TRUE(says(ended, "duty cycle")) << ended.output;
    EXPECT_TRUE(says(ended, "/tracking (TrackingMonitor)")) << ended.output;
    EXPECT_LT(ended.output.rfind("ShuttingDown -> Standby"), ended.output.find("cycle duration"))
        << "what the stop executes counts: " << ended.output;
}

// Each level of the start-up takes a cycle at least.
TEST(CortexAgent, CountsItsSecondsFromTheEndOfTheStartUp) {
    const TeleopFile file;

    const Ended ended = startedAgent(file, "--priority 0 --frequency 30");

    EXPECT_EQ(ended.exitCode, 0) << ended.output;
    EXPECT_TRUE(says(ended, "all active simplexes are started")) << ended.output;
    EXPECT_TRUE(says(ended, "ShuttingDown -> Standby")) << ended.output;
}

TEST(CortexAgent, NamesWhatItsStartupWaitsForAtOnceAndAtTheEndAndEndsWithFour) {
    const std::string robot = CORTEX_SOURCE_DIR "/examples/lbr_teleop/robot.xml";

    const Ended ended =
        agent(robot + " --priority 0 --startup --seconds 0.001 --frequency 100 --log /dev/null");

    EXPECT_EQ(ended.exitCode, 4) << ended.output;
    const std::string waits =
        "startup: /control/clutch waits for /handset/pose of another agent, which is not there";
    const std::size_t first = ended.output.find(waits);
    EXPECT_LT(first, ended.output.find("cycle duration")) << ended.output;
    EXPECT_NE(ended.output.find(waits, first + 1), std::string::npos) << ended.output;
    EXPECT_TRUE(says(ended, "did not follow: startup needs enable")) << ended.output;
    EXPECT_TRUE(says(ended, "more, as events say")) << ended.output;
}

TEST(CortexAgent, SaysThatNobodyAskedForAStartUp) {
    const TeleopFile file;

    const Ended ended = agent(file.path().string() + " --priority 0 --frequency 50 --seconds 0.2");

    EXPECT_EQ(ended.exitCode, 0) << ended.output;
    const std::string told =
        "are in Standby, and nobody asked for a start-up: start this agent "
        "with --startup\n";
    EXPECT_TRUE(says(ended, told)) << ended.output;
    EXPECT_EQ(ended.output.find(told), ended.output.rfind(told)) << ended.output;
}

TEST(CortexAgent, NamesWhoDidNotGetThroughTheShutdownInTimeAndEndsWithFour) {
    const TeleopFile file{{{"<cluster ", "<cluster stopTimeout=\"0.001\" "}}};

    const Ended ended = startedAgent(file, "--priority 0 --frequency 200");

    EXPECT_EQ(ended.exitCode, 4) << ended.output;
    EXPECT_TRUE(says(ended,
                     "shutdown: /drives/1 did not follow: Active after the stopTimeout of "
                     "0.001 s; now in Standby by force"))
        << ended.output;
}

TEST(CortexAgent, EndsWithThreeWhereACycleBeganLaterThanTheFileAllows) {
    const TeleopFile file{{{"<cluster ", "<cluster warnLateness=\"0\" haltLateness=\"0.001\" "}}};

    const Ended ended =
        agent(file.path().string() + " --priority 0 --startup --seconds 0.2 --frequency 200");

    EXPECT_EQ(ended.exitCode, 3) << ended.output;
    EXPECT_TRUE(says(ended, "more than the haltLateness of 0.001 % allows")) << ended.output;
    EXPECT_FALSE(says(ended, "warnLateness")) << ended.output;
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
    const TeleopFile file{{{"</system>", "<simplex path=\"/own\" type=\"Own\"/></system>"}},
                          "<type name=\"Own\" extends=\"Active\"/>"};

    const Ended ended = agent(file.path().string() + " --seconds 0.1");

    EXPECT_EQ(ended.exitCode, 1) << ended.output;
    EXPECT_TRUE(says(ended, "/own: no C++ class implements")) << ended.output;
    EXPECT_TRUE(says(ended, "--plugin")) << ended.output;
}

TEST(CortexAgent, RunsTheClassOfTheNearestAncestorAndSaysSo) {
    const TeleopFile file{{{"type=\"FollowAxisController\"", "type=\"MyFollow\""}},
                          "<type name=\"MyFollow\" extends=\"FollowAxisController\"/>"};

    const Ended ended = agent(file.path().string() + " --seconds 0.1");

    EXPECT_EQ(ended.exitCode, 0) << ended.output;
    EXPECT_TRUE(
        says(ended, "MyFollow has no class of its own and runs that of FollowAxisController"))
        << ended.output;
}

TEST(CortexAgent, EndsWithTwoForWrongUsage) {
    const TeleopFile file;
    const std::string system = file.path().string();

    EXPECT_EQ(agent("").exitCode, 2);
    EXPECT_EQ(agent(system + " --frequency fast").exitCode, 2);
    EXPECT_EQ(agent(system + " --threads 0").exitCode, 2);
    EXPECT_TRUE(says(agent(system + " --seconds nan"), "'nan' is no number"));
    EXPECT_EQ(agent(system + " --what").exitCode, 2);
    EXPECT_EQ(agent(system + " --set /drives/1.naturalFrequency").exitCode, 2);
    EXPECT_EQ(agent(system + " --set /drives/1.naturalFrequency=soft").exitCode, 2);
    const Ended ended = agent(system + " --set /drives/1.naturalFrequenzy=10");
    EXPECT_EQ(ended.exitCode, 2);
    EXPECT_TRUE(says(ended, "naturalFrequency")) << ended.output;
    EXPECT_EQ(agent(system + " --set /drive/1.naturalFrequency=10").exitCode, 2);
    EXPECT_EQ(agent("--help").exitCode, 0);
}

TEST(CortexAgent, SaysThatAnAgentRunsOneFileAndNumbersHaveNoUnit) {
    EXPECT_TRUE(says(agent("plant.xml control.xml"),
                     "'control.xml' was not expected: one agent runs one system file; start "
                     "another cortex-agent for it"));
    EXPECT_TRUE(
        says(agent("plant.xml --frequency 1kHz"), "'1kHz' is no number; write it without a unit"));
}

TEST(CortexAgent, SaysHowManyValuesASettingNeeds) {
    const TeleopFile file;
    const std::string system = file.path().string();

    const Ended two = agent(system + " --set '/drives/1.naturalFrequency=1 2'");
    EXPECT_EQ(two.exitCode, 2);
    EXPECT_TRUE(says(two,
                     "expected 1 value, found 2; naturalFrequency has kind=\"float\" length=\"1\" "
                     "unit=\"Hz\""))
        << two.output;
    const Ended array = agent(system + " --set /handset/pose.position=1");
    EXPECT_EQ(array.exitCode, 2);
    EXPECT_TRUE(says(array, "expected 3 values, found 1; position has kind=\"float\" length=\"3\""))
        << array.output;
}

TEST(CortexAgent, NamesTheNearestOptionAndTheOneOfAFile) {
    EXPECT_TRUE(says(agent("s.xml --pluign=a.so"), "'--pluign'; nearest of: --plugin"));
    EXPECT_TRUE(says(agent("--secnods 1"), "'--secnods'; nearest of: --seconds"));
    EXPECT_TRUE(says(agent("s.xml --plugin a.so b.so"), "did you mean --plugin b.so?"));
    const Ended help = agent("--help");
    EXPECT_TRUE(says(help, "--plugin FILE ...")) << help.output;
    EXPECT_TRUE(says(help, "--set PATH.ITEM=VALUE ...")) << help.output;
}

// Percentiles are first computed after some 50 cycles, which this run does not have.
TEST(CortexAgent, PrintsADashForWhatItHasNotComputed) {
    const TeleopFile file;

    const Ended ended = agent(file.path().string() + " --priority 0 --frequency 20 --seconds 0.1");

    EXPECT_EQ(ended.exitCode, 0) << ended.output;
    const std::regex duty{"duty cycle +% +[-.0-9]+ +[-.0-9]+ +- +- +- +[-.0-9]+\n"};
    const std::regex latency{"command latency us +- +- +- +- +- +-\n"};
    EXPECT_TRUE(std::regex_search(ended.output, duty)) << ended.output;
    EXPECT_TRUE(std::regex_search(ended.output, latency)) << ended.output;
}

TEST(CortexAgent, SpinsForPartOfEachPeriod) {
    const TeleopFile file;

    const Ended ended = agent(file.path().string() + " --priority 0 --spin 100 --seconds 0.1");

    EXPECT_EQ(ended.exitCode, 0) << ended.output;
    std::string isolated;
    std::ifstream{"/sys/devices/system/cpu/isolated"} >> isolated;
    if (isolated.empty()) {
        EXPECT_TRUE(says(ended, "real time: The clock spins for 10 % of each period"))
            << ended.output;
    }
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

TEST(CortexAgent, WritesNoEventsToAPipe) {
    const TeleopFile file;
    const std::filesystem::path pipe = file.path().parent_path() / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);

    const Ended ended = agent(file.path().string() + " --seconds 0.1 --log " + pipe.string());

    EXPECT_EQ(ended.exitCode, 1) << ended.output;
    EXPECT_TRUE(says(ended, " is a pipe, whose reader could hold up all events")) << ended.output;
}

TEST(CortexAgent, WritesEventsToTheLogFile) {
    const TeleopFile file;
    const std::filesystem::path log = file.path().parent_path() / "events.log";

    const Ended ended = startedAgent(file, "--priority 0 --log " + log.string());

    EXPECT_EQ(ended.exitCode, 0) << ended.output;
    EXPECT_FALSE(says(ended, "StartingUp")) << ended.output;
    std::ifstream in{log};
    const std::string text{std::istreambuf_iterator<char>{in}, {}};
    EXPECT_NE(text.find("/control/forward"), std::string::npos) << text;
    EXPECT_NE(text.find("StartingUp -> Active"), std::string::npos) << text;
}

}  // namespace
}  // namespace cortex::test
