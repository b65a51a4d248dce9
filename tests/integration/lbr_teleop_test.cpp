// SPDX-License-Identifier: Apache-2.0
#include "teleop.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

constexpr double endOfPath = 23.9;  // s

double farthest(const Axes& from, const Axes& to) {
    double distance = 0;
    for (std::size_t i = 0; i < lbrAxes; ++i) {
        distance = std::max(distance, std::abs(to[i] - from[i]));
    }
    return distance;
}

TEST(LbrTeleop, HasTheSizeOfTheCaseStudy) {
    Teleop teleop;

    EXPECT_GE(teleop.tree.simplexes().size(), 44U);
    EXPECT_LE(teleop.tree.simplexes().size(), 50U);
}

TEST(LbrTeleop, TipFollowsTheHand) {
    Teleop teleop;
    teleop.startUp();

    const Tracking tracking = track(teleop, endOfPath);

    EXPECT_LT(tracking.rmsPosition, 2);
    EXPECT_LT(tracking.rmsRotation, 1);
    EXPECT_GE(tracking.rmsSpeed, 0.15);
    EXPECT_GT(tracking.seconds, 10);
}

TEST(LbrTeleop, MonitorSaysWhatIsMeasuredFromOutside) {
    Teleop teleop;
    teleop.startUp();

    const Tracking tracking = track(teleop, 9);
    const Image image = teleop.image();

    EXPECT_NEAR(image.get<double>("/tracking", "rmsPosition"), tracking.rmsPosition, 0.01);
    EXPECT_NEAR(image.get<double>("/tracking", "rmsRotation"), tracking.rmsRotation, 0.001);
    EXPECT_NEAR(image.get<double>("/tracking", "rmsSpeed"), tracking.rmsSpeed, 0.01);
    EXPECT_NEAR(image.get<double>("/tracking", "time"), tracking.seconds, 0.005);
    EXPECT_EQ(image.get<std::int64_t>("/tracking", "pressCount"), 1);
}

TEST(LbrTeleop, ArmStaysWhileTheHandMovesReleased) {
    Teleop teleop;
    teleop.startUp();
    teleop.runUntil(7.6);  // released at 7.2, the hand goes on from 7.3 to 9.0
    ASSERT_FALSE(pressed(teleop.image()));
    const Axes before = positionsOf(teleop.image(), "axes");
    const mechanics::Pose hand = handOf(teleop.image());

    teleop.runUntil(8.9);

    EXPECT_GT((handOf(teleop.image()).position - hand.position).norm(), 0.1);
    EXPECT_LT(farthest(before, positionsOf(teleop.image(), "axes")), 1e-6);
    EXPECT_EQ(stateOf(teleop.image(), "/control/hold"), State::Active);
    EXPECT_EQ(stateOf(teleop.image(), "/control/follow"), State::Standby);
}

TEST(LbrTeleop, HoldsWhileTheHandStandsStillWithTheButtonPressed) {
    Teleop teleop;
    teleop.startUp();
    teleop.runUntil(11.6);  // the hand stands from 11.2 to 12.7
    ASSERT_TRUE(pressed(teleop.image()));
    const Axes before = positionsOf(teleop.image(), "axes");

    EXPECT_EQ(stateOf(teleop.image(), "/control/hold"), State::Active);
    teleop.runUntil(12.6);

    EXPECT_TRUE(pressed(teleop.image()));
    EXPECT_LT(farthest(before, positionsOf(teleop.image(), "axes")), 1e-5);
    teleop.runUntil(13.5);
    EXPECT_EQ(stateOf(teleop.image(), "/control/follow"), State::Active);
    EXPECT_GT(farthest(before, positionsOf(teleop.image(), "axes")), 0.05);
}

TEST(LbrTeleop, ReleasedWhileMovingItComesToRest) {
    Teleop teleop;
    teleop.startUp();
    teleop.runUntil(14.59);  // released at 14.6, in motion
    const Axes before = positionsOf(teleop.image(), "axes");
    teleop.runUntil(15.2);
    const Axes after = positionsOf(teleop.image(), "axes");
    teleop.runUntil(15.4);

    EXPECT_LT(farthest(before, after), 0.1);
    EXPECT_LT(farthest(after, positionsOf(teleop.image(), "axes")), 1e-4);
}

TEST(LbrTeleop, DoesNotRushAfterTheHandWhenItsDrivesStartAgain) {
    Teleop teleop;
    teleop.startUp();
    teleop.runUntil(4);
    EXPECT_TRUE(teleop.call("/teleop", "shutdown", "/drives").done());
    const Axes braked = positionsOf(teleop.image(), "axes");
    teleop.runUntil(5);

    EXPECT_TRUE(teleop.call("/teleop", "startup", "/drives").done());
    teleop.runUntil(7);

    EXPECT_TRUE(pressed(teleop.image()));
    EXPECT_LT(farthest(braked, positionsOf(teleop.image(), "axes")), 0.05);
    EXPECT_EQ(teleop.image().get<std::int64_t>("/control/clutch", "letGoCount"), 1);
    teleop.runUntil(10.2);  // pressed anew
    EXPECT_GT(farthest(braked, positionsOf(teleop.image(), "axes")), 0.05);
}

// --- The example's test has to fail when something is wrong ------------------------------------

class FlippedJoint : public testing::TestWithParam<int> {};

TEST_P(FlippedJoint, BreaksThePromise) {
    Teleop::Set set;
    set.change = [](SimplexTree& tree) {
        Simplex& axis = tree.at("/arm/lbr/axes/" + std::to_string(GetParam()));
        auto direction = std::get<std::vector<double>>(axis.type().findData("direction")->initial);
        for (double& element : direction) element = -element;
        axis.set("direction", Value{direction});
    };
    Teleop teleop{set};
    teleop.startUp();

    const Tracking tracking = track(teleop, endOfPath);

    EXPECT_GT(tracking.seconds, 5);
    EXPECT_FALSE(tracking.keepsPromise());
}

INSTANTIATE_TEST_SUITE_P(LbrTeleop, FlippedJoint, testing::Range(1, 8));

TEST(LbrTeleop, FollowReplacedByHoldBreaksThePromise) {
    Teleop::Set set;
    set.ontology =
        "<type name=\"HoldInstead\" extends=\"FollowAxisController\" description=\"Holds.\"/>";
    set.replacements = {{"type=\"FollowAxisController\"", "type=\"HoldInstead\""}};
    set.classes = [](ClassRegistry& registry) {
        registry.addFactory("HoldInstead", *registry.find("HoldAxisController"));
    };
    Teleop teleop{set};
    teleop.startUp();

    const Tracking tracking = track(teleop, endOfPath);

    EXPECT_GT(tracking.seconds, 5);
    EXPECT_FALSE(tracking.keepsPromise());
}

TEST(LbrTeleop, IsTheSameOnEveryRun) {
    const auto run = [] {
        Teleop teleop;
        teleop.startUp();
        teleop.runUntil(4);
        return positionsOf(teleop.image(), "axes");
    };

    EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace cortex::test
