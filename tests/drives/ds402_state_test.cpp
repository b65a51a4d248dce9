// SPDX-License-Identifier: Apache-2.0
#include "drives/drive_rig.hpp"

#include <map>
#include <set>
#include <string>

namespace cortex::drives::test {
namespace {

using enum Ds402State;

// The state diagram of CiA 402 by bits, where the product has masks. Columns: what is left of a
// word without bit 7 is no voltage, quick stop, shutdown, switch on, enable operation.
struct Diagram {
    Ds402State from;
    Ds402State to[5];
};

constexpr Diagram diagram[] = {
    {NotReadyToSwitchOn,
     {NotReadyToSwitchOn, NotReadyToSwitchOn, NotReadyToSwitchOn, NotReadyToSwitchOn,
      NotReadyToSwitchOn}},
    {SwitchOnDisabled,
     {SwitchOnDisabled, SwitchOnDisabled, ReadyToSwitchOn, SwitchOnDisabled, SwitchOnDisabled}},
    {ReadyToSwitchOn,
     {SwitchOnDisabled, SwitchOnDisabled, ReadyToSwitchOn, SwitchedOn, OperationEnabled}},
    {SwitchedOn,
     {SwitchOnDisabled, SwitchOnDisabled, ReadyToSwitchOn, SwitchedOn, OperationEnabled}},
    {OperationEnabled,
     {SwitchOnDisabled, QuickStopActive, ReadyToSwitchOn, SwitchedOn, OperationEnabled}},
    {QuickStopActive,
     {SwitchOnDisabled, QuickStopActive, QuickStopActive, QuickStopActive, OperationEnabled}},
    {FaultReactionActive,
     {FaultReactionActive, FaultReactionActive, FaultReactionActive, FaultReactionActive,
      FaultReactionActive}},
    {Fault, {Fault, Fault, Fault, Fault, Fault}},
};

Ds402State expected(const Diagram& row, int word) {
    if (word >> 7 & 1) return row.from == Fault ? SwitchOnDisabled : row.from;
    if (!(word >> 1 & 1)) return row.to[0];
    if (!(word >> 2 & 1)) return row.to[1];
    if (!(word & 1)) return row.to[2];
    return row.to[word >> 3 & 1 ? 4 : 3];
}

// A drive in this state that stays there by itself for 10 ms.
Ds402Drive driveIn(Ds402State state, int quickStopOption) {
    Ds402Axis axis;
    axis.brakeTime = 1e-3;
    if (state == NotReadyToSwitchOn) axis.selfTestTime = 100;
    Ds402Parameters parameters;
    parameters.quickStopOption = quickStopOption;
    parameters.quickStopDeceleration = 2;
    DriveRig rig{parameters, axis};
    rig.run(0.6);
    if (state == SwitchOnDisabled || state == NotReadyToSwitchOn) return rig.drive;
    rig.send(6);
    if (state >= SwitchedOn) rig.send(7);
    if (state == OperationEnabled) rig.send(15, 0.1);
    if (state > OperationEnabled) rig.turn(1);
    if (state == QuickStopActive) rig.send(2);
    if (state > QuickStopActive) rig.drive.fail(0xFF01, false);
    rig.run(state == Fault ? 1 : 1e-3);
    EXPECT_EQ(rig.drive.state(), state);
    return rig.drive;
}

// How many of the 256 words end elsewhere than the diagram says, first of all which.
std::string differences(const Diagram& row, int quickStopOption) {
    const Ds402Drive prepared = driveIn(row.from, quickStopOption);
    std::string text;
    for (int word = 0; word < 256; ++word) {
        DriveRig rig;
        rig.drive = prepared;
        rig.in.controlWord = static_cast<std::uint16_t>(word);
        rig.run(7e-3);
        if (rig.drive.state() != expected(row, word))
            text += std::string(nameOf(row.from)) + ", word " + std::to_string(word) + ": " +
                    std::string(nameOf(rig.drive.state())) + "\n";
    }
    return text;
}

TEST(Ds402States, AreReachedByEveryLowOctetOfTheControlWordAsTheDiagramSays) {
    for (const Diagram& row : diagram) EXPECT_EQ(differences(row, 6), "");
}

TEST(Ds402States, AreNotLeftForOperationAfterAQuickStopThatEndsWithoutPower) {
    Diagram row = diagram[5];
    row.to[4] = QuickStopActive;

    EXPECT_EQ(differences(row, 2), "");
}

TEST(Ds402StatusWords, FitNoTwoStates) {
    int without = 0;
    for (int word = 0; word < 128; ++word) {
        int fitting = 0;
        for (const Ds402StateRow& row : ds402States) fitting += (word & row.mask) == row.value;
        EXPECT_LE(fitting, 1) << word;
        without += stateOf(static_cast<std::uint16_t>(word)) == Unknown;
        EXPECT_EQ(stateOf(static_cast<std::uint16_t>(word)) == Unknown, fitting == 0) << word;
    }
    EXPECT_EQ(without, 104);
}

TEST(Ds402StatusWords, TellTheStateThatMakersPrintThemFor) {
    const std::map<int, Ds402State> typical{{0x0000, NotReadyToSwitchOn},
                                            {0x0250, SwitchOnDisabled},
                                            {0x0231, ReadyToSwitchOn},
                                            {0x0233, SwitchedOn},
                                            {0x0237, OperationEnabled},
                                            {0x0217, QuickStopActive},
                                            {0x021F, FaultReactionActive},
                                            {0x0218, Fault},
                                            {0x0238, Fault},
                                            {0x0270, SwitchOnDisabled},
                                            {0x1637, OperationEnabled},
                                            {0xFFBF, FaultReactionActive}};

    for (const auto& [word, state] : typical)
        EXPECT_EQ(stateOf(static_cast<std::uint16_t>(word)), state) << word;
}

TEST(Ds402ControlWords, AreAtMostOneCommandAndNoneWithBit7) {
    std::map<Ds402Command, int> count;
    for (int word = 0; word < 256; ++word) {
        int fitting = 0;
        for (const Ds402CommandRow& row : ds402Commands)
            fitting += row.mask != 0 && (word & row.mask) == row.value;
        EXPECT_LE(fitting, 1) << word;
        ++count[commandOf(static_cast<std::uint16_t>(word))];
    }
    EXPECT_EQ(count[Ds402Command::None], 128);
    EXPECT_EQ(count[Ds402Command::DisableVoltage], 64);
    EXPECT_EQ(count[Ds402Command::QuickStop], 32);
    EXPECT_EQ(count[Ds402Command::Shutdown], 16);
    EXPECT_EQ(count[Ds402Command::SwitchOn], 8);
    EXPECT_EQ(count[Ds402Command::EnableOperation], 8);
}

TEST(Ds402ControlWords, ResetAFaultByTheRisingEdgeAlone) {
    EXPECT_TRUE(isFaultReset(0x0000, 0x0080));
    EXPECT_TRUE(isFaultReset(0x000F, 0x008F));
    EXPECT_FALSE(isFaultReset(0x0080, 0x0080));
    EXPECT_FALSE(isFaultReset(0x0080, 0x0000));
}

TEST(Ds402Transitions, HaveTheNumbersZeroTo16) {
    std::set<int> numbers;
    for (const Ds402Transition& row : ds402Transitions) numbers.insert(row.number);

    EXPECT_EQ(numbers.size(), static_cast<std::size_t>(ds402TransitionNumbers));
    EXPECT_EQ(*numbers.begin(), 0);
    EXPECT_EQ(*numbers.rbegin(), 16);
}

TEST(Ds402Transitions, SayWhyTheyCannotBeAskedFor) {
    EXPECT_EQ(whyNot(SwitchOnDisabled, 2, 2), "");
    EXPECT_EQ(whyNot(ReadyToSwitchOn, 7, 2), "");
    EXPECT_EQ(whyNot(SwitchOnDisabled, 4, 2),
              "Transition 4 begins in Switched on, the drive is in Switch on disabled; what can be "
              "asked for here is 2 (shutdown, 0x0006).");
    EXPECT_EQ(
        whyNot(FaultReactionActive, 15, 2),
        "Transition 15 begins in Fault, the drive is in Fault reaction active; nothing can be "
        "asked for here; wait.");
    EXPECT_EQ(whyNot(SwitchedOn, 13, 2),
              "Transition 13 cannot be asked for: its cause is a fault.");
    EXPECT_EQ(whyNot(Fault, 17, 2), "There is no transition 17; they are 0 to 16.");
    EXPECT_EQ(whyNot(Unknown, 2, 2),
              "The state of the drive is not known; wait until its status word tells one.");
}

TEST(Ds402Transitions, SayThatOneNeedsAnOptionOfTheQuickStop) {
    EXPECT_EQ(whyNot(QuickStopActive, 16, 5), "");
    EXPECT_EQ(whyNot(QuickStopActive, 16, 2),
              "Transition 16 needs quick stop option 5 to 8, the option is 2; change it, or enable "
              "again from the start.");
}

}  // namespace
}  // namespace cortex::drives::test
