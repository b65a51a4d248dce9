// SPDX-License-Identifier: Apache-2.0
#include "drives/drive_rig.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace cortex::drives::test {
namespace {

TEST(Ds402CyclicPosition, FollowsASineWithin2Milliradians) {
    DriveRig rig;
    rig.drive.disturbance.friction = 0.1;
    rig.enable(Ds402Mode::CyclicPosition);
    constexpr double turn = 2 * std::numbers::pi * 0.4;
    double sum = 0;
    constexpr int steps = 5000;
    for (int i = 0; i < steps; ++i) {
        rig.in.position = 0.25 * std::sin(turn * i * 1e-3);
        rig.in.velocityOffset = 0.25 * turn * std::cos(turn * i * 1e-3);
        rig.run(1e-3);
        sum += std::pow(rig.out().position - rig.in.position, 2);
    }
    EXPECT_LT(std::sqrt(sum / steps), 5e-4);
    EXPECT_TRUE(rig.bit(Ds402Status::follows));
    EXPECT_FALSE(rig.bit(Ds402Status::internalLimit));
}

TEST(Ds402CyclicPosition, ArrivesAtAStepAndSaysSo) {
    DriveRig rig;
    rig.drive.disturbance.friction = 0.1;
    rig.enable(Ds402Mode::CyclicPosition);
    rig.in.position = 0.05;
    rig.run(5e-3);
    EXPECT_FALSE(rig.bit(Ds402Status::targetReached));
    EXPECT_GT(rig.out().followingError, 0.02);
    rig.run(0.4);
    EXPECT_TRUE(rig.bit(Ds402Status::targetReached));
    EXPECT_NEAR(rig.out().position, 0.05, 2e-5);
    EXPECT_NEAR(rig.out().demand, 0.05, 1e-12);
}

TEST(Ds402CyclicPosition, StopsAtASoftLimitAndRaisesBit11) {
    Ds402Parameters parameters;
    parameters.softMin = -0.5;
    parameters.softMax = 0.2;
    parameters.followingErrorTime = 1;
    DriveRig rig{parameters};
    rig.enable(Ds402Mode::CyclicPosition);
    for (const double target : {5.0, -5.0}) {
        rig.in.position = target;
        rig.run(0.5);
        EXPECT_NEAR(rig.out().position, target > 0 ? 0.2 : -0.5, 2e-5);
        EXPECT_TRUE(rig.bit(Ds402Status::internalLimit));
    }
    rig.in.position = 0.1;
    rig.run(0.5);
    EXPECT_FALSE(rig.bit(Ds402Status::internalLimit));
    EXPECT_EQ(rig.drive.state(), Ds402State::OperationEnabled);
}

TEST(Ds402CyclicPosition, StaysWhereItIsForATargetThatIsNoNumber) {
    DriveRig rig;
    rig.enable(Ds402Mode::CyclicPosition);
    rig.in.position = 0.05;
    rig.run(0.5);
    for (const double none :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        rig.in.position = none;
        rig.run(0.5);
        EXPECT_NEAR(rig.out().position, 0.05, 2e-5);
        EXPECT_TRUE(rig.bit(Ds402Status::internalLimit));
    }
}

TEST(Ds402Drive, ObeysTargetsOnlyWhenItsBrakeIsOpen) {
    DriveRig rig;
    rig.in.mode = 8;
    rig.run(0.6);
    rig.send(0x0006);
    rig.in.position = 0.05;
    rig.send(0x000F, 0.025);
    EXPECT_FALSE(rig.bit(Ds402Status::follows));
    EXPECT_EQ(rig.out().position, 0);
    rig.run(0.4);
    EXPECT_TRUE(rig.bit(Ds402Status::follows));
    EXPECT_NEAR(rig.out().position, 0.05, 2e-5);
}

TEST(Ds402Drive, HoldsALoadByItsBrakeAndTakesItOverWithoutDropping) {
    DriveRig rig;
    rig.drive.disturbance.load = 10;
    rig.run(0.6);
    EXPECT_EQ(rig.out().position, 0);
    rig.enable(Ds402Mode::CyclicPosition);
    rig.run(0.5);
    EXPECT_NEAR(rig.out().position, 0, 2e-5);
    EXPECT_NEAR(rig.out().effort, 10, 0.01);
    rig.send(0x0007, 0.5);
    EXPECT_EQ(rig.drive.state(), Ds402State::SwitchedOn);
    EXPECT_EQ(rig.out().effort, 0);
    EXPECT_NEAR(rig.out().position, 0, 2e-5);
}

TEST(Ds402Drive, GoesOnBearingALoadThatItsMasterBoreWhenItHalts) {
    DriveRig rig;
    rig.enable(Ds402Mode::CyclicPosition);
    for (int i = 0; i < 1000; ++i) {
        rig.drive.disturbance.load = rig.in.effortOffset = 0.01 * i;
        rig.run(1e-3);
    }
    rig.run(0.5);
    double dropped = 0;
    rig.in.controlWord = 0x010F;
    for (int i = 0; i < 100; ++i) {
        rig.run(1e-3);
        dropped = std::max(dropped, std::abs(rig.out().position));
    }
    EXPECT_LT(dropped, 1e-3);
}

TEST(Ds402Drive, DoesNotWindUpWhileItsRotorIsBlocked) {
    DriveRig rig;
    rig.enable(Ds402Mode::CyclicVelocity);
    rig.drive.disturbance.blockedRotor = true;
    rig.in.velocity = 2;
    rig.run(1);
    rig.drive.disturbance.blockedRotor = false;
    double fastest = 0;
    for (int i = 0; i < 300; ++i) {
        rig.run(1e-3);
        fastest = std::max(fastest, rig.out().velocity);
    }
    EXPECT_GT(fastest, 1.99);
    EXPECT_LT(fastest, 2.2);
}

TEST(Ds402Drive, DoesNotPassAStopAndPressesHarderTheLongerItWouldGoOn) {
    DriveRig rig;
    rig.drive.disturbance.stopMin = -0.02;
    rig.drive.disturbance.stopMax = 0.03;
    rig.enable(Ds402Mode::CyclicPosition);
    for (const double way : {-1.0, 1.0}) {
        const double stop = way < 0 ? -0.02 : 0.03;
        rig.in.position = stop + way * 0.001;
        rig.run(0.2);
        const double pressed = rig.out().effort;
        rig.run(0.2);
        EXPECT_NEAR(rig.out().position, stop, 1e-5);
        EXPECT_EQ(rig.out().velocity, 0);
        EXPECT_GT(way * pressed, 0);
        EXPECT_GT(way * rig.out().effort, way * pressed) << "its speed controller integrates";
    }
    rig.in.position = 0;
    rig.run(1);
    EXPECT_NEAR(rig.out().position, 0, 1e-4);
}

TEST(Ds402Drive, IsNotMovedByAStopThatItIsBeyondAndOnlyComesBack) {
    DriveRig rig;
    rig.enable(Ds402Mode::CyclicPosition);
    rig.drive.disturbance.stopMin = 0.02;
    rig.drive.disturbance.stopMax = 0.1;
    rig.in.position = -0.01;
    rig.run(0.2);
    EXPECT_NEAR(rig.out().position, 0, 1e-5);
    rig.in.position = 0.05;
    rig.run(1);
    EXPECT_NEAR(rig.out().position, 0.05, 1e-4);
    rig.in.position = 0;
    rig.run(0.2);
    EXPECT_NEAR(rig.out().position, 0.02, 1e-5);
}

TEST(Ds402Drive, HaltsOnTheRampOfItsOptionAndGoesOn) {
    for (const auto& [option, ramp] : {std::pair{1, 0.5}, std::pair{2, 0.1}}) {
        Ds402Parameters parameters;
        parameters.haltOption = option;
        DriveRig rig{parameters};
        rig.turn(1);
        rig.send(0x010F, ramp - 0.02);
        EXPECT_GT(rig.out().velocity, 0.01) << option;
        EXPECT_FALSE(rig.bit(Ds402Status::targetReached));
        rig.run(0.06);
        EXPECT_NEAR(rig.out().velocity, 0, 1e-3) << option;
        EXPECT_TRUE(rig.bit(Ds402Status::targetReached));
        EXPECT_FALSE(rig.bit(Ds402Status::follows));
        rig.send(0x000F, 0.2);
        EXPECT_NEAR(rig.out().velocity, 1, 1e-3);
    }
}

TEST(Ds402CyclicVelocity, FollowsItsTargetWithinTheGreatestVelocity) {
    Ds402Parameters parameters;
    parameters.maxVelocity = 2;
    DriveRig rig{parameters};
    rig.enable(Ds402Mode::CyclicVelocity);
    rig.in.velocity = 1;
    rig.in.velocityOffset = 0.5;
    rig.run(0.3);
    EXPECT_NEAR(rig.out().velocity, 1.5, 1e-3);
    EXPECT_FALSE(rig.bit(Ds402Status::internalLimit));
    rig.in.velocity = -7;
    rig.run(0.3);
    EXPECT_NEAR(rig.out().velocity, -2, 1e-3);
    EXPECT_TRUE(rig.bit(Ds402Status::internalLimit));
}

// Speed and torque modes brake before a software limit.
class Ds402SoftLimit : public testing::TestWithParam<Ds402Mode> {};

TEST_P(Ds402SoftLimit, IsNotPassed) {
    Ds402Parameters parameters;
    parameters.softMin = -1;
    parameters.softMax = 0.3;
    DriveRig rig{parameters};
    rig.enable(GetParam());
    rig.in.velocity = 3;
    rig.in.effort = 3;
    double greatest = 0;
    for (int i = 0; i < 3000; ++i) {
        rig.run(1e-3);
        greatest = std::max(greatest, rig.out().position);
    }
    EXPECT_NEAR(greatest, 0.3, 0.01);
    EXPECT_LT(std::abs(rig.out().velocity), 0.01);
    EXPECT_TRUE(rig.bit(Ds402Status::internalLimit));
}

INSTANTIATE_TEST_SUITE_P(InEachMode, Ds402SoftLimit,
                         testing::Values(Ds402Mode::CyclicVelocity, Ds402Mode::ProfileVelocity,
                                         Ds402Mode::CyclicTorque),
                         [](const auto& each) {
                             return std::string(modeRow(static_cast<int>(each.param))->letters);
                         });

TEST(Ds402CyclicTorque, GivesItsEffortUpToItsLimits) {
    Ds402Parameters parameters;
    parameters.maxVelocity = 2;
    DriveRig rig{parameters};
    rig.enable(Ds402Mode::CyclicTorque);
    rig.in.effort = 3;
    rig.in.effortOffset = 1;
    rig.run(0.02);
    EXPECT_NEAR(rig.out().effort, 4, 1e-3);
    EXPECT_NEAR(rig.out().velocity, 0.02 * 4 / 0.1, 0.06);
    rig.run(0.5);
    EXPECT_NEAR(rig.out().velocity, 2, 0.01) << "no faster";
    EXPECT_TRUE(rig.bit(Ds402Status::internalLimit));
    rig.drive.disturbance.blockedRotor = true;
    rig.in.effort = 99;
    rig.run(0.02);
    EXPECT_NEAR(rig.out().effort, 30, 1e-3);
}

TEST(Ds402ProfileVelocity, RampsWithTheProfilesAcceleration) {
    DriveRig rig;
    rig.enable(Ds402Mode::ProfileVelocity);
    EXPECT_TRUE(rig.bit(Ds402Status::standing));
    rig.in.velocity = 1;
    rig.run(0.25);
    EXPECT_NEAR(rig.out().velocity, 0.5, 0.02);
    EXPECT_FALSE(rig.bit(Ds402Status::targetReached));
    EXPECT_FALSE(rig.bit(Ds402Status::standing));
    rig.run(0.35);
    EXPECT_NEAR(rig.out().velocity, 1, 1e-3);
    EXPECT_TRUE(rig.bit(Ds402Status::targetReached));
}

// Bit 4 rises with a new target, and falls when bit 12 has acknowledged it.
void setPoint(DriveRig& rig, double target, int extraBits = 0) {
    rig.in.position = target;
    rig.send(static_cast<std::uint16_t>(0x001F | extraBits));
    EXPECT_TRUE(rig.bit(Ds402Status::setPointTaken));
    rig.send(static_cast<std::uint16_t>(0x000F | extraBits));
}

TEST(Ds402ProfilePosition, MovesByItsOwnProfileAfterTheHandshake) {
    DriveRig rig;
    rig.enable(Ds402Mode::ProfilePosition);
    rig.in.position = 0.5;
    rig.run(0.3);
    EXPECT_EQ(rig.out().position, 0) << "a target alone is no set-point";
    setPoint(rig, 0.5);
    EXPECT_FALSE(rig.bit(Ds402Status::setPointTaken));
    EXPECT_FALSE(rig.bit(Ds402Status::targetReached));
    double fastest = 0, farthest = 0;
    // 0.25 s to 0.5 rad/s, 0.75 s at it, 0.25 s to rest
    for (int i = 0; i < 1200; ++i) {
        rig.run(1e-3);
        fastest = std::max(fastest, rig.out().velocity);
        farthest = std::max(farthest, rig.out().position);
    }
    EXPECT_NEAR(rig.out().demand, 0.5, 0.01);
    EXPECT_LT(rig.out().demand, 0.5) << "it takes 1.25 s";
    rig.run(0.2);
    EXPECT_NEAR(rig.out().position, 0.5, 2e-5);
    EXPECT_TRUE(rig.bit(Ds402Status::targetReached));
    EXPECT_NEAR(fastest, 0.5, 0.02);
    EXPECT_LT(farthest, 0.5005);
}

TEST(Ds402ProfilePosition, TakesOneSetPointThatWaitsAndNoThird) {
    DriveRig rig;
    rig.enable(Ds402Mode::ProfilePosition);
    setPoint(rig, 0.2);
    setPoint(rig, 0.1);
    EXPECT_TRUE(rig.bit(Ds402Status::setPointTaken)) << "one waits, so there is no room";
    rig.in.position = -1;
    rig.send(0x001F);
    rig.send(0x000F);
    rig.run(0.5);
    EXPECT_GT(rig.out().position, 0.12) << "first the first one";
    rig.run(1.5);
    EXPECT_NEAR(rig.out().position, 0.1, 2e-5);
    EXPECT_FALSE(rig.bit(Ds402Status::setPointTaken));
    EXPECT_TRUE(rig.bit(Ds402Status::targetReached));
}

TEST(Ds402ProfilePosition, ChangesItsTargetAtOnceWithBit5AndByAnAmountWithBit6) {
    DriveRig rig;
    rig.enable(Ds402Mode::ProfilePosition);
    setPoint(rig, 1);
    rig.run(0.3);
    setPoint(rig, 0.4, Ds402Control::atOnce);
    EXPECT_FALSE(rig.bit(Ds402Status::setPointTaken));
    rig.run(1.5);
    EXPECT_NEAR(rig.out().position, 0.4, 2e-5);
    setPoint(rig, -0.1, Ds402Control::relative);
    rig.run(1);
    EXPECT_NEAR(rig.out().position, 0.3, 2e-5);
}

TEST(Ds402ProfilePosition, GoesOnToItsTargetAfterAHalt) {
    DriveRig rig;
    rig.enable(Ds402Mode::ProfilePosition);
    setPoint(rig, 0.5);
    rig.run(0.4);
    rig.send(0x010F, 0.5);
    const double halted = rig.out().position;
    EXPECT_LT(halted, 0.4);
    EXPECT_NEAR(rig.out().velocity, 0, 1e-3);
    rig.send(0x000F, 1.5);
    EXPECT_NEAR(rig.out().position, 0.5, 2e-5);
}

}  // namespace
}  // namespace cortex::drives::test
