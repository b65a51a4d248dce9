// SPDX-License-Identifier: Apache-2.0
// An enabled axis that waits for its demand, and an axis to which no demand can come.
#include "ds402_plant.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

constexpr std::int64_t disabledStatus = 6, notHomedStatus = 5, readyStatus = 1;
constexpr double waitingPeriod = 1e-3;     // s
constexpr double mostAcceleration = 10.0;  // rad/s2, of the demands' type

// Places of axis 1 while it is stepped, and what follows from them.
class Watch {
public:
    explicit Watch(DrivePlant& plant) : plant_{plant}, last_{plant.place(1)} {}
    void step() {
        plant_.step();
        const double speed = (plant_.place(1) - last_) / waitingPeriod;
        fastest = std::max(fastest, std::abs(speed));
        if (known_) hardest = std::max(hardest, std::abs(speed - speed_) / waitingPeriod);
        last_ = plant_.place(1);
        speed_ = speed;
        known_ = true;
    }
    double fastest = 0, hardest = 0;  // rad/s, rad/s2

private:
    DrivePlant& plant_;
    double last_, speed_ = 0;
    bool known_ = false;
};

class AWaitingAxis : public testing::Test {
protected:
    void begin(const PlantOptions& options = {}) {
        plant_.emplace(options);
        plant().begin();
    }
    DrivePlant& plant() { return *plant_; }
    CallResult setMode(std::int64_t mode) {
        return plant().ask("setMode", {{"axis", std::int64_t{1}}, {"mode", mode}});
    }
    // Axis 1 is turned by a load while it is led by torque, and comes to rest.
    void moveByTorque() {
        ASSERT_TRUE(setMode(10).done());
        plant().step(50);
        drives::Ds402Disturbance& forces = plant().axis(1).model.disturbance;
        forces.load = -1;
        plant().step(200);
        forces = {.friction = 3};
        plant().step(500);
        forces = {};
        ASSERT_GT(plant().place(1), 0.25);
        ASSERT_LT(std::abs(plant().get<double>("/drive/a", "velocity")), 1e-3);
    }

    std::optional<DrivePlant> plant_;
};

TEST_F(AWaitingAxis, SaysDisabledSoThatItsControllerLeadsTheDemandToIt) {
    begin({.jogs = true});
    moveByTorque();
    const double stood = plant().place(1);
    ASSERT_GT(std::abs(plant().get<double>("/demand/a", "position") - stood), 0.2);

    ASSERT_TRUE(setMode(8).done());
    plant().step(50);
    EXPECT_EQ(plant().status(1), disabledStatus);
    EXPECT_EQ(plant().status(2), readyStatus);
    const CallResult jog = plant().call("/jog", "jog", {{"velocity", 0.5}});
    EXPECT_EQ(jog.why, "/drive/a does not follow: its drive says Disabled");

    Watch watch{plant()};
    for (int i = 0; i < 3000 && plant().status(1) != readyStatus; ++i) watch.step();
    EXPECT_EQ(plant().status(1), readyStatus);
    EXPECT_NEAR(plant().get<double>("/demand/a", "position"), stood, 0.01);
    EXPECT_LT(watch.fastest, 0.02) << "it stands meanwhile";
    EXPECT_FALSE(plant().hasTold("waits for its demand")) << plant().told();

    EXPECT_TRUE(plant().call("/jog", "jog", {{"velocity", 0.5}}).done());
    for (int i = 0; i < 300; ++i) watch.step();
    EXPECT_GT(plant().place(1), stood + 0.03);
    EXPECT_LT(watch.hardest, mostAcceleration);
}

TEST_F(AWaitingAxis, IsNotTakenAlongByADemandThatPassesBy) {
    begin();
    moveByTorque();
    const double stood = plant().place(1);
    ASSERT_TRUE(setMode(8).done());
    plant().step(50);
    Watch watch{plant()};
    for (const double stated : {1.0, 0.0}) {
        for (int i = 0; i <= 1000; ++i) {
            plant().demand(1, stood - 0.5 + i * waitingPeriod, stated);
            watch.step();
        }
        EXPECT_LT(watch.fastest, 0.02) << stated;
        EXPECT_EQ(plant().status(1), disabledStatus);
    }
    plant().demand(1, stood + 0.005);
    for (int i = 0; i < 1000; ++i) watch.step();

    EXPECT_NEAR(plant().place(1), stood + 0.005, 1e-3) << "one that rests is followed";
    EXPECT_EQ(plant().status(1), readyStatus);
    EXPECT_LT(watch.hardest, 1);
}

TEST_F(AWaitingAxis, TellsOfADemandThatStaysAwayOnceAndNotOfOneThatComes) {
    begin();
    moveByTorque();
    plant().demand(1, -2.9);
    plant().step(5);
    ASSERT_TRUE(setMode(8).done());
    plant().moveDemand(1, plant().place(1) - 0.1);
    EXPECT_FALSE(plant().hasTold("waits for its demand")) << plant().told();

    plant().step(1500);
    const std::string told = plant().told();
    const std::string words = "axis 1 waits for its demand, which is 0.1";
    EXPECT_NE(told.find(words), std::string::npos) << told;
    EXPECT_EQ(told.find("waits for"), told.rfind("waits for")) << told;
}

using AnAxisOutOfReach = AWaitingAxis;

TEST_F(AnAxisOutOfReach, IsAFaultOfTheStartupAtOnceAndByName) {
    plant_.emplace(PlantOptions{.startPosition = "3.5 0"});
    plant().boot();
    plant().cluster().send("/it", "startup");
    plant().step(3);

    EXPECT_EQ(plant().state("/it"), State::Fault);
    EXPECT_EQ(plant().faultCode(), 51);
    EXPECT_TRUE(
        plant().hasTold("axis 1 stands at 3.5, outside of -3 to 3 of /demand/a: "
                        "jog it back in CyclicVelocity"))
        << plant().told();
    plant().step(100);
    EXPECT_FALSE(plant().enabled(2));
}

TEST_F(AnAxisOutOfReach, ComesBackBySpeedAndFollowsThen) {
    plant_.emplace(PlantOptions{.jogs = true, .startPosition = "3.5 0"});
    plant().boot();
    ASSERT_TRUE(setMode(9).done());
    plant().startUp();
    ASSERT_EQ(plant().state("/it"), State::Active) << plant().told();
    const CallResult early = setMode(8);
    EXPECT_EQ(early.outcome, Outcome::Rejected);
    EXPECT_NE(early.why.find("outside of -3 to 3 of /demand/a"), std::string::npos) << early.why;

    for (int i = 0; i < 100; ++i) {
        plant().cluster().send("/jog", "jog", {{"axis", std::int64_t{1}}, {"velocity", -1.0}});
        plant().step(10);
    }
    plant().step(1000);
    ASSERT_LT(plant().place(1), 2.9);
    ASSERT_TRUE(setMode(8).done());
    plant().step(2000);

    EXPECT_EQ(plant().status(1), readyStatus) << plant().told();
    EXPECT_NEAR(plant().get<double>("/demand/a", "position"), plant().place(1), 0.01);
}

TEST_F(AnAxisOutOfReach, CannotBeEnabledAndSaysWhy) {
    begin();
    ASSERT_TRUE(plant().ask("disable", 1).done());
    plant().step(200);
    plant().axis(1).model.jumpEncoder(3.5);
    plant().step(5);
    const CallResult answer = plant().ask("enable", 1);

    EXPECT_EQ(answer.outcome, Outcome::Rejected);
    EXPECT_NE(answer.why.find("outside of -3 to 3 of /demand/a"), std::string::npos) << answer.why;
}

TEST_F(AnAxisOutOfReach, IsStartedAndHomedWhereItNeedsHoming) {
    plant_.emplace(PlantOptions{.homingNeeded = true, .jogs = true, .startPosition = "3.5 0"});
    plant().boot();
    plant().startUp();
    ASSERT_EQ(plant().state("/it"), State::Active) << plant().told();
    EXPECT_EQ(plant().status(1), notHomedStatus);
    EXPECT_NEAR(plant().place(1), 3.5, 1e-3);

    const CallResult answer = plant().ask("home", 1);
    EXPECT_TRUE(answer.done()) << answer.text();
    plant().step(1500);

    EXPECT_NEAR(plant().get<double>("/drive/a", "position"), 0, 1e-3);
    EXPECT_EQ(plant().status(1), readyStatus);
    EXPECT_FALSE(plant().hasTold("waits")) << plant().told();
    EXPECT_TRUE(plant().call("/jog", "jog", {{"velocity", 0.5}}).done());
}

TEST_F(AnAxisOutOfReach, StandsAndSaysSoWhereHomingPutItThere) {
    plant_.emplace(PlantOptions{.homingNeeded = true, .jogs = true});
    plant().boot();
    EXPECT_TRUE(plant().ask("set", {{"homeOffset", std::vector<double>{5, 0}}}).done());
    plant().startUp();
    EXPECT_TRUE(plant().ask("home", 1).done());
    plant().step(4000);

    EXPECT_EQ(plant().state("/it"), State::Active) << plant().told();
    EXPECT_EQ(plant().status(1), disabledStatus);
    EXPECT_NEAR(plant().place(1), 0, 1e-3);
    EXPECT_TRUE(
        plant().hasTold("axis 1 stands at 5, outside of -3 to 3 of /demand/a: jog it back "
                        "or home it in CyclicVelocity"))
        << plant().told();
}

// It cannot move by position, so nothing waits for its demand.
TEST_F(AWaitingAxis, IsNoneThatIsNotHomedAndStartsWithADemandElsewhere) {
    plant_.emplace(PlantOptions{.homingNeeded = true});
    plant().boot();
    plant().demand(1, 1);
    plant().step(5);
    plant().startUp();
    plant().step(1500);

    EXPECT_EQ(plant().state("/it"), State::Active) << plant().told();
    EXPECT_EQ(plant().status(1), notHomedStatus);
    EXPECT_NEAR(plant().place(1), 0, 1e-3);
    EXPECT_FALSE(plant().hasTold("waits")) << plant().told();
}

}  // namespace
}  // namespace cortex::toolkit::test
