// SPDX-License-Identifier: Apache-2.0
#include "rig.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

// Two axes with the limits of LimitedAxis: 3 rad either way, 2 rad/s, 10 rad/s2, 100 rad/s3.
class PoseController : public testing::Test {
protected:
    static constexpr double period = 1e-3;
    void begin(const std::string& profile = "1") {
        Rig::Pairs relates;
        for (const char* number : {"1", "2"}) {
            const std::string demand = std::string{"/demand"} + number;
            const std::string axis = std::string{"/axis"} + number;
            rig_.add(demand, "LimitedAxis");
            rig_.add(axis, "RotaryAxisObservation");
            relates.emplace_back("axes", axis);
            relates.emplace_back("demands", demand);
        }
        rig_.add("/pose", "AxisPoseController", relates, {{"profile", profile}});
        rig_.start();
        rig_.startUp();
    }
    void moveTo(double first, double second, double speedShare = 1) {
        std::vector<double> pose(16);
        pose[0] = first;
        pose[1] = second;
        rig_.cluster().send("/pose", "set", {{"pose", pose}});
        rig_.cluster().send("/pose", "moveTo", {{"speedShare", speedShare}});
        step(2);
    }
    void step(int cycles = 1) {
        for (int i = 0; i < cycles; ++i) {
            const double before = velocity(), accelerationBefore = acceleration();
            rig_.step();
            EXPECT_LE(std::abs(velocity() - before), 10 * period * (1 + 1e-9));
            jerk_ = std::max(jerk_, std::abs(acceleration() - accelerationBefore) / period);
            speed_ = std::max(speed_, std::abs(velocity()));
        }
    }
    double position(const char* number = "1") {
        return rig_.get<double>(std::string{"/demand"} + number, "position");
    }
    double velocity() { return rig_.get<double>("/demand1", "velocity"); }
    double acceleration() { return rig_.get<double>("/demand1", "acceleration"); }
    double remaining() { return rig_.get<double>("/pose", "remaining"); }
    std::int64_t outcome() { return rig_.get<std::int64_t>("/pose", "outcome"); }

    Rig rig_;
    double jerk_ = 0, speed_ = 0;
};

TEST_F(PoseController, BringsAllAxesThereInOneCycleWithinTheirLimits) {
    begin();
    moveTo(2, -0.3);
    const double time = remaining();
    // The closed form of the longer way: d/V + V/A + A/J, of which a cycle is over.
    EXPECT_NEAR(time, 2.0 / 2 + 2.0 / 10 + 10.0 / 100 - period, 1.1 * period);
    step(static_cast<int>(time / period) - 1);
    EXPECT_NE(position(), 2);
    EXPECT_NE(position("2"), -0.3);
    step(3);

    EXPECT_EQ(position(), 2);
    EXPECT_EQ(position("2"), -0.3);
    EXPECT_EQ(remaining(), 0);
    EXPECT_EQ(outcome(), static_cast<int>(Outcome::Done));
    EXPECT_LE(jerk_, 100 * (1 + 1e-9));
}

TEST_F(PoseController, AimsAnewInMotion) {
    begin();
    moveTo(2, 0);
    step(600);
    ASSERT_GT(velocity(), 1.5);
    moveTo(-1, 0.5);
    step(3000);

    EXPECT_EQ(position(), -1);
    EXPECT_EQ(position("2"), 0.5);
    EXPECT_LE(jerk_, 100 * (1 + 1e-9));
    EXPECT_EQ(rig_.get<std::int64_t>("/rig", "limitCount"), 0);
}

TEST_F(PoseController, TakesItsShareOfTheSpeed) {
    begin();
    moveTo(1, 0, 0.25);
    step(4000);

    EXPECT_EQ(position(), 1);
    EXPECT_NEAR(speed_, 0.5, 1e-6);
}

TEST_F(PoseController, MovesByTrapezoidsWhereItIsSetSo) {
    begin("0");
    moveTo(1, 0);
    step(100);

    EXPECT_NEAR(velocity(), 10 * 0.1, 0.03);  // no ramp of the acceleration
}

TEST_F(PoseController, BrakesWhenItIsCancelled) {
    begin();
    moveTo(2, 0);
    step(600);
    ASSERT_GT(velocity(), 1.5);
    EXPECT_TRUE(rig_.call("/pose", "cancel").done());
    step(400);

    EXPECT_EQ(velocity(), 0);
    EXPECT_LT(position(), 1.9);
    EXPECT_LE(jerk_, 100 * (1 + 1e-9));
}

TEST_F(PoseController, DoesNotGoOnByItselfAfterAnAxisWasLost) {
    begin();
    moveTo(2, 0);
    step(600);
    rig_.tree().at("/axis2").slot().quality = Quality::Lost;
    rig_.step(500);
    EXPECT_EQ(outcome(), static_cast<int>(Outcome::Failed));
    rig_.tree().at("/axis2").slot().quality = Quality::Good;
    rig_.step(10);
    const double stands = position();
    rig_.step(500);

    EXPECT_NEAR(position(), stands, 1e-9);
}

}  // namespace
}  // namespace cortex::toolkit::test
