// SPDX-License-Identifier: Apache-2.0
// The commands of a processor of drives: what each does, and the words in which it is refused.
#include "ds402_plant.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

using drives::Ds402State;
using Numbers = std::vector<std::int64_t>;
using Arguments = Rig::Arguments;

class DriveCommands : public testing::Test {
protected:
    void begin(const std::string& quickStopOption = "2 2") {
        plant_.emplace(PlantOptions{.quickStopOption = quickStopOption});
        plant_->begin();
    }
    DrivePlant& plant() { return *plant_; }
    CallResult ask(const std::string& command, std::int64_t axis) {
        return plant_->ask(command, axis);
    }
    CallResult step(std::int64_t axis, std::int64_t word) {
        return plant_->ask("step", {{"axis", axis}, {"word", word}});
    }
    CallResult setMode(std::int64_t axis, std::int64_t mode) {
        return plant_->ask("setMode", {{"axis", axis}, {"mode", mode}});
    }
    void expectRejected(const CallResult& answer, const std::string& words) {
        EXPECT_EQ(answer.outcome, Outcome::Rejected) << answer.text();
        EXPECT_NE(answer.why.find(words), std::string::npos) << answer.why;
    }
    void expectState(int axis, Ds402State state) {
        EXPECT_EQ(plant().driveState(axis), state)
            << "is " << nameOf(plant().driveState(axis)) << "\n"
            << plant().told();
    }
    std::optional<DrivePlant> plant_;
};

TEST_F(DriveCommands, DisableOneAxisByTransition5AndEnableItAgain) {
    begin();
    EXPECT_TRUE(ask("disable", 1).done());
    EXPECT_EQ(plant().transitionsWhile(1, 200), Numbers{5});
    expectState(1, Ds402State::SwitchedOn);
    expectState(2, Ds402State::OperationEnabled);
    EXPECT_EQ(plant().state("/it"), State::Active);

    EXPECT_TRUE(ask("enable", 1).done());
    EXPECT_EQ(plant().transitionsWhile(1, 200), Numbers{4});
}

TEST_F(DriveCommands, DisableRejectsAnAxisThatIsNotEnabledAndTakesTheOtherOne) {
    begin();
    EXPECT_TRUE(ask("disable", 1).done());
    plant().step(200);
    expectRejected(ask("disable", 1), "axis 1 is in Switched on, not in Operation enabled");

    EXPECT_TRUE(ask("disable", 0).done());
    plant().step(200);
    expectState(2, Ds402State::SwitchedOn);
    expectRejected(ask("disable", 0), "not in Operation enabled");
}

TEST_F(DriveCommands, EnableRejectsADemandThatIsAwayWithNumbers) {
    begin();
    EXPECT_TRUE(ask("disable", 1).done());
    plant().step(200);
    plant().demand(1, 0.5);
    plant().step(2);

    expectRejected(ask("enable", 1), "axis 1: its demand is 0.5 away from it, allowed is 0.01");
    expectRejected(ask("enable", 0), "axis 1");

    plant().demand(1, 0.001);
    plant().step(2);
    EXPECT_TRUE(ask("enable", 1).done());
}

TEST_F(DriveCommands, EnableRejectsAnAxisInFaultWithTheWayOut) {
    begin();
    EXPECT_TRUE(ask("disable", 1).done());
    plant().step(200);
    plant().axis(1).model.fail(0x2310, false);
    plant().step(100);
    EXPECT_EQ(plant().state("/it"), State::Active) << "the other axis goes on";

    expectRejected(ask("enable", 1),
                   "axis 1 is in Fault: over-current (0x2310); send resetFault first");

    EXPECT_TRUE(ask("resetFault", 1).done());
    EXPECT_EQ(plant().transitionsWhile(1, 200), Numbers{15});
    EXPECT_TRUE(ask("enable", 1).done());
    EXPECT_EQ(plant().transitionsWhile(1, 200), (Numbers{2, 3, 4}));
}

TEST_F(DriveCommands, ResetFaultIsRejectedWithoutAFaultAndTellsWhereTheCauseStands) {
    begin();
    expectRejected(ask("resetFault", 1), "axis 1 is in Operation enabled, not in Fault");
    expectRejected(ask("resetFault", 0), "axis 1 is in Operation enabled, not in Fault; axis 2 is");
    plant().axis(2).model.fail(0x3210, true);
    plant().step(200);
    EXPECT_EQ(plant().state("/it"), State::Fault);

    EXPECT_TRUE(ask("resetFault", 0).done());
    plant().step(1200);
    EXPECT_TRUE(plant().hasTold("axis 2 is in Fault: link voltage too high (0x3210)"));
    expectState(2, Ds402State::Fault);

    plant().axis(2).model.clearCause();
    EXPECT_TRUE(ask("resetFault", 2).done());
    plant().step(200);
    expectState(2, Ds402State::SwitchOnDisabled);
    EXPECT_EQ(plant().state("/it"), State::Fault) << "that is cleared by clearFaults";
}

TEST_F(DriveCommands, QuickStopIsTransition11And12AndNoFault) {
    begin();
    for (int i = 0; i < 300; ++i) {
        plant().demand(1, i * 1e-3, 1);
        plant().step();
    }
    EXPECT_TRUE(ask("quickStop", 1).done());
    EXPECT_EQ(plant().transitionsWhile(1, 500), (Numbers{11, 12}));

    EXPECT_EQ(plant().state("/it"), State::Active);
    expectState(2, Ds402State::OperationEnabled);
    EXPECT_LT(plant().place(1), 0.4);
}

TEST_F(DriveCommands, QuickStopWithOption5StaysAndEnableIsTransition16) {
    begin("5 2");
    EXPECT_TRUE(ask("quickStop", 1).done());
    EXPECT_EQ(plant().transitionsWhile(1, 300), Numbers{11});
    expectState(1, Ds402State::QuickStopActive);

    EXPECT_TRUE(ask("enable", 1).done());
    EXPECT_EQ(plant().transitionsWhile(1, 300), Numbers{16});
    expectState(1, Ds402State::OperationEnabled);
}

TEST_F(DriveCommands, ShutdownAfterAQuickStopThatStaysTakesThePowerAway) {
    begin("6 6");
    plant().cluster().send("/it", "shutdown");
    EXPECT_EQ(plant().transitionsWhile(1, 400), (Numbers{11, 12}));

    EXPECT_EQ(plant().state("/it"), State::Standby);
    expectState(1, Ds402State::SwitchOnDisabled);
}

TEST_F(DriveCommands, QuickStopEndsAStartup) {
    plant_.emplace();
    plant().boot();
    plant().cluster().send("/it", "startup");
    plant().step(3);
    EXPECT_TRUE(ask("quickStop", 2).done());
    plant().step(5);

    EXPECT_EQ(plant().state("/it"), State::Fault);
    EXPECT_EQ(plant().faultCode(), 32);
    EXPECT_EQ(plant().faultText(), "axis 2: a quick stop ended the startup");
}

TEST_F(DriveCommands, StepGoesOneTransitionAtATimeInStandby) {
    plant_.emplace();
    plant().boot();
    const auto goes = [this](std::int64_t word, std::int64_t number) {
        EXPECT_TRUE(step(1, word).done());
        EXPECT_EQ(plant().transitionsWhile(1, 60), Numbers{number}) << word;
    };
    goes(1, 2);
    goes(2, 3);
    goes(1, 6);
    goes(3, 7);
    goes(1, 2);
    goes(2, 3);
    goes(4, 10);
}

TEST_F(DriveCommands, StepIsRejectedWithTheReasonOfTheStateMachine) {
    plant_.emplace();
    plant().boot();
    expectRejected(step(1, 2),
                   "Transition 3 begins in Ready to switch on, the drive is in "
                   "Switch on disabled");
    expectRejected(step(1, 5), "Transition 5 begins in Operation enabled");
    expectRejected(step(1, 7), "Transition 15 begins in Fault");
    EXPECT_TRUE(step(1, 1).done());
    plant().step(20);
    EXPECT_TRUE(step(1, 2).done());
    plant().step(20);

    expectRejected(step(1, 6), "in Standby targets are safe ones");
    expectState(1, Ds402State::SwitchedOn);
}

TEST_F(DriveCommands, StepInActiveIsNoFault) {
    begin();
    EXPECT_TRUE(step(1, 1).done());
    EXPECT_EQ(plant().transitionsWhile(1, 200), Numbers{8});
    EXPECT_TRUE(step(1, 6).done());
    EXPECT_EQ(plant().transitionsWhile(1, 200), (Numbers{3, 4}));
    EXPECT_TRUE(step(1, 5).done());
    EXPECT_EQ(plant().transitionsWhile(1, 200), Numbers{5});

    EXPECT_EQ(plant().state("/it"), State::Active);
}

TEST_F(DriveCommands, StepThatIsNotObeyedIsCountedAndTheWordGoesBackToAQuickStop) {
    begin();
    EXPECT_TRUE(ask("disable", 1).done());
    plant().step(200);
    plant().axis(1).deaf = true;
    EXPECT_TRUE(step(1, 1).done());
    plant().step(1200);

    EXPECT_TRUE(plant().hasTold("axis 1: wanted Ready to switch on, is Switched on"));
    EXPECT_EQ(plant().item("refusedCount", 1), 1);
    EXPECT_EQ(plant().get<std::int64_t>("/set/a", "controlWord"), 2);
    EXPECT_EQ(plant().state("/it"), State::Active);
}

TEST_F(DriveCommands, SetModeIsRejectedInMotionAndChangesAtStandstill) {
    begin();
    for (int i = 0; i < 200; ++i) {
        plant().demand(1, i * 1e-3, 1);
        plant().step();
    }
    expectRejected(setMode(1, 9), "its mode changes at standstill only");
    EXPECT_TRUE(setMode(1, 8).done()) << "it is there already";
    plant().moveDemand(1, 0.25);
    plant().step(200);

    EXPECT_TRUE(setMode(1, 9).done());
    plant().step(20);
    EXPECT_EQ(plant().item("mode", 1), 9);
    plant().demand(1, 0.25, 0.5);
    plant().step(300);
    EXPECT_NEAR(plant().get<double>("/drive/a", "velocity"), 0.5, 0.05);
}

TEST_F(DriveCommands, SetModeInStandbyGoesOutWithTheStartup) {
    plant_.emplace();
    plant().boot();
    EXPECT_TRUE(setMode(0, 3).done());
    plant().cluster().send("/it", "startup");
    plant().step(200);

    EXPECT_EQ(plant().state("/it"), State::Active);
    EXPECT_EQ(plant().item("mode", 1), 3);
    EXPECT_EQ(plant().item("mode", 2), 3);
}

TEST_F(DriveCommands, SetModeThatTheDriveDoesNotTakeGoesBack) {
    begin();
    plant().axis(1).fixedMode = 8;
    EXPECT_TRUE(setMode(1, 10).done());
    plant().step(1200);

    EXPECT_TRUE(plant().hasTold("axis 1: wanted the mode CST, it is CSP")) << plant().told();
    EXPECT_EQ(plant().get<std::int64_t>("/set/a", "mode"), 8);
    EXPECT_EQ(plant().item("refusedCount", 1), 1);
}

TEST_F(DriveCommands, ProfilePositionHandsOverEachNewTarget) {
    begin();
    EXPECT_TRUE(setMode(1, 1).done());
    plant().step(50);
    EXPECT_EQ(plant().item("mode", 1), 1);
    plant().demand(1, 0.3);
    plant().step(1200);
    EXPECT_NEAR(plant().place(1), 0.3, 2e-3);

    plant().demand(1, 0.1);
    plant().step(1200);
    EXPECT_NEAR(plant().place(1), 0.1, 2e-3);
}

TEST_F(DriveCommands, AnAxisThatIsNotThereIsRejected) {
    plant_.emplace(PlantOptions{.axes = 1});
    plant().begin();
    const CallResult answer = ask("enable", 2);

    EXPECT_EQ(answer.reason, Reason::Range);
    EXPECT_EQ(answer.why, "there is no axis 2, there is 1");
    EXPECT_TRUE(ask("enable", 0).done());
}

}  // namespace
}  // namespace cortex::toolkit::test
