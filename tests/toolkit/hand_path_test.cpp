// SPDX-License-Identifier: Apache-2.0
// The example's synthetic hand path: what it must contain, and that the LBR can follow it.
#include "cortex/toolkit/recorded_path.hpp"

#include "mechanics/lbr_chain.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit {
namespace {

using mechanics::Pose;
using mechanics::SerialChain;

constexpr double period = 0.001;

const RecordedPath& hand() {
    static const RecordedPath Path = RecordedPath::load(
        std::string(CORTEX_SOURCE_DIR) + "/examples/lbr_teleop/synthetic_hand_path.csv",
        PathEnd::Loop);
    return Path;
}

int ticks() { return static_cast<int>(std::lround(hand().duration() / period)); }

PathSample atTick(int tick) { return hand().at(tick * period); }

double turnBetween(const Pose& a, const Pose& b) { return difference(a, b).tail<3>().norm(); }

struct Press {
    int from = 0;
    int until = 0;  // the first released tick
};

std::vector<Press> presses() {
    std::vector<Press> found;
    for (int tick = 1; tick <= ticks(); ++tick) {
        const bool before = atTick(tick - 1).trigger;
        if (!before && atTick(tick).trigger) found.push_back({tick, ticks()});
        if (before && !atTick(tick).trigger) found.back().until = tick;
    }
    return found;
}

double speedAt(int tick) {
    return (atTick(tick + 1).pose.position - atTick(tick).pose.position).norm() / period;
}

double rmsSpeed(int from, int until) {
    double sum = 0;
    for (int tick = from; tick < until; ++tick) sum += std::pow(speedAt(tick), 2);
    return std::sqrt(sum / (until - from));
}

TEST(HandPath, IsLongWideAndQuickEnough) {
    Eigen::Vector3d low = atTick(0).pose.position;
    Eigen::Vector3d high = low;
    double peak = 0;
    for (int tick = 0; tick < ticks(); ++tick) {
        low = low.cwiseMin(atTick(tick).pose.position);
        high = high.cwiseMax(atTick(tick).pose.position);
        peak = std::max(peak, speedAt(tick));
    }
    RecordProperty("rmsSpeed", std::to_string(rmsSpeed(0, ticks())));
    RecordProperty("peakSpeed", std::to_string(peak));
    RecordProperty("across", std::to_string((high - low).maxCoeff()));

    EXPECT_NEAR(hand().duration(), 24, 1e-9);
    EXPECT_GE((high - low).maxCoeff(), 0.4);
    EXPECT_GE(peak, 0.4);
    EXPECT_GE(rmsSpeed(0, ticks()), 0.15);
}

TEST(HandPath, PressesThreeTimesEachWithAWideQuickTurningMotion) {
    ASSERT_EQ(presses().size(), 3U);
    double widest = 0;
    for (const Press& press : presses()) {
        const Pose start = atTick(press.from).pose;
        double farthest = 0;
        double turn = 0;
        for (int tick = press.from; tick < press.until; ++tick) {
            const Pose pose = atTick(tick).pose;
            farthest = std::max(farthest, (pose.position - start.position).norm());
            turn = std::max(turn, turnBetween(start, pose));
            for (int other = press.from; other < tick; other += 100) {
                const Eigen::Vector3d way = pose.position - atTick(other).pose.position;
                widest = std::max(widest, way.norm());
            }
        }
        EXPECT_GE(rmsSpeed(press.from, press.until), 0.15);
        EXPECT_GE(farthest, 0.2);
        EXPECT_GE(turn, mechanics::test::radians(18));
        EXPECT_LE(turn, mechanics::test::radians(30));
        EXPECT_LT(rmsSpeed(press.from, press.from + 150), 0.01) << "moves before it is pressed";
    }
    EXPECT_GE(widest, 0.4);
}

TEST(HandPath, StandsStillForASecondAndAHalfInsideThePress) {
    int longest = 0;
    for (const Press& press : presses()) {
        int still = 0;
        for (int tick = press.from + 500; tick < press.until - 500; ++tick) {
            still = speedAt(tick) < 1e-6 ? still + 1 : 0;
            longest = std::max(longest, still);
        }
    }

    EXPECT_GE(longest, 1450);
}

TEST(HandPath, MovesWhileReleasedAndIsReleasedOnceInMotion) {
    const std::vector<Press> all = presses();
    ASSERT_EQ(all.size(), 3U);
    EXPECT_GE((atTick(all[1].from).pose.position - atTick(all[0].until).pose.position).norm(), 0.2);
    EXPECT_GE(turnBetween(atTick(all[0].until).pose, atTick(all[1].from).pose), 0.1);
    EXPECT_GE((atTick(all[2].from).pose.position - atTick(all[1].until).pose.position).norm(), 0.2);

    EXPECT_LT(speedAt(all[0].until), 1e-4);
    EXPECT_NEAR(speedAt(all[1].until), 0.2, 0.05);
    EXPECT_LT(speedAt(all[2].until), 1e-4);
}

TEST(HandPath, AddsUpToNoMotionWhilePressed) {
    Eigen::Vector3d way = Eigen::Vector3d::Zero();
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    for (const Press& press : presses()) {
        const Pose start = atTick(press.from).pose;
        const Pose end = atTick(press.until).pose;
        way += end.position - start.position;
        turn = end.rotation * start.rotation.conjugate() * turn;
    }

    EXPECT_LT(way.norm(), 1e-5);
    EXPECT_LT(turn.angularDistance(Eigen::Quaterniond::Identity()), 1e-5);
}

// How hard the joints work when inverse kinematics follows the path exactly, once around.
struct Effort {
    Eigen::VectorXd speed = Eigen::VectorXd::Zero(7);         // share of the limit
    Eigen::VectorXd range = Eigen::VectorXd::Zero(7);         // share of the limit
    Eigen::VectorXd acceleration = Eigen::VectorXd::Zero(7);  // rad/s2
    double drift = 0;  // rad, of a joint between the start and the end
    int notConverged = 0;
};

Effort followed() {
    const SerialChain arm = mechanics::test::lbrChain();
    const auto posture = mechanics::test::lbrPosture();
    SerialChain::InverseOptions options;
    options.period = period;
    Effort effort;
    auto joints = posture;
    Eigen::VectorXd speed = Eigen::VectorXd::Zero(7);
    Pose handAtPress;
    Pose tipAtPress;
    bool pressed = false;
    for (int tick = 0; tick <= ticks(); ++tick) {
        const PathSample sample = atTick(tick);
        if (sample.trigger && !pressed) {
            handAtPress = sample.pose;
            tipAtPress = arm.forward(joints);
        }
        pressed = sample.trigger;
        const auto before = joints;
        if (pressed) {
            const Pose target{
                tipAtPress.position + sample.pose.position - handAtPress.position,
                sample.pose.rotation * handAtPress.rotation.conjugate() * tipAtPress.rotation};
            if (!arm.inverse(target, joints, posture, options).converged) ++effort.notConverged;
        }
        const Eigen::VectorXd now = (joints - before) / period;
        // The jump at a release in motion is the controller's to smooth, not the path's.
        if (pressed) {
            const Eigen::VectorXd acceleration = (now - speed).cwiseAbs() / period;
            effort.acceleration = effort.acceleration.cwiseMax(acceleration);
        }
        speed = now;
        effort.speed = effort.speed.cwiseMax(now.cwiseAbs().cwiseQuotient(arm.maxSpeed()));
        effort.range = effort.range.cwiseMax(joints.cwiseAbs().cwiseQuotient(arm.max()));
    }
    effort.drift = (joints - posture).cwiseAbs().maxCoeff();
    return effort;
}

TEST(HandPath, IsFollowedByTheLbrWithRoomToSpare) {
    const Effort effort = followed();

    EXPECT_EQ(effort.notConverged, 0);
    for (int joint = 0; joint < 7; ++joint) {
        RecordProperty("speedShare" + std::to_string(joint + 1),
                       std::to_string(effort.speed[joint]));
        EXPECT_LT(effort.speed[joint], 0.8) << "joint " << joint + 1;
        EXPECT_LT(effort.range[joint], 0.8) << "joint " << joint + 1;
        EXPECT_LT(effort.acceleration[joint], 10) << "joint " << joint + 1;
    }
    EXPECT_LT(effort.drift, 0.01);
}

}  // namespace
}  // namespace cortex::toolkit
