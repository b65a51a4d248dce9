// SPDX-License-Identifier: Apache-2.0
// The two arms in a glove box as three processes: one hand that is killed stops its own arm alone.
#include "processes/station.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

enum SelectorReason : std::int64_t { handMoves = 1, inputIsLost = 4 };

class DualArmAgents : public testing::Test {
protected:
    // Presses, moves and releases every 2 s, so that nobody waits for the next press.
    static std::string swayingHand() {
        std::ostringstream text;
        text << "time,x,y,z,qx,qy,qz,qw,trigger\n";
        for (int i = 0; i <= 200; ++i) {
            const double turns = std::clamp((i - 30) / 140.0, 0.0, 1.0);
            const double way = 0.03 * (1 - std::cos(4 * std::numbers::pi * turns));
            text << i / 100.0 << ",0.5," << way << ",1,0,0,0,1," << (i >= 20 && i < 180) << '\n';
        }
        return text.str();
    }
    static std::string file(const std::string& name) {
        return CORTEX_SOURCE_DIR "/examples/lbr_dual_arm/" + name;
    }
    std::vector<std::string> handOptions(const std::string& side) const {
        return {"--startup", "--frequency", "200", "--set",
                "/hands/" + side + "/playback.file=" + path.string()};
    }
    bool follows(const std::string& side) {
        return station.waitFor([&] {
            return station.number("/" + side + "/selector", "reason") == handMoves &&
                   isActive("/" + side + "/follow");
        });
    }
    bool isActive(const std::string& simplex) const {
        return station.number(simplex, "state") == static_cast<std::int64_t>(State::Active);
    }
    std::vector<double> axes(const std::string& side) const {
        std::vector<double> positions;
        for (int i = 1; i <= 7; ++i)
            positions.push_back(
                station.real("/" + side + "/lbr/demands/" + std::to_string(i), "position"));
        return positions;
    }
    std::string outputs() const { return robot.output() + left.output() + right.output(); }

    ModelFolder folder;
    const std::filesystem::path path = folder.write("path.csv", swayingHand());
    AgentProcess robot{folder, file("robot.xml"), {"--startup", "--frequency", "200"}};
    AgentProcess left{folder, file("left_operator.xml"), handOptions("left")};
    AgentProcess right{folder, file("right_operator.xml"), handOptions("right")};
    Station station;
};

TEST_F(DualArmAgents, TheArmOfAKilledHandHoldsWhileTheOtherGoesOn) {
    ASSERT_TRUE(follows("left")) << outputs();
    ASSERT_TRUE(follows("right")) << outputs();

    left.kill9();

    ASSERT_TRUE(station.waitFor([&] {
        return station.number("/left/selector", "reason") == inputIsLost && isActive("/left/hold");
    })) << outputs();
    const std::vector<double> held = axes("left");
    const std::int64_t presses = *station.number("/right/clutch", "engageCount");
    ASSERT_TRUE(station.waitFor([&] {
        return *station.number("/right/clutch", "engageCount") > presses;
    })) << outputs();
    EXPECT_TRUE(follows("right")) << outputs();
    EXPECT_EQ(axes("left"), held);
    EXPECT_TRUE(isActive("/cell/world"));

    left.start();

    EXPECT_TRUE(follows("left")) << outputs();
}

}  // namespace
}  // namespace cortex::test
