// SPDX-License-Identifier: Apache-2.0
#include "drives/drive_rig.hpp"

#include <ostream>

namespace cortex::drives::test {
namespace {

// Switches at -0.3 and 0.3, an index each 0.06 with one at 0.
struct Case {
    int method;
    double start;  // where the axis is first
    double place;  // of the mechanism that becomes `homeOffset`
};

void PrintTo(const Case& each, std::ostream* out) {
    *out << "method " << each.method << " from " << each.start;
}

DriveRig rigAt(double start, int method, double homeOffset = 0) {
    Ds402Axis axis;
    axis.negativeSwitch = -0.3;
    axis.positiveSwitch = 0.31;
    axis.indexDistance = 0.06;
    axis.startPosition = start;
    Ds402Parameters parameters;
    parameters.homingMethod = method;
    parameters.homeOffset = homeOffset;
    return DriveRig{parameters, axis};
}

// Until homing has ended, at most 10 s.
void home(DriveRig& rig) {
    rig.enable(Ds402Mode::Homing);
    ASSERT_EQ(homingOf(rig.out().statusWord), Ds402Homing::NotStarted);
    rig.send(0x001F);
    for (int i = 0; i < 1000; ++i) {
        const Ds402Homing now = homingOf(rig.out().statusWord);
        if (now == Ds402Homing::Done || now == Ds402Homing::Error) return;
        rig.run(0.01);
    }
}

class Ds402HomingMethod : public testing::TestWithParam<Case> {};

TEST_P(Ds402HomingMethod, FindsItsPlaceAndGivesItTheOffset) {
    DriveRig rig = rigAt(GetParam().start, GetParam().method, 2.5);
    rig.drive.disturbance.friction = 0.1;

    home(rig);

    EXPECT_EQ(homingOf(rig.out().statusWord), Ds402Homing::Done);
    EXPECT_TRUE(rig.out().homed);
    EXPECT_NEAR(rig.out().position - 2.5, rig.drive.place() - GetParam().place, 2e-5);
    EXPECT_NEAR(rig.drive.place(), GetParam().place, 1e-3) << "it has stopped close to it";
    EXPECT_EQ(rig.drive.state(), Ds402State::OperationEnabled);
}

INSTANTIATE_TEST_SUITE_P(FromBothSides, Ds402HomingMethod,
                         testing::Values(Case{1, 0, -0.24}, Case{1, -0.35, -0.24}, Case{2, 0, 0.3},
                                         Case{2, 0.36, 0.3}, Case{17, 0, -0.3},
                                         Case{17, -0.35, -0.3}, Case{18, 0, 0.31},
                                         Case{18, 0.36, 0.31}, Case{33, 0.1, 0.06},
                                         Case{33, -0.01, -0.06}, Case{34, 0.1, 0.12},
                                         Case{34, -0.01, 0}, Case{35, 0.2, 0.2},
                                         Case{37, -0.2, -0.2}));

TEST(Ds402Homing, EndsInAnErrorForEachMethodThatIsNotBuilt) {
    for (int method = -5; method <= 40; ++method) {
        if (isHomingMethod(method)) continue;
        DriveRig rig = rigAt(0, method);
        home(rig);
        EXPECT_EQ(homingOf(rig.out().statusWord), Ds402Homing::Error) << method;
        EXPECT_FALSE(rig.out().homed);
        EXPECT_EQ(rig.drive.place(), 0);
    }
}

TEST(Ds402Homing, KnowsEightMethods) {
    int known = 0;
    for (int method = -200; method < 200; ++method) known += isHomingMethod(method);

    EXPECT_EQ(known, 8);
}

TEST(Ds402Homing, EndsInAnErrorWhereTheIndexIsMissing) {
    DriveRig rig;
    Ds402Parameters parameters;
    parameters.homingMethod = 34;
    rig.drive = Ds402Drive{{}, parameters};
    home(rig);

    EXPECT_EQ(homingOf(rig.out().statusWord), Ds402Homing::Error);
}

TEST(Ds402Homing, EndsInAnErrorAtTheStopBehindASwitchThatDoesNotClose) {
    DriveRig rig = rigAt(0, 17);
    rig.drive.disturbance.stuckOff = 1;
    home(rig);

    EXPECT_EQ(homingOf(rig.out().statusWord), Ds402Homing::Error);
    EXPECT_NEAR(rig.drive.place(), -0.4, 1e-3);
}

TEST(Ds402Homing, EndsInAnErrorAtTheOtherSwitchWhereItsOwnDoesNotOpen) {
    DriveRig rig = rigAt(0.25, 17);
    rig.drive.disturbance.stuckOn = 1;
    home(rig);

    EXPECT_EQ(homingOf(rig.out().statusWord), Ds402Homing::Error);
    EXPECT_NEAR(rig.drive.place(), 0.31, 1e-2);
    EXPECT_EQ(rig.out().digitalInputs, 3u);
}

TEST(Ds402Homing, EndsInAnErrorWhereTheRotorIsBlocked) {
    DriveRig rig = rigAt(0, 33);
    rig.drive.disturbance.blockedRotor = true;
    home(rig);

    EXPECT_EQ(homingOf(rig.out().statusWord), Ds402Homing::Error);
}

TEST(Ds402Homing, TellsThatItRunsAndIsInterruptedByBit4) {
    DriveRig rig = rigAt(0, 17);
    rig.enable(Ds402Mode::Homing);
    rig.send(0x001F, 0.1);
    EXPECT_EQ(homingOf(rig.out().statusWord), Ds402Homing::Runs);
    rig.send(0x000F, 0.5);
    EXPECT_EQ(homingOf(rig.out().statusWord), Ds402Homing::NotStarted);
    EXPECT_FALSE(rig.out().homed);
    const double place = rig.drive.place();
    rig.run(1);
    EXPECT_NEAR(rig.drive.place(), place, 1e-4);
    rig.send(0x001F, 5);
    EXPECT_EQ(homingOf(rig.out().statusWord), Ds402Homing::Done) << "it begins anew";
}

TEST(Ds402Homing, GoesOnAfterAHalt) {
    DriveRig rig = rigAt(0, 17);
    rig.enable(Ds402Mode::Homing);
    rig.send(0x001F, 0.2);
    rig.send(0x011F, 0.5);
    EXPECT_EQ(homingOf(rig.out().statusWord), Ds402Homing::NotStarted);
    EXPECT_TRUE(rig.bit(Ds402Status::targetReached)) << "it stands";
    rig.send(0x001F, 5);
    EXPECT_EQ(homingOf(rig.out().statusWord), Ds402Homing::Done);
}

TEST(Ds402Homing, IsClearedWhenItBeginsAndWhenAFaultEndsIt) {
    DriveRig rig = rigAt(0, 37);
    home(rig);
    ASSERT_TRUE(rig.out().homed);
    Ds402Parameters parameters = rig.drive.parameters();
    parameters.homingMethod = 18;
    ASSERT_TRUE(rig.drive.set(parameters));
    rig.send(0x000F);
    rig.send(0x001F, 0.2);
    EXPECT_FALSE(rig.out().homed);
    rig.drive.fail(0x2310, false);
    rig.run(1);
    rig.send(0x0080);
    rig.send(0x0006);
    rig.send(0x001F, 1);
    EXPECT_EQ(rig.drive.state(), Ds402State::OperationEnabled);
    EXPECT_EQ(homingOf(rig.out().statusWord), Ds402Homing::NotStarted);
    EXPECT_FALSE(rig.out().homed);
}

}  // namespace
}  // namespace cortex::drives::test
