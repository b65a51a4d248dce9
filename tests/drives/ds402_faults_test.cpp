// SPDX-License-Identifier: Apache-2.0
#include "drives/drive_rig.hpp"

#include <limits>

namespace cortex::drives::test {
namespace {

using enum Ds402State;

Ds402Parameters withQuickStop(int option) {
    Ds402Parameters parameters;
    parameters.quickStopOption = option;
    return parameters;
}

TEST(Ds402QuickStop, BrakesOnTheRampOfItsOptionAndEndsWithoutPower) {
    struct Case {
        int option;
        double ramp;  // s, from 1 rad/s
    };
    for (const Case& each : {Case{1, 0.5}, Case{2, 0.1}, Case{3, 0.1}, Case{4, 0.1}}) {
        DriveRig rig{withQuickStop(each.option)};
        rig.turn(1);
        rig.send(0x0002, 1e-3);
        ASSERT_EQ(rig.drive.state(), QuickStopActive);
        EXPECT_NEAR(rig.untilNot(QuickStopActive, 2), each.ramp + 0.05, 0.03) << each.option;
        EXPECT_EQ(rig.drive.state(), SwitchOnDisabled);
        EXPECT_EQ(rig.out().velocity, 0);
    }
}

TEST(Ds402QuickStop, StaysWithTorqueForOptions5To8UntilOperationIsEnabledAnew) {
    for (const int option : {5, 6, 7, 8}) {
        DriveRig rig{withQuickStop(option)};
        rig.turn(1);
        rig.drive.disturbance.load = 5;
        rig.send(0x0002, 3);
        EXPECT_EQ(rig.drive.state(), QuickStopActive) << option;
        EXPECT_NEAR(rig.out().effort, 5, 0.01) << "it holds the load";
        EXPECT_TRUE(rig.bit(Ds402Status::targetReached));
        rig.in.velocity = 0;
        rig.send(0x000F);
        EXPECT_EQ(rig.drive.state(), OperationEnabled) << option;
        EXPECT_EQ(rig.out().lastTransition, 16);
    }
}

TEST(Ds402QuickStop, SwitchesThePowerOffAtOnceWithOption0) {
    DriveRig rig{withQuickStop(0)};
    rig.turn(1);
    rig.send(0x0002, 1e-3);

    EXPECT_EQ(rig.drive.state(), SwitchOnDisabled);
    EXPECT_EQ(rig.out().effort, 0);
    EXPECT_GT(rig.out().velocity, 0.9) << "it coasts until the brake falls";
    rig.run(0.1);
    EXPECT_EQ(rig.out().velocity, 0);
}

TEST(Ds402QuickStop, IgnoresTargets) {
    DriveRig rig{withQuickStop(6)};
    rig.enable(Ds402Mode::CyclicPosition);
    rig.send(0x0002, 0.1);
    const double before = rig.out().position;
    rig.in.position = 1;
    rig.run(0.5);

    EXPECT_NEAR(rig.out().position, before, 1e-4);
}

TEST(Ds402Ramps, EndEnabledOperationByTheOptionsOfTheirWord) {
    for (const std::uint16_t word : {std::uint16_t{0x0006}, std::uint16_t{0x0007}}) {
        DriveRig rig;
        rig.turn(1);
        rig.send(word, 0.4);
        EXPECT_EQ(rig.drive.state(), OperationEnabled) << "on its ramp of 0.5 s";
        EXPECT_FALSE(rig.bit(Ds402Status::follows));
        rig.run(0.2);
        EXPECT_EQ(rig.drive.state(), word == 6 ? ReadyToSwitchOn : SwitchedOn);

        Ds402Parameters atOnce;
        atOnce.shutdownOption = atOnce.disableOption = 0;
        DriveRig other{atOnce};
        other.turn(1);
        other.send(word, 1e-3);
        EXPECT_EQ(other.drive.state(), word == 6 ? ReadyToSwitchOn : SwitchedOn);
        EXPECT_GT(other.out().velocity, 0.9);
    }
}

TEST(Ds402Ramps, AreLeftByAWordThatEnablesAgain) {
    DriveRig rig;
    rig.turn(1);
    rig.send(0x0007, 0.3);
    rig.send(0x000F, 0.2);

    EXPECT_EQ(rig.drive.state(), OperationEnabled);
    EXPECT_NEAR(rig.out().velocity, 1, 0.01);
}

TEST(Ds402Faults, BrakeByTheirOptionAndStayUntilTheyAreReset) {
    struct Case {
        int option;
        double reaction;  // s, from 1 rad/s
    };
    for (const Case& each : {Case{1, 0.54}, Case{2, 0.14}, Case{0, 0.0}}) {
        Ds402Parameters parameters;
        parameters.faultReactionOption = each.option;
        DriveRig rig{parameters};
        rig.turn(1);
        rig.drive.fail(0x2310, false);
        EXPECT_NEAR(rig.untilNot(OperationEnabled, 1), 1e-3, 1e-4);
        EXPECT_NEAR(rig.untilNot(FaultReactionActive, 2), each.reaction, 0.03) << each.option;
        rig.run(1);
        EXPECT_EQ(rig.drive.state(), Fault);
        EXPECT_EQ(rig.out().errorCode, 0x2310);
        EXPECT_EQ(rig.out().statusWord, 0x0218);
    }
}

TEST(Ds402Faults, AreNotResetByALevelNorWhileTheirCauseStands) {
    DriveRig rig;
    rig.enable(Ds402Mode::CyclicPosition);
    rig.drive.fail(0x3210, true);
    rig.send(0x0080, 0.2);
    EXPECT_EQ(rig.drive.state(), Fault) << "the edge came before the fault was over";
    const std::uint32_t before = rig.out().refused;
    rig.send(0x0000);
    rig.send(0x0080);
    EXPECT_EQ(rig.drive.state(), Fault) << "the cause stands";
    EXPECT_EQ(rig.out().refused, before + 1);
    rig.drive.clearCause();
    rig.run(0.1);
    EXPECT_EQ(rig.drive.state(), Fault) << "it takes a new edge";
    rig.send(0x0000);
    rig.send(0x0080);
    EXPECT_EQ(rig.drive.state(), SwitchOnDisabled);
    EXPECT_EQ(rig.out().errorCode, 0);
    EXPECT_EQ(rig.out().refused, before + 1);
}

TEST(Ds402Faults, KeepTheCodeOfTheFirst) {
    DriveRig rig;
    rig.run(0.6);
    rig.drive.fail(0x7305, false);
    rig.run(2e-3);
    EXPECT_EQ(rig.drive.state(), Fault) << "without torque there is nothing to brake";
    rig.drive.fail(0x4310, false);
    rig.run(2e-3);

    EXPECT_EQ(rig.out().errorCode, 0x7305);
}

TEST(Ds402Faults, TakeAWayTheVoltageWhereTheLinkHasNone) {
    DriveRig rig;
    rig.run(0.6);
    rig.drive.fail(0x3220, true);
    rig.run(2e-3);
    EXPECT_FALSE(rig.bit(Ds402Status::voltageEnabled));
    rig.drive.clearCause();
    rig.run(2e-3);
    EXPECT_TRUE(rig.bit(Ds402Status::voltageEnabled));
}

TEST(Ds402Faults, ComeOfALoadThatTheAxisCannotFollowWith) {
    DriveRig rig;
    rig.enable(Ds402Mode::CyclicPosition);
    rig.drive.disturbance.load = 40;  // the drive has 30
    rig.run(0.05);
    EXPECT_TRUE(rig.bit(Ds402Status::internalLimit));
    EXPECT_TRUE(rig.bit(Ds402Status::followingError));
    rig.untilNot(OperationEnabled, 1);
    EXPECT_EQ(rig.out().errorCode, 0x8611);
    EXPECT_EQ(rig.out().lastTransition, 13);
    EXPECT_LT(rig.untilNot(FaultReactionActive, 5), 2) << "though it cannot brake";
    rig.run(0.3);
    EXPECT_EQ(rig.out().velocity, 0) << "the brake holds";
}

TEST(Ds402Faults, ComeOfABlockedRotorButNotInASpeedMode) {
    for (const Ds402Mode mode : {Ds402Mode::CyclicPosition, Ds402Mode::CyclicVelocity}) {
        DriveRig rig;
        rig.enable(mode);
        rig.drive.disturbance.blockedRotor = true;
        rig.in.position = 0.5;
        rig.in.velocity = 1;
        rig.run(0.5);
        const bool follows = mode == Ds402Mode::CyclicPosition;
        EXPECT_EQ(rig.out().errorCode, follows ? 0x8611 : 0);
        EXPECT_EQ(rig.out().position, 0);
    }
}

TEST(Ds402Faults, DoNotComeOfAFollowingErrorThatIsNotWatchedOrShort) {
    Ds402Parameters unwatched;
    unwatched.followingErrorWindow = 0;
    DriveRig rig{unwatched};
    rig.enable(Ds402Mode::CyclicPosition);
    rig.in.position = 2;
    rig.run(1);
    EXPECT_EQ(rig.drive.state(), OperationEnabled);

    Ds402Parameters patient;
    patient.followingErrorTime = 0.5;
    DriveRig other{patient};
    other.enable(Ds402Mode::CyclicPosition);
    other.in.position = 1;
    other.run(1);
    EXPECT_EQ(other.drive.state(), OperationEnabled);
    EXPECT_NEAR(other.out().position, 1, 1e-4);
}

TEST(Ds402Faults, ComeOfTooMuchHeatAfterAWarning) {
    Ds402Parameters parameters;
    parameters.followingErrorWindow = 0;
    DriveRig rig{parameters};
    rig.enable(Ds402Mode::CyclicPosition);
    rig.drive.disturbance.load = 20;
    rig.drive.disturbance.blockedRotor = true;
    rig.in.position = 3;
    while (rig.out().temperature < 75) rig.drive.step(rig.in, 0.1);
    EXPECT_TRUE(rig.bit(Ds402Status::warning));
    EXPECT_EQ(rig.drive.state(), OperationEnabled);
    while (rig.drive.state() == OperationEnabled) rig.drive.step(rig.in, 0.1);
    EXPECT_EQ(rig.out().errorCode, 0x4310);
    rig.run(0.2);
    rig.send(0x0080);
    EXPECT_EQ(rig.drive.state(), Fault) << "it is still hot";
    while (rig.out().temperature > 79) rig.drive.step(rig.in, 1);
    rig.send(0x0000);
    rig.send(0x0080);
    EXPECT_EQ(rig.drive.state(), SwitchOnDisabled);
}

TEST(Ds402Connection, ActsByItsOptionWhenItIsLostInOperation) {
    constexpr Ds402State ends[] = {OperationEnabled, FaultReactionActive, SwitchOnDisabled,
                                   QuickStopActive};
    for (int option = 0; option < 4; ++option) {
        Ds402Parameters parameters;
        parameters.abortOption = option;
        DriveRig rig{parameters};
        rig.turn(1);
        rig.drive.communicationLost();
        rig.run(0.01);
        EXPECT_EQ(rig.drive.state(), ends[option]) << option;
        EXPECT_EQ(rig.out().errorCode, option == 1 ? 0x7500 : 0);
    }
}

TEST(Ds402Connection, IsNotMissedOutsideOfOperation) {
    DriveRig rig;
    rig.run(0.6);
    rig.send(0x0006);
    rig.send(0x0007);
    rig.drive.communicationLost();
    rig.run(0.1);

    EXPECT_EQ(rig.drive.state(), SwitchedOn);
}

// Otherwise the old word 000F would start the axis again by itself.
TEST(Ds402Connection, LeavesNoWordBehindThatActsAfterItsLoss) {
    Ds402Parameters parameters;
    parameters.abortOption = 3;
    parameters.quickStopOption = 6;
    DriveRig rig{parameters};
    rig.turn(1);
    rig.drive.communicationLost();
    rig.run(1);
    EXPECT_EQ(rig.drive.state(), QuickStopActive);
    rig.in.velocity = 0;
    rig.send(0x0002);
    rig.send(0x000F);
    EXPECT_EQ(rig.drive.state(), OperationEnabled);
}

TEST(Ds402Power, ThatWasLostClearsWhatIsHomedAndBeginsAnew) {
    DriveRig rig;
    rig.enable(Ds402Mode::Homing);
    rig.send(0x001F, 0.1);
    ASSERT_TRUE(rig.out().homed);
    const std::uint32_t before = rig.out().transitions;
    rig.drive.powerCycle();
    EXPECT_EQ(rig.drive.state(), NotReadyToSwitchOn);
    EXPECT_EQ(rig.out().statusWord, 0);
    EXPECT_FALSE(rig.out().homed);
    EXPECT_EQ(rig.out().transitions, before + 1);
    rig.run(0.6);
    EXPECT_EQ(rig.drive.state(), SwitchOnDisabled) << "000F is no way from here";
}

TEST(Ds402Encoder, ThatJumpsIsNotHomedAndStraysFromItsTarget) {
    DriveRig rig;
    rig.enable(Ds402Mode::Homing);
    rig.send(0x001F, 0.1);
    rig.in.mode = 8;
    rig.send(0x000F, 0.1);
    ASSERT_TRUE(rig.out().homed);
    const double place = rig.drive.place();
    rig.drive.jumpEncoder(0.4);
    EXPECT_NEAR(rig.out().position, 0.4, 1e-4);
    EXPECT_EQ(rig.drive.place(), place);
    EXPECT_FALSE(rig.out().homed);
    rig.run(1e-3);
    EXPECT_NEAR(rig.out().followingError, -0.4, 0.01);
    rig.drive.jumpEncoder(std::numeric_limits<double>::quiet_NaN());
    EXPECT_TRUE(std::isfinite(rig.out().position));
}

TEST(Ds402Encoder, ThatIsAbsoluteIsHomedFromTheStart) {
    Ds402Axis axis;
    axis.absoluteEncoder = true;
    axis.startPosition = 1.5;
    DriveRig rig{{}, axis};
    EXPECT_TRUE(rig.out().homed);
    rig.drive.powerCycle();
    EXPECT_TRUE(rig.out().homed);
    EXPECT_EQ(rig.out().position, 1.5);
}

}  // namespace
}  // namespace cortex::drives::test
