// SPDX-License-Identifier: Apache-2.0
// The model of a Robotiq 2F-85, without wire and clock, and its octets.
#include "gripper_sim/gripper_model.hpp"

#include "gripper/robotiq_registers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

namespace cortex::modbus::test {
namespace {

using sim::GripperModel;

constexpr RobotiqRequest activate{.activate = true};

RobotiqRequest goTo(std::uint8_t position, std::uint8_t speed = 255, std::uint8_t force = 0) {
    return {true, true, false, position, speed, force};
}

class Gripper : public testing::Test {
protected:
    void run(double seconds) {
        for (int i = 0; i < std::lround(seconds * 1000); ++i) model.step(1e-3);
    }
    void makeActive() {
        model.request(activate);
        run(1.1);
        ASSERT_EQ(model.status().activation, RobotiqActivation::Activated);
    }
    RobotiqObject object() const { return model.status().object; }

    GripperModel model;
};

TEST(RobotiqRegisters, AreThoseOfTheTable) {
    EXPECT_EQ(encode(goTo(0xAB, 0xCD, 0xEF)), (RobotiqImage{0x0900, 0x00AB, 0xCDEF}));
    EXPECT_EQ(encode(RobotiqRequest{.activate = true, .release = true}),
              (RobotiqImage{0x1100, 0, 0}));
    const RobotiqStatus status = decodeStatus({0xB900, 0x0EFF, 0x7B09});
    EXPECT_TRUE(status.active);
    EXPECT_TRUE(status.goesTo);
    EXPECT_EQ(status.activation, RobotiqActivation::Activated);
    EXPECT_EQ(status.object, RobotiqObject::StoppedClosing);
    EXPECT_EQ(status.fault, 0xE);
    EXPECT_EQ(status.positionEcho, 0xFF);
    EXPECT_EQ(status.position, 0x7B);
    EXPECT_EQ(status.current, 0x09);
    EXPECT_EQ(encode(status), (RobotiqImage{0xB900, 0x0EFF, 0x7B09}));
    EXPECT_EQ(decodeRequest({0x1900, 0xFFAB, 0xCDEF}),
              (RobotiqRequest{true, true, true, 0xAB, 0xCD, 0xEF}));
}

TEST(RobotiqRegisters, HoldTheNearestOfANumberThatAnOctetCannotSay) {
    const RobotiqScale scale;
    EXPECT_EQ(scale.position(0.085), 0) << "as open as it goes";
    EXPECT_EQ(scale.position(1), 0);
    EXPECT_EQ(scale.position(0), 255) << "as closed as it goes";
    EXPECT_EQ(scale.position(-1), 255);
    EXPECT_NEAR(scale.width(scale.position(0.04)), 0.04, 2e-4);
    EXPECT_EQ(RobotiqScale::force(20), 0);
    EXPECT_EQ(RobotiqScale::force(235), 255);
    EXPECT_EQ(RobotiqScale::force(127.5), 128);
    EXPECT_EQ(RobotiqScale::force(-1e300), 0);
    EXPECT_EQ(RobotiqScale::force(std::numeric_limits<double>::infinity()), 255);
    EXPECT_EQ(RobotiqScale::force(std::nan("")), 0);
    EXPECT_EQ(RobotiqScale::speed(0.02), 0);
    EXPECT_EQ(RobotiqScale::speed(0.15), 255);
}

TEST_F(Gripper, OpensAndClosesOnceWhenItIsActivated) {
    EXPECT_EQ(model.status(), (RobotiqStatus{.position = 3}));
    double narrowest = model.width();
    model.request(activate);
    int steps = 0;
    for (; model.status().activation != RobotiqActivation::Activated && steps < 5000; ++steps) {
        model.step(1e-3);
        narrowest = std::min(narrowest, model.width());
        if (steps == 500) {
            EXPECT_EQ(model.status().activation, RobotiqActivation::Activating);
        }
    }
    EXPECT_NEAR(steps, 1000, 2);
    EXPECT_NEAR(narrowest, 0, 1e-3);
    EXPECT_NEAR(model.width(), 0.085, 1e-3);
}

TEST_F(Gripper, SaysWhyItDoesNotMoveBeforeItIsActivated) {
    model.request({.goTo = true, .position = 255});
    run(0.5);
    EXPECT_EQ(model.status().fault, 7);
    EXPECT_EQ(model.width(), 0.085);
    model.request(goTo(255));
    run(0.1);
    EXPECT_EQ(model.status().fault, 5);
    run(2);
    EXPECT_EQ(model.status().fault, 0) << "it has moved after its activation";
    EXPECT_NEAR(model.width(), 0, 1e-9);
    model.request({});
    EXPECT_EQ(model.status().activation, RobotiqActivation::Reset);
}

TEST_F(Gripper, MovesAtItsSpeedAndTellsWhenItIsThere) {
    makeActive();
    for (const auto& [speed, metresPerSecond] : {std::pair{255, 0.15}, {0, 0.02}}) {
        model.request(goTo(0));
        run(2);
        EXPECT_EQ(object(), RobotiqObject::AtDemand);
        model.request(goTo(230, static_cast<std::uint8_t>(speed)));
        EXPECT_EQ(object(), RobotiqObject::Moving);
        run(0.2);
        EXPECT_EQ(object(), RobotiqObject::Moving);
        EXPECT_NEAR(0.085 - model.width(), 0.2 * metresPerSecond, 2e-4);
    }
    model.request(activate);
    const double width = model.width();
    run(1);
    EXPECT_EQ(model.width(), width) << "without rGTO it stands";
}

TEST_F(Gripper, StopsAtAWorkPieceAndPressesWithItsForce) {
    makeActive();
    model.object = 0.04;
    model.request(goTo(255, 255, 0));
    run(2);
    EXPECT_EQ(object(), RobotiqObject::StoppedClosing);
    EXPECT_DOUBLE_EQ(model.width(), 0.04);
    const std::uint8_t weak = model.status().current;
    EXPECT_GT(weak, 0);
    model.request(goTo(255, 255, 255));
    run(0.01);
    EXPECT_EQ(object(), RobotiqObject::StoppedClosing);
    EXPECT_GT(model.status().current, 5 * weak);
    model.object.reset();
    run(1);
    EXPECT_EQ(object(), RobotiqObject::AtDemand) << "it was taken away";
    EXPECT_EQ(model.status().position, 230);
    model.object = 0.04;
    model.request(goTo(0));
    run(1);
    EXPECT_EQ(object(), RobotiqObject::AtDemand) << "the fingers were within it";
}

TEST_F(Gripper, StopsAtARingThatIsAroundItsFingers) {
    makeActive();
    model.request(goTo(255));
    run(1);
    model.ring = 0.06;
    model.request(goTo(0));
    run(1);
    EXPECT_EQ(object(), RobotiqObject::StoppedOpening);
    EXPECT_DOUBLE_EQ(model.width(), 0.06);
}

// As by function code 23, which writes before it reads.
TEST_F(Gripper, SaysThatItHoldsAlsoRightAfterTheNextRequest) {
    model.object = 0.03;
    makeActive();
    model.request(goTo(255));
    run(1);
    model.request(goTo(255));
    EXPECT_EQ(object(), RobotiqObject::StoppedClosing);
    model.request(goTo(250));
    EXPECT_EQ(object(), RobotiqObject::StoppedClosing) << "it would still meet it";
    model.request(goTo(0));
    EXPECT_EQ(object(), RobotiqObject::Moving) << "it is not in the way of opening";
}

TEST_F(Gripper, ReleasesSlowlyAndThenWantsAReset) {
    makeActive();
    model.request(goTo(255));
    run(1);
    model.request({.activate = true, .release = true});
    run(1);
    EXPECT_EQ(model.status().fault, 0xB);
    EXPECT_NEAR(model.width(), 0.01, 1e-3);
    model.request(goTo(255));
    run(10);
    EXPECT_EQ(model.status().fault, 0xF);
    EXPECT_EQ(model.status().position, 3);
    model.request({});
    makeActive();
    EXPECT_EQ(model.status().fault, 0);
}

TEST_F(Gripper, StandsInAFaultUntilItIsActivatedAnew) {
    makeActive();
    model.request(goTo(255));
    run(0.1);
    const double width = model.width();
    model.fail(0xE);
    run(0.1);
    EXPECT_EQ(model.status().fault, 0xE);
    EXPECT_EQ(model.width(), width);
    model.request({});
    EXPECT_EQ(model.status().fault, 0);
}

TEST_F(Gripper, IsResetByALossOfPowerAndStaysWhereItIs) {
    makeActive();
    model.request(goTo(255));
    run(0.1);
    const double width = model.width();
    model.powerCycle();
    run(0.1);
    EXPECT_EQ(model.status().activation, RobotiqActivation::Reset);
    EXPECT_FALSE(model.status().active);
    EXPECT_EQ(model.width(), width);
}

}  // namespace
}  // namespace cortex::modbus::test
