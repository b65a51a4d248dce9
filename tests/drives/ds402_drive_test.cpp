// SPDX-License-Identifier: Apache-2.0
#include "drives/drive_rig.hpp"

namespace cortex::drives::test {
namespace {

using enum Ds402State;

// Its transition, and where it is then.
void expectTransition(const DriveRig& rig, int number, Ds402State state) {
    EXPECT_EQ(rig.out().lastTransition, number);
    EXPECT_EQ(rig.drive.state(), state) << nameOf(rig.drive.state());
    EXPECT_EQ(stateOf(rig.out().statusWord), state);
}

TEST(Ds402Drive, MakesTransitions0To4OnItsWayToOperation) {
    DriveRig rig;
    expectTransition(rig, 0, NotReadyToSwitchOn);
    rig.run(0.49);
    expectTransition(rig, 0, NotReadyToSwitchOn);
    rig.run(0.02);
    expectTransition(rig, 1, SwitchOnDisabled);
    rig.send(0x0006);
    expectTransition(rig, 2, ReadyToSwitchOn);
    rig.send(0x0007);
    expectTransition(rig, 3, SwitchedOn);
    rig.send(0x000F);
    expectTransition(rig, 4, OperationEnabled);
    EXPECT_EQ(rig.out().transitions, 4u);
}

TEST(Ds402Drive, MakesTransitions5To10OnItsWayBack) {
    DriveRig rig;
    rig.enable(Ds402Mode::CyclicPosition);
    rig.send(0x0007, 0.05);
    expectTransition(rig, 5, SwitchedOn);
    rig.send(0x0006);
    expectTransition(rig, 6, ReadyToSwitchOn);
    rig.send(0x0000);
    expectTransition(rig, 7, SwitchOnDisabled);
    rig.send(0x0006);
    rig.send(0x0002);
    expectTransition(rig, 7, SwitchOnDisabled);
    rig.send(0x0006);
    rig.send(0x000F, 0.05);
    rig.send(0x0006, 0.05);
    expectTransition(rig, 8, ReadyToSwitchOn);
    rig.send(0x000F, 0.05);
    rig.send(0x0000);
    expectTransition(rig, 9, SwitchOnDisabled);
    for (const std::uint16_t word : {std::uint16_t{0x0000}, std::uint16_t{0x0002}}) {
        rig.send(0x0006);
        rig.send(0x0007);
        rig.send(word);
        expectTransition(rig, 10, SwitchOnDisabled);
    }
}

TEST(Ds402Drive, MakesTransitions11To16AroundStopsAndFaults) {
    Ds402Parameters parameters;
    parameters.quickStopOption = 6;
    DriveRig rig{parameters};
    rig.enable(Ds402Mode::CyclicPosition);
    rig.send(0x0002, 0.1);
    expectTransition(rig, 11, QuickStopActive);
    rig.send(0x000F);
    expectTransition(rig, 16, OperationEnabled);
    rig.send(0x0002);
    rig.send(0x0000);
    expectTransition(rig, 12, SwitchOnDisabled);
    rig.send(0x0006);
    rig.send(0x000F, 0.1);
    rig.drive.fail(0x2310, false);
    rig.run(2e-3);
    expectTransition(rig, 13, FaultReactionActive);
    rig.run(0.1);
    expectTransition(rig, 14, Fault);
    rig.send(0x0080);
    expectTransition(rig, 15, SwitchOnDisabled);
    parameters.quickStopOption = 2;
    ASSERT_TRUE(rig.drive.set(parameters));
    rig.send(0x0006);
    rig.send(0x000F, 0.1);
    rig.send(0x0002, 0.1);
    expectTransition(rig, 12, SwitchOnDisabled);
}

TEST(Ds402Drive, GoesFromReadyToOperationByTransitions3And4WithOneWord) {
    DriveRig rig;
    rig.run(0.6);
    rig.send(0x0006);
    const std::uint32_t before = rig.out().transitions;

    rig.send(0x000F);

    expectTransition(rig, 4, OperationEnabled);
    EXPECT_EQ(rig.out().transitions, before + 2);
}

TEST(Ds402Drive, ObeysAWordThatStoodBeforeItsSelfTestEnded) {
    DriveRig rig;
    rig.send(0x0006, 0.6);

    expectTransition(rig, 2, ReadyToSwitchOn);
    EXPECT_EQ(rig.out().refused, 0u);
}

TEST(Ds402Drive, CountsAWordThatItRefusesOnceHoweverLongItStands) {
    DriveRig rig;
    rig.run(0.6);
    const auto status = rig.out().statusWord;
    rig.send(0x000F, 0.1);
    EXPECT_EQ(rig.out().refused, 1u);
    rig.send(0x0007, 0.1);
    rig.send(0x0080, 0.1);
    EXPECT_EQ(rig.out().refused, 3u) << "switch on, and a reset without a fault";
    EXPECT_EQ(rig.out().statusWord, status);
    EXPECT_EQ(rig.out().transitions, 1u);
}

TEST(Ds402Drive, RefusesNoWordThatAsksForWhatIsThere) {
    DriveRig rig;
    rig.run(0.6);
    rig.send(0x0002);
    rig.send(0x0000);
    rig.send(0x0006);
    rig.send(0x000F, 0.1);
    rig.send(0x001F, 0.1);
    rig.send(0x010F, 0.1);

    EXPECT_EQ(rig.out().refused, 0u);
}

TEST(Ds402Drive, ChangesItsModeOnlyAtStandstillWhenItIsEnabled) {
    DriveRig rig;
    rig.turn(1);
    rig.in.mode = 8;
    rig.run(0.1);
    EXPECT_EQ(rig.out().modeDisplay, 9) << "it moves";
    EXPECT_EQ(rig.out().refused, 1u);

    rig.in.velocity = 0;
    rig.in.position = 0.5;
    rig.run(0.3);
    EXPECT_EQ(rig.out().modeDisplay, 8);
    EXPECT_EQ(rig.out().refused, 1u);
}

TEST(Ds402Drive, ChangesItsModeInMotionWithoutTorque) {
    DriveRig rig;
    rig.turn(1);
    rig.send(0x0000, 1e-3);
    rig.in.mode = 8;
    rig.run(1e-3);

    EXPECT_GT(std::abs(rig.out().velocity), 0.1) << "it coasts";
    EXPECT_EQ(rig.out().modeDisplay, 8);
}

TEST(Ds402Drive, KeepsItsModeWhereTheOtherIsNotBuiltOrNotSupported) {
    Ds402Parameters parameters;
    parameters.supportedModes = supportedBit(8) | supportedBit(6);
    DriveRig rig{parameters};
    rig.enable(Ds402Mode::CyclicPosition);
    for (const int mode : {4, 9, 99, -5}) {
        rig.in.mode = static_cast<std::int8_t>(mode);
        rig.run(0.01);
        EXPECT_EQ(rig.out().modeDisplay, 8) << mode;
    }
    EXPECT_EQ(rig.out().refused, 4u);
    rig.in.mode = 0;
    rig.run(0.01);
    EXPECT_EQ(rig.out().modeDisplay, 8) << "0 asks for nothing";
    EXPECT_EQ(rig.out().refused, 4u);
}

TEST(Ds402Drive, TakesParametersAsAWholeOrNotAtAll) {
    DriveRig rig;
    Ds402Parameters parameters;
    parameters.maxVelocity = 3;
    parameters.abortOption = 9;

    EXPECT_FALSE(rig.drive.set(parameters));
    EXPECT_EQ(rig.drive.parameters().maxVelocity, 10);
    parameters.abortOption = 0;
    EXPECT_TRUE(rig.drive.set(parameters));
    EXPECT_EQ(rig.drive.parameters().maxVelocity, 3);
}

TEST(Ds402Drive, IsMadeWithDefaultsForWhatIsNotValid) {
    Ds402Axis axis;
    axis.inertia = -1;
    Ds402Parameters parameters;
    parameters.ratedEffort = 0;
    DriveRig rig{parameters, axis};

    EXPECT_EQ(rig.drive.parameters().ratedEffort, Ds402Parameters{}.ratedEffort);
    rig.turn(1);
}

TEST(Ds402Drive, WiresItsOutputsToItsUpperInputs) {
    DriveRig rig;
    rig.in.digitalOutputs = 0xABCD0005;
    rig.run(1e-3);

    EXPECT_EQ(rig.out().digitalInputs, 0x00050000u);
}

TEST(Ds402Drive, GoesOnByWholeTimeStepsAndKeepsTheRest) {
    DriveRig fine, coarse;
    for (int i = 0; i < 30000; ++i) fine.drive.step(fine.in, 2e-5);
    for (int i = 0; i < 60; ++i) coarse.drive.step(coarse.in, 1e-2);

    EXPECT_EQ(fine.drive.state(), SwitchOnDisabled);
    EXPECT_EQ(fine.out().temperature, coarse.out().temperature);
}

}  // namespace
}  // namespace cortex::drives::test
