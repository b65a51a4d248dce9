// SPDX-License-Identifier: Apache-2.0
// Homing by a processor, and what an axis may do that is not homed.
#include "ds402_plant.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

using drives::Ds402State;
using Arguments = Rig::Arguments;

class Homing : public testing::Test {
protected:
    // `method` of both axes; 17: the edge of the negative limit switch, at -0.05.
    void begin(std::int64_t method, bool jogs = false, double speed = 0.5, double offset = 0.2) {
        plant_.emplace(PlantOptions{.homingNeeded = true, .jogs = jogs});
        plant().boot();
        EXPECT_TRUE(plant()
                        .ask("set", {{"homingMethod", std::vector<std::int64_t>{method, 37}},
                                     {"homeOffset", std::vector<double>{offset, 0.0}},
                                     {"homingSpeed", std::vector<double>{speed, 0.5}}})
                        .done());
        plant().startUp();
    }
    DrivePlant& plant() { return *plant_; }
    CallResult home(std::int64_t axis, double timeout = 120) {
        return plant().ask("home", {{"axis", axis}, {"timeout", timeout}});
    }
    std::uint64_t beginHome(std::int64_t axis, double timeout = 120) {
        return plant().cluster().send("/it", "home", {{"axis", axis}, {"timeout", timeout}});
    }
    bool homed(int number) {
        return std::get<std::vector<bool>>(
            plant().cluster().image().value("/it", "homed"))[static_cast<std::size_t>(number - 1)];
    }
    std::int64_t outcome() { return plant().get<std::int64_t>("/it", "outcome"); }
    // Steps until the command has ended.
    std::int64_t end() {
        plant().step(10);
        for (int i = 0; i < 8000 && outcome() == 2; ++i) plant().step();
        return outcome();
    }
    std::int64_t mode() { return plant().item("mode", 1); }

    std::optional<DrivePlant> plant_;
};

TEST_F(Homing, WhereItStandsIsDoneAndGoesBackToTheModeBefore) {
    begin(37);
    EXPECT_FALSE(homed(1));

    const CallResult answer = home(2);

    EXPECT_TRUE(answer.done()) << answer.text();
    EXPECT_TRUE(homed(2));
    EXPECT_FALSE(homed(1));
    EXPECT_EQ(plant().item("mode", 2), 8);
    EXPECT_EQ(plant().state("/it"), State::Active);
}

TEST_F(Homing, ByALimitSwitchPassesThroughItsPhasesWithProgress) {
    begin(17);
    beginHome(1);
    plant().step(200);
    EXPECT_EQ(mode(), 6);
    EXPECT_EQ(outcome(), 2) << "Running";
    const double early = plant().get<double>("/it", "progress");
    EXPECT_GT(early, 0);
    EXPECT_LT(early, 1);

    EXPECT_EQ(end(), 1) << plant().told();
    EXPECT_EQ(plant().get<double>("/it", "progress"), 1);
    EXPECT_TRUE(homed(1));
    EXPECT_EQ(mode(), 8);
    const double position = plant().get<double>("/drive/a", "position");
    EXPECT_NEAR(position - plant().place(1), 0.25, 2e-3) << "the edge at -0.05 is 0.2 now";
    EXPECT_TRUE(plant().enabled(1));
}

// The coordinates are others after that, and so the demand is elsewhere.
TEST_F(Homing, DoesNotMoveTheAxisToADemandOfTheCoordinatesBefore) {
    begin(17);
    beginHome(1);
    ASSERT_EQ(end(), 1) << plant().told();
    const double there = plant().place(1);
    plant().step(1200);

    EXPECT_NEAR(plant().place(1), there, 1e-3);
    EXPECT_TRUE(plant().hasTold("axis 1 waits for its demand")) << plant().told();

    plant().demand(1, plant().get<double>("/drive/a", "position"));
    plant().step(10);
    plant().moveDemand(1, 0.4);
    plant().step(100);
    EXPECT_NEAR(plant().get<double>("/drive/a", "position"), 0.4, 1e-3);
}

TEST_F(Homing, LetsAControllerGoOnFromWhereTheAxisIsThen) {
    begin(17, true);
    beginHome(1);
    ASSERT_EQ(end(), 1) << plant().told();
    plant().step(2);
    EXPECT_NEAR(plant().get<double>("/demand/a", "velocity"), 0, 0.01);
    EXPECT_NEAR(plant().get<double>("/demand/a", "position"),
                plant().get<double>("/drive/a", "position"), 0.01);
    const double before = plant().get<double>("/drive/a", "position");
    plant().call("/jog", "jog", {{"axis", std::int64_t{1}}, {"velocity", 0.5}});
    plant().step(500);

    EXPECT_GT(plant().get<double>("/drive/a", "position"), before + 0.1);
    EXPECT_EQ(plant().state("/it"), State::Active);
    EXPECT_FALSE(plant().hasTold("waits")) << plant().told();
}

TEST_F(Homing, OfAllAxesIsOneAfterTheOther) {
    begin(37);

    const CallResult answer = home(0);

    EXPECT_TRUE(answer.done()) << answer.text();
    EXPECT_TRUE(homed(1) && homed(2));
}

TEST_F(Homing, FailsWithTheDrivesReason) {
    begin(3);  // no method of this drive

    const CallResult answer = home(1);

    EXPECT_EQ(answer.outcome, Outcome::Failed);
    EXPECT_EQ(answer.why, "axis 1: the drive says that homing has failed, by method 3");
    EXPECT_EQ(mode(), 8);
    EXPECT_FALSE(homed(1));
    EXPECT_TRUE(plant().enabled(1));
    EXPECT_EQ(plant().state("/it"), State::Active);
}

TEST_F(Homing, ThatIsCancelledGoesBackToTheModeBefore) {
    begin(17);
    beginHome(1);
    plant().step(150);
    ASSERT_EQ(mode(), 6);
    ASSERT_GT(std::abs(plant().get<double>("/drive/a", "velocity")), 0.01);

    EXPECT_TRUE(plant().ask("cancel").done());
    plant().step(1300);

    EXPECT_EQ(outcome(), 5) << "Cancelled";
    EXPECT_EQ(mode(), 8);
    EXPECT_FALSE(homed(1));
    EXPECT_TRUE(plant().enabled(1));
    EXPECT_EQ(plant().state("/it"), State::Active);
}

TEST_F(Homing, ThatTakesTooLongFails) {
    begin(17, false, 0.02);

    const CallResult answer = home(1, 1);

    EXPECT_EQ(answer.outcome, Outcome::Failed);
    EXPECT_EQ(answer.why, "axis 1: the zero position was not found in time");
    EXPECT_EQ(mode(), 8);
    EXPECT_EQ(plant().state("/it"), State::Active);
}

TEST_F(Homing, FailsWhereTheDriveDoesNotGoIntoTheMode) {
    begin(37);
    plant().axis(1).fixedMode = 8;

    const CallResult answer = home(1);

    EXPECT_EQ(answer.outcome, Outcome::Failed);
    EXPECT_EQ(answer.why, "axis 1: the drive does not go into the mode homing");
}

TEST_F(Homing, EndsWithAQuickStop) {
    begin(17);
    beginHome(1);
    plant().step(150);
    EXPECT_TRUE(plant().ask("quickStop", 1).done());
    plant().step(300);

    EXPECT_EQ(outcome(), 4) << "Failed";
    EXPECT_TRUE(plant().hasTold("axis 1: the axis was stopped meanwhile"));
    EXPECT_EQ(plant().driveState(1), Ds402State::SwitchOnDisabled);
    EXPECT_EQ(plant().state("/it"), State::Active);
}

TEST_F(Homing, EndsWhereTheProcessorLeavesActive) {
    begin(17);
    beginHome(1);
    plant().step(150);
    plant().cluster().send("/it", "shutdown");
    plant().step(500);

    EXPECT_EQ(outcome(), 5) << "Cancelled";
    EXPECT_EQ(plant().state("/it"), State::Standby);
    EXPECT_EQ(plant().driveState(1), Ds402State::SwitchOnDisabled);
}

TEST_F(Homing, RejectsOtherCommandsOfTheAxisAndItself) {
    begin(17);
    beginHome(1);
    plant().step(150);
    for (const char* command : {"enable", "disable"}) {
        EXPECT_EQ(plant().ask(command, 1).why, "axis 1 is homing: cancel that first") << command;
    }
    const Arguments other{{"axis", std::int64_t{1}}, {"mode", std::int64_t{9}}};
    EXPECT_EQ(plant().ask("setMode", other).outcome, Outcome::Rejected);
    const Arguments word{{"axis", std::int64_t{1}}, {"word", std::int64_t{1}}};
    EXPECT_EQ(plant().ask("step", word).outcome, Outcome::Rejected);
    EXPECT_EQ(home(2).reason, Reason::Busy);
    EXPECT_TRUE(plant().ask("disable", 2).done()) << "the other axis is free";
}

TEST_F(Homing, IsRejectedWhereNothingNeedsIt) {
    plant_.emplace();
    plant().begin();

    EXPECT_EQ(home(1).why, "axis 1 needs no homing: its encoder is absolute");
    EXPECT_EQ(home(0).why, "no axis needs homing: their encoders are absolute");
    EXPECT_EQ(mode(), 8);
}

TEST_F(Homing, IsRejectedByAMethodThatNoDriveHas) {
    for (const std::int64_t method : {0, 15, 32, 38, 99}) {
        begin(method);
        EXPECT_EQ(home(1).why, "axis 1: homingMethod " + std::to_string(method) +
                                   " is none of CiA 402; the drives of CorteX have 1, 2, 17, 18, "
                                   "33, 34, 35, 37");
        EXPECT_EQ(mode(), 8);
    }
}

TEST_F(Homing, IsRejectedAtSpeedsThatItsAxisMayNotHave) {
    begin(17, false, 0);
    EXPECT_EQ(home(1).why, "axis 1: homingSpeed is 0 and homingCreep 0.02; both must be above 0");
    begin(17, false, 1000);
    const std::string why = home(1).why;
    EXPECT_TRUE(why.starts_with("axis 1: homingSpeed is 1000 and homingCreep 0.02, at most "))
        << why;
    begin(37, false, 1000);
    EXPECT_TRUE(home(1).done()) << "it moves nothing";
}

TEST_F(Homing, IsRejectedToAPositionThatItsDriveCannotCount) {
    begin(37, false, 0.5, -21475);
    EXPECT_EQ(home(1).why,
              "axis 1: homeOffset is -21475, at most 21474.8, as its drive counts "
              "positions in 32 bits");
    begin(37, false, 0.5, 21474);
    EXPECT_TRUE(home(1).done());
}

TEST_F(Homing, IsRejectedForAnAxisThatIsNotEnabled) {
    begin(37);
    EXPECT_TRUE(plant().ask("disable", 1).done());
    plant().step(200);

    EXPECT_EQ(home(1).why, "axis 1 is in Switched on: enable it first");
}

TEST_F(Homing, IsAskedForByAFaultWhereADemandMovesBefore) {
    begin(37);
    plant().step(100);
    plant().moveDemand(1, 0.1);

    EXPECT_EQ(plant().state("/it"), State::Fault);
    EXPECT_EQ(plant().faultCode(), 21);
    EXPECT_EQ(plant().faultText(), "axis 1 is to move and not homed");
    EXPECT_NEAR(plant().place(1), 0, 1e-3);
}

TEST_F(Homing, IsNotNeededToMoveBySpeed) {
    begin(37);
    const Arguments speed{{"axis", std::int64_t{1}}, {"mode", std::int64_t{9}}};
    EXPECT_TRUE(plant().ask("setMode", speed).done());
    plant().step(50);
    plant().demand(1, 0, 0.3);
    plant().step(300);

    EXPECT_EQ(plant().state("/it"), State::Active);
    EXPECT_GT(plant().place(1), 0.05);
}

TEST_F(Homing, IsNeededAgainAfterTheEncoderHasJumped) {
    begin(37);
    EXPECT_TRUE(home(1).done());
    plant().moveDemand(1, 0.21);
    plant().demand(1, plant().get<double>("/drive/a", "position"));
    plant().step(20);
    plant().axis(1).model.jumpEncoder(0.002);
    plant().step(20);
    EXPECT_FALSE(homed(1));
    plant().moveDemand(1, plant().get<double>("/demand/a", "position") + 0.1);

    EXPECT_EQ(plant().faultCode(), 21);
}

}  // namespace
}  // namespace cortex::toolkit::test
