// SPDX-License-Identifier: Apache-2.0
#include "cortex/mechanics/inverse_dynamics.hpp"

#include "cortex/core/agent.hpp"

#include "mechanics/lbr_chain.hpp"
#include "rig.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

using mechanics::RigidBody;
using mechanics::SerialChain;
using mechanics::test::lbrDynamics;
using mechanics::test::lbrPosture;

const Eigen::Vector3d earth{0, 0, -9.80665};  // m/s2

// An LBR with simulated drives. A pose controller writes the targets.
class DynamicLbr : public testing::Test {
protected:
    void begin(const Rig::Pairs& settings = {}) {
        rig_.add("/lbr", "KukaLbr");
        Rig::Pairs controlled, moved;
        for (int i = 1; i <= 7; ++i) {
            const std::string number = std::to_string(i), axis = "/lbr/axes/" + number,
                              demand = "/lbr/demands/" + number, target = "/targets/" + number;
            rig_.add(target, "KukaLbrAxis" + number);
            rig_.add("/drives/" + number, "SimulatedAxis",
                     {{"demand", demand}, {"observation", axis}},
                     {{"startPosition", std::to_string(lbrPosture()[i - 1])}});
            controlled.emplace_back("axes", axis);
            controlled.emplace_back("demands", target);
            for (const auto& [rule, to] : {std::pair{"axes", axis}, std::pair{"targets", target},
                                           std::pair{"demands", demand}})
                moved.emplace_back(rule, to);
        }
        rig_.add("/pose", "AxisPoseController", controlled);
        rig_.add("/dynamics", "InverseDynamics", moved, settings);
        rig_.start();
    }
    void moveTo(double each) {
        EXPECT_TRUE(rig_.call("/pose", "set", {{"pose", std::vector<double>(16, each)}}).done());
        rig_.cluster().send("/pose", "moveTo", {{"speedShare", 1.0}});
    }
    SerialChain::JointVector all(const std::string& folder, const std::string& item) {
        SerialChain::JointVector values(7);
        for (int i = 0; i < 7; ++i)
            values[i] = rig_.get<double>(folder + std::to_string(i + 1), item);
        return values;
    }
    SerialChain::JointVector demands(const std::string& item) { return all("/lbr/demands/", item); }
    double farthest(const SerialChain::JointVector& expected) {
        return (demands("effort") - expected).cwiseAbs().maxCoeff();
    }
    SerialChain::JointVector all() {
        return dynamics_.torques(demands("position"), demands("velocity"), demands("acceleration"));
    }
    SerialChain::JointVector accelerating() {
        return all() - dynamics_.torques(demands("position"), demands("velocity"),
                                         SerialChain::JointVector::Zero(7));
    }

    mechanics::InverseDynamics dynamics_{lbrDynamics(), earth};
    Rig rig_;
};

// The masses in the ontology are those of the table.
TEST_F(DynamicLbr, IsGivenTheEffortOfItsDemandInEachCycle) {
    begin();
    rig_.startUp();
    moveTo(0.5);
    double fastest = 0;
    for (int i = 0; i < 2000; ++i) {
        rig_.step();
        for (const char* item : {"position", "velocity", "acceleration"})
            ASSERT_EQ(demands(item), all("/targets/", item)) << item;
        ASSERT_LT(farthest(all()), 1e-9);
        fastest = std::max(fastest, demands("velocity").cwiseAbs().maxCoeff());
    }
    EXPECT_GT(fastest, 0.5);
    EXPECT_EQ(rig_.get<std::int64_t>("/rig", "limitCount"), 0);
}

TEST_F(DynamicLbr, IsGivenTheShareOfItsAccelerationAlone) {
    begin({{"part", "Acceleration"}});
    rig_.startUp();
    rig_.step(10);
    EXPECT_EQ(demands("effort"), SerialChain::JointVector::Zero(7));

    moveTo(0.5);
    double greatest = 0;
    for (int i = 0; i < 2000; ++i) {
        rig_.step();
        ASSERT_LT(farthest(accelerating()), 1e-9);
        greatest = std::max(greatest, demands("effort").cwiseAbs().maxCoeff());
    }
    EXPECT_GT(greatest, 5);
    EXPECT_EQ(demands("effort"), SerialChain::JointVector::Zero(7));
}

TEST_F(DynamicLbr, CarriesTheLoadThatItIsTold) {
    begin({{"loadMass", "1"}});
    const RigidBody load{
        3, {0.02, 0, 0.15}, (RigidBody::Inertia() << 0.02, 0.02, 0.01, 0, 0, 0).finished()};
    const CallResult told =
        rig_.call("/dynamics", "set",
                  {{"loadMass", load.mass},
                   {"loadCentre", std::vector<double>{0.02, 0, 0.15}},
                   {"loadInertia", std::vector<double>{0.02, 0.02, 0.01, 0, 0, 0}}});
    ASSERT_TRUE(told.done()) << told.text();
    rig_.startUp();
    rig_.step(10);
    EXPECT_GT(farthest(all()), 5);

    ASSERT_TRUE(dynamics_.setLoad(load));
    EXPECT_LT(farthest(all()), 1e-9);
    EXPECT_EQ(rig_.call("/dynamics", "set", {{"loadMass", 1.0}}).outcome, Outcome::Rejected);
}

TEST_F(DynamicLbr, CarriesTheLoadOfItsSystemFileFromTheStart) {
    begin({{"loadMass", "3"}});
    rig_.startUp();
    rig_.step(10);

    ASSERT_TRUE(dynamics_.setLoad({3, {0, 0, 0}, RigidBody::Inertia::Zero()}));
    EXPECT_LT(farthest(all()), 1e-9);
}

TEST_F(DynamicLbr, RefusesALoadThatThereCannotBe) {
    begin();
    const CallResult told = rig_.call(
        "/dynamics", "set", {{"loadInertia", std::vector<double>{0.1, 0.1, 0.1, 0, 0, 0}}});

    EXPECT_NE(told.text().find("the load: inertia without a mass: give the mass, too"),
              std::string::npos)
        << told.text();
}

TEST_F(DynamicLbr, StartsAgainWhereItWasShutDownInMotion) {
    begin();
    rig_.startUp();
    moveTo(0.5);
    rig_.step(600);
    ASSERT_GT(demands("velocity").cwiseAbs().maxCoeff(), 0.5);
    for (const char* command : {"shutdown", "startup"}) {
        rig_.cluster().send("/rig", command, {{"prefix", std::string{"/"}}});
        rig_.step(1000);
    }

    EXPECT_EQ(rig_.state("/dynamics"), State::Active);
    EXPECT_LT((demands("position") - all("/lbr/axes/", "position")).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_LT(farthest(all()), 1e-9);
}

// One level arm of 2 kg and 0.5 m. The demand has 2 rad/s, 10 rad/s2, 100 rad/s3; the test writes
// the axis and its target.
class DynamicAxis : public testing::Test {
protected:
    static constexpr double period = 1e-3;

    static inline const Rig::Pairs levelArm{
        {"linkMass", "2"}, {"linkCentre", "0.5 0 0"}, {"direction", "0 1 0"}};

    DynamicAxis() {
        rig_.cluster().addEventSink(
            [this](const Event& event, const Structure&) { told_ += event.text.view(); });
    }
    void begin(double axis = 0, double target = 0) {
        build(levelArm);
        rig_.start();
        write("/axis", "position", axis);
        aim(target);
        rig_.step(5);
        rig_.cluster().send("/dynamics", "startup");
    }
    void build(const Rig::Pairs& axis, const Rig::Pairs& settings = {}) {
        rig_.add("/axis", "RotaryAxisObservation", {}, axis);
        rig_.add("/target", "RotaryAxisConcept");
        rig_.add("/demand", "LimitedAxis");
        rig_.add("/dynamics", "InverseDynamics",
                 {{"axes", "/axis"}, {"targets", "/target"}, {"demands", "/demand"}}, settings);
    }
    std::string refusal() {
        try {
            rig_.start();
        } catch (const std::exception& error) {
            return error.what();
        }
        return "none";
    }
    void write(const std::string& path, const std::string& item, double value) {
        rig_.tree().at(path).data<double>(item) = value;
    }
    void aim(double position, double velocity = 0) {
        write("/target", "position", position);
        write("/target", "velocity", velocity);
    }
    void step(int cycles = 1) {
        for (int i = 0; i < cycles; ++i) {
            const double before = demand("position"), speedBefore = demand("velocity");
            rig_.step();
            step_ = std::max(step_, std::abs(demand("position") - before) / period);
            change_ = std::max(change_, std::abs(demand("velocity") - speedBefore) / period);
        }
    }
    void lead(double velocity, int cycles) {
        for (int i = 0; i < cycles; ++i) {
            const double now = std::min(velocity, 5 * period * i);
            aim(rig_.get<double>("/target", "position") + now * period, now);
            step();
        }
    }
    double demand(const std::string& item) { return rig_.get<double>("/demand", item); }
    std::string told() {
        rig_.cluster().agent().events().flush();
        return told_;
    }

    std::string told_;
    double step_ = 0, change_ = 0;
    Rig rig_;
};

TEST_F(DynamicAxis, BeginsWithoutAStepWhereItsTargetIsNear) {
    begin(0.3, 0.308);
    // It takes the observation within its rate.
    for (int i = 0; i < 1000 && demand("position") < 0.3; ++i) {
        if (demand("position") < 0.29) ASSERT_NE(rig_.state("/dynamics"), State::Active);
        rig_.step();
    }
    step(500);

    EXPECT_EQ(rig_.state("/dynamics"), State::Active);
    EXPECT_NEAR(demand("position"), 0.308, 1e-12);
    EXPECT_LE(change_, 10 * (1 + 1e-9));
    EXPECT_LT(step_, 0.3);
    EXPECT_EQ(rig_.get<std::int64_t>("/rig", "limitCount"), 0);
    EXPECT_NEAR(demand("effort"), -2 * 9.80665 * 0.5 * std::cos(0.308), 1e-9);
}

TEST_F(DynamicAxis, StopsWithoutAStep) {
    begin();
    lead(1, 1000);
    ASSERT_NEAR(demand("velocity"), 1, 0.01);
    rig_.cluster().send("/dynamics", "shutdown");
    step(500);

    EXPECT_EQ(rig_.state("/dynamics"), State::Standby);
    EXPECT_EQ(demand("velocity"), 0);
    EXPECT_EQ(demand("effort"), 0);
    EXPECT_LE(change_, 10 * (1 + 1e-9));
}

TEST_F(DynamicAxis, BrakesAndGivesNoEffortWhenATargetOrAnAxisIsLost) {
    begin();
    lead(1, 1000);
    for (const char* path : {"/target", "/axis"}) {
        ASSERT_NE(demand("effort"), 0);
        rig_.tree().at(path).slot().quality = Quality::Lost;
        step(300);
        EXPECT_EQ(demand("velocity"), 0) << path;
        EXPECT_EQ(demand("effort"), 0) << path;
        rig_.tree().at(path).slot().quality = Quality::Good;
        aim(demand("position"));
        step(300);
    }
    EXPECT_LE(change_, 10 * (1 + 1e-9));
    EXPECT_NE(demand("effort"), 0);
}

TEST_F(DynamicAxis, WaitsForATargetThatIsElsewhereAndNamesIt) {
    begin(0.5, 0);
    step(500);
    EXPECT_EQ(told().find("it waits"), std::string::npos);
    step(2000);
    EXPECT_EQ(rig_.state("/dynamics"), State::StartingUp);
    EXPECT_EQ(demand("position"), 0.5);
    const std::string words =
        "it waits for the target /target, 0.5 away from /demand; bring it there";
    EXPECT_NE(told().find(words), std::string::npos) << told();
    EXPECT_EQ(told().find(words), told().rfind(words));

    aim(0.495);
    step(3);
    EXPECT_EQ(rig_.state("/dynamics"), State::Active);

    rig_.cluster().send("/dynamics", "shutdown");
    step(10);
    aim(0);
    rig_.cluster().send("/dynamics", "startup");
    step(1200);
    EXPECT_NE(told().find(words), told().rfind(words));  // each start tells of its own waiting
}

TEST_F(DynamicAxis, WaitsForATargetThatMoves) {
    begin();
    aim(0, 0.5);
    step(1200);
    EXPECT_EQ(rig_.state("/dynamics"), State::StartingUp);
    EXPECT_NE(told().find("it waits for the target /target, as it or its demand still moves"),
              std::string::npos)
        << told();
    aim(0, 0);
    step(3);
    EXPECT_EQ(rig_.state("/dynamics"), State::Active);
}

TEST_F(DynamicAxis, RefusesAnAxisWithoutAMass) {
    build({{"direction", "0 1 0"}});
    EXPECT_NE(refusal().find(
                  "/dynamics: rule 'axes': /axis states no mass of its link: give linkMass in its "
                  "type 'RotaryAxisObservation', or set it in the system file"),
              std::string::npos);
}

TEST_F(DynamicAxis, RefusesALinkThatThereCannotBe) {
    build({{"linkMass", "1"}, {"linkInertia", "0.1 0.1 0.3 0 0 0"}});
    const std::string text = refusal();
    EXPECT_NE(text.find("/dynamics: rule 'axes': /axis, its link: inertia has a principal moment "
                        "above the sum of the other two"),
              std::string::npos)
        << text;
}

TEST_F(DynamicAxis, RefusesADirectionThatIsNoUnitVector) {
    build({{"linkMass", "1"}, {"direction", "0 0.5 0"}});
    const std::string text = refusal();
    EXPECT_NE(text.find("/dynamics: inverse dynamics refused:\n  joint 1: direction is no unit"),
              std::string::npos)
        << text;
}

TEST_F(DynamicAxis, RefusesALoadOfItsSystemFileThatThereCannotBe) {
    build(levelArm, {{"loadMass", "1"}, {"loadInertia", "0.1 0.1 0.3 0 0 0"}});
    const std::string text = refusal();
    EXPECT_NE(text.find("the load: inertia has a principal moment above"), std::string::npos)
        << text;
}

TEST_F(DynamicAxis, RefusesAnAxisOfAnotherAgent) {
    rig_.add("/target", "RotaryAxisConcept");
    rig_.add("/demand", "LimitedAxis");
    SystemDescription::SimplexEntry dynamics;
    dynamics.path = "/dynamics";
    dynamics.type = "InverseDynamics";
    dynamics.relates = {{"axes", "/far/axis", false, true, {}, "RotaryAxisConcept"},
                        {"targets", "/target", false, false, {}},
                        {"demands", "/demand", false, false, {}}};
    rig_.add(dynamics);
    const std::string text = refusal();
    EXPECT_NE(text.find("/dynamics: /far/axis belongs to another agent, and its geometry comes"),
              std::string::npos)
        << text;
}

}  // namespace
}  // namespace cortex::toolkit::test
