// SPDX-License-Identifier: Apache-2.0
#include "cortex/drives/ds402_words.hpp"

#include "cortex/drives/ds402_parameters.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace cortex::drives::test {
namespace {

TEST(Ds402Names, OfErrorsNameTheirCode) {
    EXPECT_EQ(errorName(0), "no error");
    EXPECT_EQ(errorName(0x8611), "following error (0x8611)");
    EXPECT_EQ(errorName(0xFF07), "error of the maker (0xFF07)");
    EXPECT_EQ(errorName(0x1234), "error 0x1234");
    EXPECT_EQ(errorName(-1), "error 0xFFFF");
}

TEST(Ds402Names, OfModesNameTheirLetters) {
    EXPECT_EQ(modeName(8), "cyclic synchronous position (CSP)");
    EXPECT_EQ(modeName(0), "none");
    EXPECT_EQ(modeName(-3), "mode -3");
}

TEST(Ds402Modes, AreBuiltForSixOfNine) {
    for (const int mode : {1, 3, 6, 8, 9, 10}) EXPECT_TRUE(isBuilt(mode)) << mode;
    for (const int mode : {-1, 0, 2, 4, 5, 7, 11}) EXPECT_FALSE(isBuilt(mode)) << mode;
    EXPECT_EQ(ds402BuiltModes, 0x3A5u);  // bits 0, 2, 5, 7, 8, 9
}

TEST(Ds402Modes, SayWhyADriveCannotBeSetToThem) {
    EXPECT_EQ(whyNotMode(8), "");
    EXPECT_EQ(whyNotMode(4, 0x85),
              "Mode 4, profile torque (PT), is not built; there are 1 profile position (PP), 3 "
              "profile velocity (PV), 8 cyclic synchronous position (CSP).");
    EXPECT_EQ(whyNotMode(6, 0x80),
              "Mode 6, homing (HM), is not known to this drive; there are 8 cyclic synchronous "
              "position (CSP).");
    EXPECT_EQ(whyNotMode(99, 0), "Mode 99 is not built; there are none.");
}

TEST(Ds402StatusWord, TellsHowHomingGoesByThreeBits) {
    EXPECT_EQ(homingOf(0x0237), Ds402Homing::Runs);
    EXPECT_EQ(homingOf(0x0637), Ds402Homing::NotStarted);
    EXPECT_EQ(homingOf(0x1237), Ds402Homing::AttainedButMoving);
    EXPECT_EQ(homingOf(0x1637), Ds402Homing::Done);
    EXPECT_EQ(homingOf(0x2237), Ds402Homing::ErrorMoving);
    EXPECT_EQ(homingOf(0x2637), Ds402Homing::Error);
}

TEST(Ds402Options, HaveTheValuesThatAreBuilt) {
    EXPECT_TRUE(isOption(0x605A, 0));
    EXPECT_TRUE(isOption(0x605A, 8));
    EXPECT_FALSE(isOption(0x605A, 9));
    EXPECT_FALSE(isOption(0x605A, -1));
    EXPECT_FALSE(isOption(0x605D, 0));
    EXPECT_FALSE(isOption(0x6007, 4));
    EXPECT_FALSE(isOption(0x6064, 0));
}

TEST(Ds402Parameters, AreValidAsTheyAreMade) {
    EXPECT_TRUE(isValid(Ds402Parameters{}));
    EXPECT_EQ(whyNot(Ds402Parameters{}), "");
    EXPECT_TRUE(isValid(Ds402Axis{}));
}

TEST(Ds402Parameters, SayWhatIsWrongAndWhatCanBe) {
    Ds402Parameters wrong;
    wrong.quickStopOption = 9;
    EXPECT_FALSE(isValid(wrong));
    EXPECT_EQ(whyNot(wrong),
              "The quick stop option is 9; it can be: 0 power off, 1 slow ramp, 2 to 4 quick ramp, "
              "5 slow ramp and stay, 6 to 8 quick ramp and stay.");
    wrong = {};
    wrong.profileAcceleration = 0;
    EXPECT_FALSE(isValid(wrong));
    EXPECT_EQ(whyNot(wrong), "The profile acceleration (6083) is 0; give a number above 0.");
    wrong = {};
    wrong.homeOffset = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(isValid(wrong));
    EXPECT_EQ(whyNot(wrong), "The home offset (607C) is nan; give a number from -1e+12 to 1e+12.");
    wrong = {};
    wrong.softMin = 1;
    EXPECT_FALSE(isValid(wrong));
    EXPECT_EQ(whyNot(wrong),
              "The least position (607D:1) is above the greatest (607D:2); exchange them, or set "
              "both to 0 for no limits.");
    wrong = {};
    wrong.supportedModes = 0x82;
    EXPECT_FALSE(isValid(wrong));
    EXPECT_NE(whyNot(wrong).find("supported modes (6502) name one that is not built"),
              std::string::npos);
}

TEST(Ds402Axis, IsNotValidWithSwitchesInTheWrongOrder) {
    Ds402Axis axis;
    axis.negativeSwitch = 1;
    axis.positiveSwitch = -1;
    EXPECT_FALSE(isValid(axis));
    axis = {};
    axis.inertia = 0;
    EXPECT_FALSE(isValid(axis));
    axis = {};
    axis.negativeSwitch = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(isValid(axis));
}

}  // namespace
}  // namespace cortex::drives::test
