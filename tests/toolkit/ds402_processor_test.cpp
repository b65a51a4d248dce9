// SPDX-License-Identifier: Apache-2.0
// Two axes with their drives through startup, faults, safety and loss.
#include "ds402_plant.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

using drives::Ds402State;
using Numbers = std::vector<std::int64_t>;

class TwoDrives : public testing::Test {
protected:
    // The processor alone; the drive device passes words on in every state.
    void startProcessor() { plant_.cluster().send("/it", "startup"); }
    void expectState(State state) { EXPECT_EQ(plant_.state("/it"), state) << plant_.told(); }

    DrivePlant plant_;
};

using ProcessorOfDrives = TwoDrives;

TEST_F(ProcessorOfDrives, LeadsBothAxesToOperationEnabledByTransitions2And3And4) {
    plant_.boot();
    EXPECT_EQ(plant_.item("driveState", 1), 2) << "Switch on disabled";

    startProcessor();
    const Numbers seen = plant_.transitionsWhile(1, 100);

    EXPECT_EQ(seen, (Numbers{2, 3, 4}));
    EXPECT_TRUE(plant_.enabled(1) && plant_.enabled(2));
    EXPECT_EQ(plant_.item("wanted", 2), 5);
    EXPECT_EQ(plant_.item("mode", 2), 8);
    expectState(State::Active);
}

TEST_F(ProcessorOfDrives, FollowsDemandsOnceItIsActive) {
    plant_.begin();

    plant_.moveDemand(1, 0.5);
    plant_.step(100);

    EXPECT_NEAR(plant_.get<double>("/drive/a", "position"), 0.5, 1e-3);
    EXPECT_NEAR(plant_.get<double>("/drive/b", "position"), 0, 1e-3);
}

TEST_F(ProcessorOfDrives, WaitsForADemandThatIsAwayAndTellsIt) {
    plant_.boot();
    plant_.demand(1, 0.5);
    startProcessor();
    plant_.step(1100);

    expectState(State::StartingUp);
    EXPECT_EQ(plant_.driveState(1), Ds402State::SwitchedOn) << "without torque";
    EXPECT_TRUE(plant_.enabled(2));
    EXPECT_TRUE(plant_.hasTold("axis 1 waits for its demand, which is 0.5 away")) << plant_.told();
    EXPECT_NEAR(plant_.place(1), 0, 1e-3);

    plant_.demand(1, 0.005);
    plant_.step(100);

    expectState(State::Active);
}

TEST_F(ProcessorOfDrives, NamesAxisAndStatesWhereAWordIsNotObeyed) {
    plant_.boot();
    plant_.axis(2).deaf = true;
    startProcessor();
    plant_.step(1200);

    expectState(State::Fault);
    EXPECT_EQ(plant_.faultCode(), 32);
    EXPECT_TRUE(plant_.hasTold("axis 2: wanted Ready to switch on, is Switch on disabled"))
        << plant_.told();
    EXPECT_EQ(plant_.item("refusedCount", 2), 1);
    EXPECT_FALSE(plant_.enabled(1)) << "the other one is not left with torque";
}

TEST_F(ProcessorOfDrives, NamesTheModesWhereTheDriveDoesNotShowTheOneThatIsWished) {
    plant_.boot();
    plant_.axis(1).fixedMode = 3;
    startProcessor();
    plant_.step(1200);

    EXPECT_EQ(plant_.faultCode(), 31);
    EXPECT_TRUE(plant_.hasTold("its mode is PV, not CSP")) << plant_.told();
}

TEST_F(ProcessorOfDrives, ShutsDownByTransitions11And12) {
    plant_.begin();

    plant_.cluster().send("/it", "shutdown");
    const Numbers seen = plant_.transitionsWhile(1, 200);

    EXPECT_EQ(seen, (Numbers{11, 12}));
    expectState(State::Standby);
    EXPECT_EQ(plant_.item("wanted", 1), 0);
}

TEST_F(ProcessorOfDrives, BrakesBeforeTheShutdownInMotionIsOver) {
    plant_.begin();
    for (int i = 0; i < 500; ++i) {
        plant_.demand(1, i * 1e-3, 1);
        plant_.step();
    }
    plant_.cluster().send("/it", "shutdown");
    plant_.step(20);
    expectState(State::ShuttingDown);
    plant_.step(500);

    expectState(State::Standby);
    EXPECT_EQ(plant_.driveState(1), Ds402State::SwitchOnDisabled);
    EXPECT_NEAR(plant_.place(1), 0.5 + 0.05, 0.05);
}

TEST_F(ProcessorOfDrives, GoesToFaultWithTheNameOfTheErrorWhereAnAxisLeavesOperationEnabled) {
    plant_.begin();
    const std::int64_t before = plant_.item("transitionCount", 1);
    plant_.axis(1).model.disturbance.load = 40;  // more than the motor has
    Numbers seen = plant_.transitionsWhile(1, 100);
    plant_.axis(1).model.disturbance.load = 0;
    seen.push_back(plant_.transitionsWhile(1, 300).at(0));

    expectState(State::Fault);
    EXPECT_EQ(plant_.faultCode(), 11);
    EXPECT_EQ(plant_.faultText(), "axis 1: following error (0x8611)");
    EXPECT_EQ(seen, (Numbers{13, 14}));
    EXPECT_EQ(plant_.item("errorCode", 1), 0x8611);
    EXPECT_GT(plant_.item("transitionCount", 1), before);
    EXPECT_EQ(plant_.get<std::int64_t>("/set/a", "controlWord"), 2);
    EXPECT_FALSE(plant_.enabled(2));
}

TEST_F(ProcessorOfDrives, ComesBackFromAFaultByClearAndStartup) {
    plant_.begin();
    plant_.axis(1).model.disturbance.load = 40;
    plant_.step(100);
    plant_.axis(1).model.disturbance.load = 0;
    plant_.step(300);
    ASSERT_EQ(plant_.driveState(1), Ds402State::Fault);

    plant_.cluster().send("/it", "clearFaults");
    plant_.step(5);
    expectState(State::Standby);
    EXPECT_EQ(plant_.driveState(1), Ds402State::Fault) << "the startup resets it";
    plant_.demand(1, plant_.get<double>("/drive/a", "position"));
    startProcessor();
    const Numbers seen = plant_.transitionsWhile(1, 300);

    EXPECT_EQ(seen, (Numbers{15, 2, 3, 4}));
    expectState(State::Active);
    EXPECT_EQ(plant_.item("errorCode", 1), 0);
}

TEST_F(ProcessorOfDrives, DoesNotClearAFaultWhileADriveStillReacts) {
    plant_.begin();
    plant_.axis(1).fakeWord = 0x020F;
    plant_.step(3);
    plant_.cluster().send("/it", "clearFaults");
    plant_.step(3);
    expectState(State::Fault);
    EXPECT_TRUE(plant_.hasTold("the fault is not over")) << plant_.told();

    plant_.axis(1).fakeWord = 0x0208;
    plant_.step(3);
    plant_.cluster().send("/it", "clearFaults");
    plant_.step(3);

    expectState(State::Standby);
}

// Somebody has to have seen the fault.
TEST_F(ProcessorOfDrives, DoesNotStartWithAFaultThatNobodyCleared) {
    plant_.boot();
    plant_.axis(1).model.fail(0x2310, false);
    plant_.step(200);
    EXPECT_TRUE(plant_.hasTold("axis 1 reports over-current (0x2310)")) << plant_.told();
    startProcessor();
    plant_.step(5);

    expectState(State::Fault);
    EXPECT_EQ(plant_.faultCode(), 11);
    EXPECT_EQ(plant_.faultText(), "axis 1 is in Fault: over-current (0x2310)");
}

TEST_F(ProcessorOfDrives, FailsTheStartupWhereTheCauseOfAFaultStands) {
    plant_.begin();
    plant_.axis(2).model.fail(0x4310, true);
    plant_.step(200);
    plant_.cluster().send("/it", "clearFaults");
    plant_.step(3);
    startProcessor();
    plant_.step(1300);

    expectState(State::Fault);
    EXPECT_EQ(plant_.faultCode(), 12);
    EXPECT_TRUE(plant_.hasTold("axis 2 is in Fault: drive too hot (0x4310)")) << plant_.told();
}

TEST_F(ProcessorOfDrives, KeepsTheLastStateWhileAStatusWordMeansNoneAndCountsIt) {
    plant_.begin();
    plant_.axis(1).fakeWord = 0x0200 | 0x0011;
    plant_.step(20);

    expectState(State::Active);
    EXPECT_EQ(plant_.item("driveState", 1), 5);
    EXPECT_EQ(plant_.item("unknownCount", 1), 1);
    EXPECT_EQ(plant_.item("unknownCount", 2), 0);
}

TEST_F(ProcessorOfDrives, StopsForTheSafetySystemAndStartsAgainAfterItsReset) {
    plant_.begin();
    plant_.moveDemand(1, 0.1);
    plant_.step(100);
    EXPECT_TRUE(plant_.call("/panel", "press").done());
    plant_.step(200);
    expectState(State::Fault);
    EXPECT_EQ(plant_.faultCode(), 40);
    EXPECT_EQ(plant_.faultText(), "safety stop: emergency stop");
    EXPECT_EQ(plant_.driveState(1), Ds402State::SwitchOnDisabled);

    plant_.cluster().send("/it", "clearFaults");
    plant_.step(3);
    startProcessor();
    plant_.step(3);
    EXPECT_EQ(plant_.faultCode(), 40) << "it is pressed still";

    EXPECT_TRUE(plant_.call("/panel", "release").done());
    EXPECT_TRUE(plant_.call("/panel", "reset").done());
    plant_.cluster().send("/it", "clearFaults");
    plant_.step(3);
    startProcessor();
    plant_.step(200);

    expectState(State::Active);
}

// Nothing is restarted: the drive is back, faults are cleared, and it moves.
TEST_F(ProcessorOfDrives, MovesAgainAfterADriveWasLost) {
    plant_.begin();
    plant_.moveDemand(1, 0.1);
    plant_.step(100);
    plant_.drive().setSilent(true);
    plant_.step(10);
    expectState(State::Fault);
    EXPECT_EQ(plant_.faultCode(), -2);
    plant_.cluster().send("/it", "clearFaults");
    plant_.step(5);
    expectState(State::Fault);

    plant_.drive().setSilent(false);
    plant_.step(200);
    EXPECT_EQ(plant_.driveState(1), Ds402State::SwitchOnDisabled) << "it was told to stop";
    plant_.cluster().send("/it", "clearFaults");
    plant_.step(5);
    startProcessor();
    plant_.step(200);
    expectState(State::Active);
    plant_.moveDemand(1, 0.3);
    plant_.step(100);

    EXPECT_NEAR(plant_.get<double>("/drive/a", "position"), 0.3, 1e-3);
}

TEST_F(ProcessorOfDrives, IsRefusedAStartupWhileADriveIsLost) {
    plant_.boot();
    plant_.drive().setSilent(true);
    plant_.step(3);
    startProcessor();
    plant_.step(3);

    expectState(State::Standby);
    EXPECT_TRUE(plant_.hasTold("startup needs a good observation")) << plant_.told();
}

TEST_F(ProcessorOfDrives, GoesToFaultWhereADriveIsLostInItsStartup) {
    plant_.boot();
    startProcessor();
    plant_.step(5);
    plant_.drive().setSilent(true);
    plant_.step(5);

    expectState(State::Fault);
    EXPECT_EQ(plant_.faultCode(), 30);
}

TEST_F(ProcessorOfDrives, DoesNotWaitForeverForADriveThatIsLostInItsShutdown) {
    plant_.begin();
    plant_.cluster().send("/it", "shutdown");
    plant_.drive().setSilent(true);
    plant_.step(1200);

    expectState(State::Fault);
    EXPECT_EQ(plant_.faultCode(), 31);
    EXPECT_TRUE(plant_.hasTold("axis 1: its drive is lost; it was in Operation enabled"))
        << plant_.told();
    EXPECT_EQ(plant_.item("refusedCount", 1), 0) << "it has refused nothing";
}

TEST_F(ProcessorOfDrives, StopsAxesWhoseDemandsAreLostAndStaysActive) {
    plant_.begin();
    plant_.moveDemand(1, 0.1);
    plant_.step(100);
    plant_.tree().at("/demand/b").slot().quality = Quality::Lost;
    plant_.step(300);
    expectState(State::Active);
    EXPECT_EQ(plant_.driveState(1), Ds402State::SwitchOnDisabled);
    EXPECT_EQ(plant_.driveState(2), Ds402State::SwitchOnDisabled);

    plant_.tree().at("/demand/b").slot().quality = Quality::Good;
    plant_.step(50);
    EXPECT_FALSE(plant_.enabled(1)) << "somebody has to enable it";
    EXPECT_TRUE(plant_.hasTold("enable them")) << plant_.told();
    EXPECT_TRUE(plant_.ask("enable", 0).done());
    plant_.step(100);

    EXPECT_TRUE(plant_.enabled(1) && plant_.enabled(2));
}

TEST_F(ProcessorOfDrives, PassesEachWordOverASlowLink) {
    plant_.boot();
    plant_.drive().setEvery(7);
    startProcessor();
    const Numbers seen = plant_.transitionsWhile(1, 300);

    EXPECT_EQ(seen, (Numbers{2, 3, 4}));
    expectState(State::Active);
}

TEST_F(ProcessorOfDrives, ResetsAFaultOverASlowLink) {
    plant_.begin();
    plant_.drive().setEvery(20);
    plant_.axis(1).model.fail(0x2310, false);
    plant_.step(400);
    plant_.cluster().send("/it", "clearFaults");
    plant_.step(3);
    startProcessor();
    plant_.step(600);

    EXPECT_TRUE(plant_.enabled(1)) << plant_.told();
}

// Between two resets the bit has to be seen low.
TEST_F(ProcessorOfDrives, ResetsAFaultASecondTimeOverASlowLink) {
    plant_.begin();
    plant_.drive().setEvery(20);
    plant_.axis(1).model.fail(0x2310, true);
    plant_.step(400);
    EXPECT_TRUE(plant_.ask("resetFault", 1).done());
    while (plant_.item("refusedCount", 1) == 0) plant_.step();
    plant_.axis(1).model.clearCause();
    EXPECT_TRUE(plant_.ask("resetFault", 1).done());
    plant_.step(200);

    EXPECT_EQ(plant_.driveState(1), Ds402State::SwitchOnDisabled);
    EXPECT_EQ(plant_.get<std::int64_t>("/set/a", "controlWord"), 2);
}

// The shipped drive, and a controller that nobody told of drives.
TEST(ADriveOfTheToolkit, IsLedAndHomedAndMovedByAPoseController) {
    Rig rig;
    rig.add("/axis", "Ds402RotaryObservation");
    rig.add("/demand", "LimitedAxis");
    rig.add("/set", "Ds402RotaryModification");
    rig.add("/it", "Ds402AxisProcessor",
            {{"drives", "/axis"}, {"demands", "/demand"}, {"setpoints", "/set"}});
    rig.add("/drive", "Ds402SimulatedDrive", {{"demands", "/set"}, {"observations", "/axis"}},
            {{"startPosition", "0.7 0"}});
    rig.add("/pose", "AxisPoseController", {{"axes", "/axis"}, {"demands", "/demand"}});
    rig.start();
    rig.startUp();
    std::vector<double> pose(16);
    pose[0] = 0.5;
    EXPECT_TRUE(rig.call("/pose", "set", {{"pose", pose}}).done());
    EXPECT_NE(rig.call("/pose", "moveTo").why.find("its drive says NotHomed"), std::string::npos);
    EXPECT_TRUE(rig.call("/it", "home").done());
    rig.step(2);

    const CallResult answer = rig.call("/pose", "moveTo");
    rig.step(200);

    EXPECT_TRUE(answer.done()) << answer.text();
    EXPECT_NEAR(rig.get<double>("/axis", "position"), 0.5, 1e-3);
    EXPECT_EQ(rig.state("/it"), State::Active);
}

TEST(SafetyPanel, KeepsTheStopUntilItIsReset) {
    DrivePlant plant;
    plant.boot();
    const auto stopped = [&plant] { return plant.get<bool>("/safety", "emergencyStop"); };
    const auto resetNeeded = [&plant] { return plant.get<bool>("/safety", "resetNeeded"); };

    EXPECT_TRUE(plant.call("/panel", "press").done());
    plant.step(2);
    EXPECT_TRUE(stopped());
    EXPECT_FALSE(resetNeeded());
    const CallResult early = plant.call("/panel", "reset");
    EXPECT_EQ(early.outcome, Outcome::Rejected);
    EXPECT_EQ(early.why, "the emergency stop button is pressed: release it first");

    EXPECT_TRUE(plant.call("/panel", "release").done());
    plant.step(2);
    EXPECT_TRUE(stopped() && resetNeeded());

    EXPECT_TRUE(plant.call("/panel", "reset").done());
    plant.step(2);
    EXPECT_FALSE(stopped() || resetNeeded());
}

}  // namespace
}  // namespace cortex::toolkit::test
