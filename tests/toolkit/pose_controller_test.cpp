// SPDX-License-Identifier: Apache-2.0
#include "rig.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

// Two axes with the limits of LimitedAxis: 3 rad either way, 2 rad/s, 10 rad/s2, 100 rad/s3.
class PoseController : public testing::Test {
protected:
    static constexpr double period = 1e-3;
    void begin(const std::string& profile = "1") {
        Rig::Pairs relates;
        for (const char* number : {"1", "2"}) {
            const std::string demand = std::string{"/demand"} + number;
            const std::string axis = std::string{"/axis"} + number;
            rig_.add(demand, "LimitedAxis");
            rig_.add(axis, "RotaryAxisObservation");
            relates.emplace_back("axes", axis);
            relates.emplace_back("demands", demand);
        }
        rig_.add("/pose", "AxisPoseController", relates, {{"profile", profile}});
        rig_.start();
        rig_.startUp();
    }
    void moveTo(double first, double second, double speedShare = 1) {
        std::vector<double> pose(16);
        pose[0] = first;
        pose[1] = second;
        rig_.cluster().send("/pose", "set", {{"pose", pose}});
        rig_.cluster().send("/pose", "moveTo", {{"speedShare", speedShare}});
        step(2);
    }
    void step(int cycles = 1) {
        for (int i = 0; i < cycles; ++i) {
            const double before = velocity(), accelerationBefore = acceleration();
            rig_.step();
            EXPECT_LE(std::abs(velocity() - before), 10 * period * (1 + 1e-9));
            jerk_ = std::max(jerk_, std::abs(acceleration() - accelerationBefore) / period);
            speed_ = std::max(speed_, std::abs(velocity()));
        }
    }
    // Nobody renews it, so it is lost after 2 s.
    void takeControl() {
        const CallResult taken =
            rig_.call("/rig", "takeControl", {{"prefix", std::string{"/pose"}}});
        ASSERT_TRUE(taken.done()) << taken.text();
    }
    double position(const char* number = "1") {
        return rig_.get<double>(std::string{"/demand"} + number, "position");
    }
    double velocity() { return rig_.get<double>("/demand1", "velocity"); }
    double acceleration() { return rig_.get<double>("/demand1", "acceleration"); }
    double remaining() { return rig_.get<double>("/pose", "remaining"); }
    std::int64_t outcome() { return rig_.get<std::int64_t>("/pose", "outcome"); }

    Rig rig_;
    double jerk_ = 0, speed_ = 0;
};

TEST_F(PoseController, BringsAllAxesThereInOneCycleWithinTheirLimits) {
    begin();
    moveTo(2, -0.3);
    const double time = remaining();
    // The closed form of the longer way: d/V + V/A + A/J, of which a cycle is over.
    EXPECT_NEAR(time, 2.0 / 2 + 2.0 / 10 + 10.0 / 100 - period, 1.1 * period);
    step(static_cast<int>(time / period) - 1);
    EXPECT_NE(position(), 2);
    EXPECT_NE(position("2"), -0.3);
    step(3);

    EXPECT_EQ(position(), 2);
    EXPECT_EQ(position("2"), -0.3);
    EXPECT_EQ(remaining(), 0);
    EXPECT_EQ(outcome(), static_cast<int>(Outcome::Done));
    EXPECT_LE(jerk_, 100 * (1 + 1e-9));
}

TEST_F(PoseController, AimsAnewInMotion) {
    begin();
    moveTo(2, 0);
    step(600);
    ASSERT_GT(velocity(), 1.5);
    moveTo(-1, 0.5);
    step(3000);

    EXPECT_EQ(position(), -1);
    EXPECT_EQ(position("2"), 0.5);
    EXPECT_LE(jerk_, 100 * (1 + 1e-9));
    EXPECT_EQ(rig_.get<std::int64_t>("/rig", "limitCount"), 0);
}

TEST_F(PoseController, TakesItsShareOfTheSpeed) {
    begin();
    moveTo(1, 0, 0.25);
    step(4000);

    EXPECT_EQ(position(), 1);
    EXPECT_NEAR(speed_, 0.5, 1e-6);
}

TEST_F(PoseController, MovesByTrapezoidsWhereItIsSetSo) {
    begin("0");
    moveTo(1, 0);
    step(100);

    EXPECT_NEAR(velocity(), 10 * 0.1, 0.03);  // no ramp of the acceleration
}

TEST_F(PoseController, BrakesWhenItIsCancelled) {
    begin();
    moveTo(2, 0);
    step(600);
    ASSERT_GT(velocity(), 1.5);
    EXPECT_TRUE(rig_.call("/pose", "cancel").done());
    step(400);

    EXPECT_EQ(velocity(), 0);
    EXPECT_LT(position(), 1.9);
    EXPECT_LE(jerk_, 100 * (1 + 1e-9));
}

TEST_F(PoseController, DoesNotGoOnByItselfAfterAnAxisWasLost) {
    begin();
    moveTo(2, 0);
    step(600);
    rig_.tree().at("/axis2").slot().quality = Quality::Lost;
    rig_.step(500);
    EXPECT_EQ(outcome(), static_cast<int>(Outcome::Failed));
    rig_.tree().at("/axis2").slot().quality = Quality::Good;
    rig_.step(10);
    const double stands = position();
    rig_.step(500);

    EXPECT_NEAR(position(), stands, 1e-9);
}

TEST_F(PoseController, BrakesWithinItsLimitsWhenControlIsLost) {
    begin();
    takeControl();
    moveTo(2.9, 0, 0.25);
    step(1900);
    ASSERT_GT(velocity(), 0.45);
    step(400);  // nobody has renewed it for 2 s

    EXPECT_EQ(velocity(), 0);
    EXPECT_LT(position(), 1.2);
    EXPECT_EQ(outcome(), static_cast<int>(Outcome::Cancelled));
    EXPECT_LE(jerk_, 100 * (1 + 1e-9));
}

TEST_F(PoseController, SaysThatItsMoveEndedBecauseControlWasLost) {
    begin();
    moveTo(2.9, 0);
    takeControl();

    const CallResult ended = rig_.call("/pose", "moveTo", {{"speedShare", 0.02}});

    EXPECT_EQ(ended.outcome, Outcome::Cancelled);
    EXPECT_EQ(ended.why, "control was lost");
}

TEST_F(PoseController, GoesOnWhenControlIsReleased) {
    begin();
    takeControl();
    moveTo(2.9, 0, 0.25);
    step(1000);
    rig_.call("/rig", "releaseControl", {{"prefix", std::string{"/pose"}}});
    step(6000);

    EXPECT_EQ(position(), 2.9);
    EXPECT_EQ(outcome(), static_cast<int>(Outcome::Done));
}

// --- a start in motion ------------------------------------------------------------------------

// Two controllers of one limited axis with a drive, or one of each of two, and their selector.
class SelectedInMotion {
public:
    explicit SelectedInMotion(const char* axisOfSecond) {
        for (const std::string number : {"1", "2"}) {
            const std::string demand = "/demand" + number, axis = "/axis" + number;
            rig.add(demand, "LimitedAxis");
            rig.add(axis, "RotaryAxisObservation");
            rig.add("/drive" + number, "SimulatedAxis",
                    {{"demand", demand}, {"observation", axis}});
        }
        rig.add("/pose", "AxisPoseController", axes("1"));
        rig.add("/hold", "HoldAxisController", axes(axisOfSecond));
        rig.add("/selector", "AxisControllerSelector",
                {{"choices", "/pose"}, {"choices", "/hold"}});
        rig.start();
        rig.cluster().send("/rig", "startup", {{"prefix", std::string{"/"}}});
        rig.step(30);
        std::vector<double> pose(16);
        pose[0] = 2;
        rig.call("/pose", "set", {{"pose", pose}});
        rig.cluster().send("/pose", "moveTo", {{"speedShare", 1.0}});
        rig.step(200);  // it accelerates, so the axis is not quite where it is wished to be
        last_ = demand();
    }
    void select(std::int64_t group) {
        rig.cluster().send("/selector", "select", {{"group", group}});
    }
    // In each cycle the way is what the velocity says, which changes by 10 rad/s2 at most.
    void step(int cycles) {
        constexpr double seconds = 1e-3;
        for (int i = 0; i < cycles; ++i) {
            rig.step();
            const Motion now = demand();
            const double way = (last_.velocity + now.velocity) / 2 * seconds;
            EXPECT_NEAR(now.position - last_.position, way, 10 * seconds * seconds)
                << "cycle " << rig.cycle() << " at " << now.velocity;
            EXPECT_LE(std::abs(now.velocity - last_.velocity), 10 * seconds * (1 + 1e-9));
            last_ = now;
        }
    }
    double velocity() const { return last_.velocity; }

    Rig rig;

private:
    struct Motion {
        double position = 0, velocity = 0;
    };
    static Rig::Pairs axes(const std::string& number) {
        return {{"axes", "/axis" + number}, {"demands", "/demand" + number}};
    }
    Motion demand() {
        return {rig.get<double>("/demand1", "position"), rig.get<double>("/demand1", "velocity")};
    }

    Motion last_;
};

TEST(ADemandInMotion, StaysContinuousWhenItsSelectorIsShutDown) {
    SelectedInMotion plant{"1"};
    ASSERT_GT(plant.velocity(), 1);
    plant.rig.cluster().send("/selector", "shutdown", {});
    plant.step(400);

    EXPECT_EQ(plant.velocity(), 0);
}

TEST(ADemandInMotion, StaysContinuousWhenAnotherGroupOfItsAxisIsSelected) {
    SelectedInMotion plant{"1"};
    plant.select(2);
    plant.step(400);

    EXPECT_EQ(plant.rig.state("/hold"), State::Active);
    EXPECT_EQ(plant.velocity(), 0);
}

TEST(ADemandInMotion, StaysContinuousWhenItsControllerStartsAnewBeforeItRests) {
    SelectedInMotion plant{"1"};
    plant.rig.cluster().send("/pose", "shutdown", {});  // the selector starts it again
    plant.step(10);

    EXPECT_EQ(plant.rig.state("/pose"), State::Active);
    plant.step(400);
    EXPECT_EQ(plant.velocity(), 0);
}

TEST(ADemandInMotion, StaysContinuousWhenItsGroupIsSelectedAgainBeforeItRests) {
    SelectedInMotion plant{"2"};
    plant.select(2);
    plant.step(20);
    ASSERT_GT(plant.velocity(), 0.5);
    ASSERT_EQ(plant.rig.state("/pose"), State::Standby);
    plant.select(1);
    plant.step(400);

    EXPECT_EQ(plant.rig.state("/pose"), State::Active);
    EXPECT_EQ(plant.velocity(), 0);
}

TEST(ADemandInMotion, StaysContinuousWhenItsControllerIsShutDownAsItStarts) {
    SelectedInMotion plant{"2"};
    plant.select(2);
    plant.step(20);
    plant.select(1);
    plant.step(1);
    plant.select(2);
    plant.step(400);

    EXPECT_EQ(plant.rig.state("/pose"), State::Standby);
    EXPECT_EQ(plant.velocity(), 0);
}

}  // namespace
}  // namespace cortex::toolkit::test
