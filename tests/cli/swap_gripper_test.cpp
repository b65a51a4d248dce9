// SPDX-License-Identifier: Apache-2.0
// The plant examples/swap_gripper: three grippers behind the same commands.
#include "cli/controlled_agent.hpp"
#include "cli/live_agent.hpp"
#include "modbus/sim_process.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

const std::string folder = CORTEX_SOURCE_DIR "/examples/swap_gripper/";
constexpr double piece = 0.03, tolerance = 0.001;  // m

// A file of the plant: up to its gripper, the gripper, and from there on.
struct Parts {
    std::string before, gripper, after;
};

Parts partsOf(const std::string& name) {
    std::ifstream file{folder + name};
    const std::string all{std::istreambuf_iterator<char>{file}, {}};
    const std::size_t begin = all.find("  <!-- From here on: the gripper. -->");
    const std::size_t end = all.find("  <!-- Up to here: the gripper. -->");
    if (begin == std::string::npos || end == std::string::npos) return {};
    return {all.substr(0, begin), all.substr(begin, end - begin), all.substr(end)};
}

TEST(SwapGripper, TheSystemFilesDifferInTheGrippersPartAlone) {
    const Parts two = partsOf("two_finger.xml");
    for (const char* each : {"jaws.xml", "slide.xml"}) {
        const Parts other = partsOf(each);
        EXPECT_FALSE(other.gripper.empty()) << each;
        EXPECT_NE(other.gripper, two.gripper) << each;
        EXPECT_EQ(other.before, two.before) << each;
        EXPECT_EQ(other.after, two.after) << each;
    }
}

struct GripperOf {
    std::string file;
    double open;    // m
    bool hasPiece;  // something is between its jaws
    Words settings;
};

void PrintTo(const GripperOf& gripper, std::ostream* stream) { *stream << gripper.file; }

struct SwapGripper : testing::TestWithParam<GripperOf> {
    SwapGripper() { start(); }

    void start() {
        Words command = agentCommand(folder + GetParam().file) +
                        Words{"--startup", "--priority", "0", "--frequency", "200"} +
                        GetParam().settings;
        if (GetParam().file == "two_finger.xml") {
            if (!sim) {
                sim = std::make_unique<modbus::test::SimProcess>(
                    Words{"--object", "0.03", "--activation-time", "0.03"}, "cortex-gripper-sim");
            }
            command = command + Words{"--set", "/gripper/device.address=" + sim->address()};
        }
        agent = std::make_unique<Background>(command);
        EXPECT_TRUE(becomesTrue([] { return valueOf("/gripper/device", "state") == 2; }));
    }

    // Its demand begins at 0 with each start, and is led to the jaws before they obey.
    void staysWhereItIsWhenItsAgentStartsAnew() {
        EXPECT_TRUE(comesTo(0.06, {"moveTo", "width=0.06"}));
        agent.reset();
        start();
        EXPECT_TRUE(becomesTrue([] { return valueOf("/gripper/opening", "status") == 1; }));
        EXPECT_TRUE(isAt(0.06)) << valueOf("/gripper/opening", "position");
        EXPECT_TRUE(comesTo(0.05, {"moveTo", "width=0.05"}));
    }

    static json valueOf(const std::string& path, const std::string& item) {
        const json shown = json::parse(live({"show", path, "--json"}).output, nullptr, false);
        return shown.contains("data") ? shown["data"][item]["value"] : json{};
    }
    static bool call(const Words& words) {
        return live(Words{"call", "/gripper/control"} + words).exit == 0;
    }
    static bool isAt(double width) {
        const json value = valueOf("/gripper/opening", "position");
        return value.is_number() && std::abs(value.get<double>() - width) <= tolerance;
    }
    // Done, and the opening is there: again where the loop stood still on the way.
    static bool comesTo(double width, const Words& words) {
        return becomesTrue([&] { return call(words) && isAt(width); });
    }

    std::unique_ptr<modbus::test::SimProcess> sim;
    std::unique_ptr<Background> agent;
};

TEST_P(SwapGripper, ObeysTheSameCommandsAsTheOthers) {
    EXPECT_TRUE(comesTo(GetParam().open, {"open"}));
    EXPECT_TRUE(comesTo(0.035, {"moveTo", "width=0.035"}));
    if (GetParam().hasPiece) {
        EXPECT_TRUE(comesTo(piece, {"grip", "force=60"}));
        EXPECT_EQ(valueOf("/gripper/control", "object"), 2) << "StoppedClosing";
    } else {
        EXPECT_TRUE(becomesTrue([] { return !call({"grip"}) && isAt(0); }));
    }
    EXPECT_TRUE(comesTo(GetParam().open, {"open"}));
    if (sim) staysWhereItIsWhenItsAgentStartsAnew();
}

INSTANTIATE_TEST_SUITE_P(
    Grippers, SwapGripper,
    testing::Values(GripperOf{"two_finger.xml", 0.085, true, {}},
                    GripperOf{"jaws.xml", 0.04, false, {}},
                    GripperOf{"slide.xml",
                              0.1,
                              true,
                              {"--set", "/gripper/device.stops=0.03 0.1 0 0", "--set",
                               "/gripper/device.startPosition=0.1 0"}}),
    [](const auto& tested) { return tested.param.file.substr(0, tested.param.file.find('.')); });

}  // namespace
}  // namespace cortex::test
