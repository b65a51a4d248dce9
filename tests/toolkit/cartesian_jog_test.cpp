// SPDX-License-Identifier: Apache-2.0
// The tip of the LBR, and that of a gantry, jogged by hand.
#include "rig.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

// Axes with every limit and their drives, one after the other as a chain, and its controller.
class JoggedTip : public Rig {
public:
    using Start = std::array<const char*, 7>;
    static constexpr Start bent{"0", "0.6", "0", "-1.4", "0", "1.1", "0"};
    explicit JoggedTip(const Start& start = bent, const Pairs& settings = {}) {
        constexpr std::array directions{"0 0 1", "0 1 0", "0 0 1", "0 -1 0",
                                        "0 0 1", "0 1 0", "0 0 1"};
        constexpr std::array heights{"0", "0.36", "0", "0.42", "0", "0.4", "0"};
        Pairs relates;
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const std::string number = std::to_string(i + 1);
            const std::string origin = std::string{"0 0 "} + heights[i];
            const Pairs geometry{{"originPosition", origin}, {"direction", directions[i]}};
            add("/axis" + number, "LimitedAxis", {}, geometry);
            add("/demand" + number, "LimitedAxis", {}, geometry);
            add("/drive" + number, "SimulatedAxis",
                {{"demand", "/demand" + number}, {"observation", "/axis" + number}},
                {{"startPosition", start[i]}});
            relates.emplace_back("axes", "/axis" + number);
            relates.emplace_back("demands", "/demand" + number);
        }
        add("/tip", "CartesianObservation");
        Pairs kinematics{{"tip", "/tip"}};
        for (std::size_t i = 1; i <= 7; ++i)
            kinematics.emplace_back("axes", "/demand" + std::to_string(i));
        add("/forward", "ForwardKinematics", kinematics);
        add("/jog", "CartesianJogController", relates, settings);
        start_();
    }
    void jog(const std::vector<double>& linear, const std::vector<double>& angular = {0, 0, 0}) {
        cluster().send("/jog", "jog", {{"linear", linear}, {"angular", angular}});
    }
    // Repeated as a person's window does, ten times a second.
    void jogFor(int cycles, const std::vector<double>& linear,
                const std::vector<double>& angular = {0, 0, 0}) {
        for (int i = 0; i < cycles; ++i) {
            if (i % 100 == 0) jog(linear, angular);
            stepJudged();
        }
    }
    void stepJudged() {
        step();
        for (std::size_t i = 0; i < last_.size(); ++i) judge(i);
    }
    void rest() {
        for (int i = 0; i < 1500; ++i) stepJudged();
    }
    struct Posture {
        Eigen::Vector3d position;
        Eigen::Quaterniond rotation;
    };
    Posture posture() {
        const std::vector<double> at = tip(), turned = array("/tip", "rotation");
        return {{at[0], at[1], at[2]}, {turned[3], turned[0], turned[1], turned[2]}};
    }
    std::vector<double> tip() { return array("/tip", "position"); }
    std::vector<double> tipVelocity() { return array("/tip", "linearVelocity"); }
    double demand(std::size_t axis, const std::string& item) {
        return get<double>("/demand" + std::to_string(axis + 1), item);
    }
    std::int64_t heldBack() { return get<std::int64_t>("/jog", "heldBack"); }

    // How far the tip is from where a straight jog leads: m off the line, or rad off the turn.
    double awayFrom(const Posture& begin, const Eigen::Vector3d& linear,
                    const Eigen::Vector3d& angular = Eigen::Vector3d::Zero()) {
        const Posture now = posture();
        const Eigen::AngleAxisd turn{now.rotation * begin.rotation.inverse()};
        const auto off = [](const Eigen::Vector3d& way, const Eigen::Vector3d& along) {
            return (way - along.normalized() * along.normalized().dot(way)).norm();
        };
        return std::max(off(now.position - begin.position, linear),
                        off(turn.axis() * turn.angle(), angular));
    }
    // Jogs, comes to rest, and keeps the most that the tip was away from the straight way.
    void jogStraight(int cycles, Eigen::Vector3d linear,
                     Eigen::Vector3d angular = Eigen::Vector3d::Zero(), bool ofTip = false) {
        const Posture begin = posture();
        const std::vector<double> speed{linear[0], linear[1], linear[2]};
        const std::vector<double> turn{angular[0], angular[1], angular[2]};
        if (ofTip) {
            linear = begin.rotation * linear;
            angular = begin.rotation * angular;
        }
        for (int i = 0; i < cycles + 600; ++i) {
            if (i % 100 == 0 && i < cycles) jog(speed, turn);
            stepJudged();
            mostAway = std::max(mostAway, awayFrom(begin, linear, angular));
        }
        way += (posture().position - begin.position).norm() +
               posture().rotation.angularDistance(begin.rotation);
    }

    double way = 0;           // m and rad, from rest to rest
    double mostAway = 0;      // m or rad
    double mostOfLimits = 0;  // changes in a cycle, as a share of what the limits allow

private:
    struct Last {
        double position = 0, velocity = 0, acceleration = 0;
    };
    void start_() {
        Rig::start();
        step(50);
        startUp();
        for (std::size_t i = 0; i < last_.size(); ++i)
            last_[i] = {demand(i, "position"), demand(i, "velocity"), demand(i, "acceleration")};
    }
    void judge(std::size_t i) {
        constexpr double cycle = 1e-3;
        const Last now{demand(i, "position"), demand(i, "velocity"), demand(i, "acceleration")};
        const auto include = [&](double change, double limit) {
            mostOfLimits = std::max(mostOfLimits, std::abs(change) / (limit * cycle));
        };
        include(now.position - last_[i].position, 2);
        include(now.velocity - last_[i].velocity, 10);
        include(now.acceleration - last_[i].acceleration, 100);
        last_[i] = now;
    }

    std::array<Last, 7> last_{};
};

TEST(ATipThatIsJogged, GoesAlongTheAxesOfTheBase) {
    JoggedTip arm;
    const std::vector<double> before = arm.tip();
    arm.jogFor(1000, {0.05, 0, 0});
    EXPECT_NEAR(arm.tipVelocity()[0], 0.05, 1e-4);
    EXPECT_NEAR(arm.tipVelocity()[1], 0, 1e-4);
    arm.rest();

    const std::vector<double> after = arm.tip();
    EXPECT_GT(after[0] - before[0], 0.03);
    EXPECT_NEAR(after[1], before[1], 1e-3);
    EXPECT_NEAR(after[2], before[2], 1e-3);
    EXPECT_LE(arm.mostOfLimits, 1 + 1e-9);
}

TEST(ATipThatIsJogged, GoesAlongItsOwnAxesWhereTheFrameIsTheTip) {
    JoggedTip arm;
    EXPECT_EQ(arm.call("/jog", "set", {{"frame", std::int64_t{1}}}).outcome, Outcome::Done);
    const std::vector<double> rotation = arm.array("/tip", "rotation");
    const Eigen::Quaterniond turned{rotation[3], rotation[0], rotation[1], rotation[2]};
    arm.jogFor(800, {0, 0, 0.05});

    const Eigen::Vector3d expected = turned * Eigen::Vector3d{0, 0, 0.05};
    const std::vector<double> velocity = arm.tipVelocity();
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(velocity[static_cast<std::size_t>(i)], expected[i], 1e-3) << i;
}

TEST(ATipThatIsJogged, EndsByItselfAfterTheHoldTime) {
    JoggedTip arm;
    arm.jog({0.05, 0, 0});
    arm.step(100);
    EXPECT_TRUE(arm.get<bool>("/jog", "jogging"));
    arm.step(152);
    EXPECT_FALSE(arm.get<bool>("/jog", "jogging"));
    arm.rest();
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(arm.demand(i, "velocity"), 0) << i;
}

TEST(ATipThatIsJogged, IsJoggedNoMoreWhereItsControllerIsNotActive) {
    JoggedTip arm;
    arm.jog({0.05, 0, 0});
    arm.step(20);
    EXPECT_TRUE(arm.get<bool>("/jog", "jogging"));
    arm.cluster().send("/jog", "shutdown");
    arm.step(2);
    EXPECT_FALSE(arm.get<bool>("/jog", "jogging"));
}

TEST(ATipThatIsJogged, KeepsEveryAxisWithinItsLimitsAllTheWayOut) {
    JoggedTip arm;
    arm.jogFor(15'000, {0.25, 0, 0.1});
    EXPECT_NE(arm.heldBack(), 0) << "the arm is stretched, or at a limit";
    arm.rest();
    arm.jogFor(15'000, {-0.25, 0, -0.25}, {0.5, 0.5, 0.5});
    EXPECT_LE(arm.mostOfLimits, 1 + 1e-9);
    for (std::size_t i = 0; i < 7; ++i) EXPECT_LE(std::abs(arm.demand(i, "position")), 3) << i;
    arm.rest();
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(arm.demand(i, "velocity"), 0) << i;
}

TEST(ATipThatIsJogged, GoesStraightAtFullSpeedWhicheverWay) {
    JoggedTip arm;
    std::mt19937 random{41};
    for (std::int64_t i = 0; i < 14; ++i) {
        ASSERT_EQ(arm.call("/jog", "set", {{"frame", i % 2}}).outcome, Outcome::Done);
        Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
        const auto along = static_cast<Eigen::Index>(random() % 6);
        const double sign = random() % 2 == 0 ? 1 : -1;
        if (along < 3) linear[along] = 0.25 * sign;
        if (along >= 3) angular[along - 3] = 0.5 * sign;
        const double wayBefore = arm.way;
        arm.jogStraight(500, linear, angular, i % 2 == 1);
        EXPECT_GT(arm.way - wayBefore, 0) << i;
    }
    EXPECT_GT(arm.way, 0.5) << "m and rad, of 14 jogs of half a second";
    EXPECT_LT(arm.mostAway, 1e-5);
    EXPECT_LE(arm.mostOfLimits, 1 + 1e-9);
}

// As a window repeats it, 50 ms apart.
TEST(ATipThatIsJogged, BeginsAgainOnlyWithANewPressOnceItWasEnded) {
    for (const bool restarts : {false, true}) {
        JoggedTip arm;
        const auto press = [&](double velocity) {
            const Outcome outcome =
                arm.call("/jog", "jog", {{"linear", std::vector{velocity, 0.0, 0.0}}}).outcome;
            for (int i = 0; i < 50; ++i) arm.stepJudged();
            return outcome;
        };
        ASSERT_EQ(press(0.05), Outcome::Done);
        ASSERT_EQ(arm.call("/jog", restarts ? "shutdown" : "halt").outcome, Outcome::Done);
        if (restarts) {
            for (int i = 0; i < 300; ++i) arm.stepJudged();  // longer than an order lasts
            EXPECT_EQ(arm.call("/jog", "startup").outcome, Outcome::Done);
        }
        for (int i = 0; i < 8; ++i) EXPECT_EQ(press(0.05), Outcome::Rejected) << i;
        EXPECT_EQ(arm.tipVelocity()[0], 0);
        EXPECT_FALSE(arm.get<bool>("/jog", "jogging"));
        EXPECT_EQ(press(0), Outcome::Done);
        EXPECT_EQ(press(0.05), Outcome::Done);
        EXPECT_GT(arm.tipVelocity()[0], 0);
    }
}

TEST(ATipThatIsJogged, StaysOnItsLineWhereItTurnsBackOrSlowsDown) {
    for (const double next : {-1.0, 0.05, 0.5}) {
        JoggedTip arm;
        const JoggedTip::Posture begin = arm.posture();
        for (int i = 0; i < 2500; ++i) {
            if (i % 100 == 0) arm.jog({0.25 * (i < 500 || i >= 1500 ? 1 : next), 0, 0});
            arm.stepJudged();
            arm.mostAway = std::max(arm.mostAway, arm.awayFrom(begin, {1, 0, 0}));
        }
        EXPECT_LT(arm.mostAway, 1e-5) << next;
        EXPECT_LE(arm.mostOfLimits, 1 + 1e-9);
    }
}

TEST(ATipThatIsJogged, ComesToRestBeforeItGoesAnotherWay) {
    JoggedTip arm;
    const JoggedTip::Posture begin = arm.posture();
    for (int i = 0; i < 1200; ++i) {
        if (i % 100 == 0)
            arm.jog(i < 500 ? std::vector{0.0, 0.25, 0.0} : std::vector{0.0, 0.0, 0.25});
        arm.stepJudged();
        const JoggedTip::Posture now = arm.posture();
        arm.mostAway = std::max({arm.mostAway, std::abs(now.position[0] - begin.position[0]),
                                 now.rotation.angularDistance(begin.rotation)});
    }
    EXPECT_NEAR(arm.tipVelocity()[1], 0, 1e-6);
    EXPECT_GT(arm.tipVelocity()[2], 0.1);
    EXPECT_LT(arm.mostAway, 1e-5);
    EXPECT_LE(arm.mostOfLimits, 1 + 1e-9);
}

TEST(ATipThatIsJogged, IsNotThrownFromPosturesThatAreNearlyStretched) {
    struct Case {
        JoggedTip::Start start;
        Eigen::Vector3d linear, angular;
        bool ofTip;
    };
    const std::vector<Case> cases{
        {{"0", "0", "0.0396", "0", "0", "0", "0"}, {0, 0, 0}, {0, -0.5, 0}, true},
        {{"0", "0", "0", "0", "0", "0", "0"}, {0, 0, 0}, {0, 0.05, 0}, false},
        {{"0", "0", "-0.0283", "0", "0.0298", "-0.0270", "0"}, {0, 0, 0}, {0, 0, -0.5}, false},
        {{"0.0203", "-0.0344", "0", "0", "0.023", "0", "-0.0066"}, {0, 0, -0.25}, {0, 0, 0}, false},
        {{"0", "0", "0", "0", "0", "0", "0"}, {0.25, 0, 0}, {0, 0, 0}, false},
        {{"0.3", "0.5", "0.2", "-0.02", "0.1", "0.7", "0.1"}, {0, 0, 0}, {0, 0, -0.5}, false},
        {{"-0.739", "0.992", "-2.064", "-0.1", "2.226", "-0.361", "1.485"},
         {0, 0, 0},
         {0.5, 0, 0},
         true},
        {{"0.764", "-1.221", "0.76", "-0.02", "1.241", "0.225", "-1.409"},
         {0, 0, -0.25},
         {0, 0, 0},
         false}};
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Case& each = cases[i];
        JoggedTip arm{each.start};
        if (each.ofTip) arm.call("/jog", "set", {{"frame", std::int64_t{1}}});
        arm.jogStraight(1200, each.linear, each.angular, each.ofTip);
        EXPECT_LT(arm.mostAway, 2e-3) << i;
        EXPECT_LE(arm.mostOfLimits, 1 + 1e-9) << i;
    }
}

TEST(ATipThatIsJogged, ComesToRestOnItsStraightWayBeforeTheArmIsStretched) {
    for (const JoggedTip::Start& start :
         {JoggedTip::Start{"0", "0.6", "0", "-0.3", "0", "0.6", "0"},
          {"0.3", "0.6", "0", "-0.1", "0", "0.9", "0"},
          JoggedTip::bent}) {
        JoggedTip arm{start};
        const JoggedTip::Posture begin = arm.posture();
        double slowest = 0;  // of the elbow, which must not swing back
        for (int i = 0; i < 3000; ++i) {
            if (i % 100 == 0) arm.jog({0.25, 0, 0});
            arm.stepJudged();
            slowest = std::min(slowest, arm.demand(3, "velocity"));
            arm.mostAway = std::max(arm.mostAway, arm.awayFrom(begin, {1, 0, 0}));
        }
        EXPECT_EQ(arm.heldBack(), 3) << "a singular posture";
        EXPECT_LT(std::abs(arm.demand(3, "velocity")), 1e-3);
        EXPECT_GT(slowest, -1e-3);
        const double reached = arm.tip()[0];
        arm.rest();
        arm.jogStraight(1000, {-0.1, 0, 0});
        EXPECT_LT(arm.tip()[0], reached - 0.03) << "the way back is free";
        EXPECT_LT(arm.mostAway, 1e-4);
        EXPECT_LE(arm.mostOfLimits, 1 + 1e-9);
    }
}

TEST(ATipThatIsJogged, StaysWhereAStretchedArmCannotGoThatWay) {
    JoggedTip arm{{"0", "0", "0", "0", "0", "0", "0"}};
    const std::vector<double> before = arm.tip();
    arm.jogFor(500, {0, 0, -0.1});
    EXPECT_EQ(arm.heldBack(), 3);
    EXPECT_EQ(arm.tip(), before);
}

TEST(AnElbowThatIsJogged, TurnsWhileTheTipStays) {
    JoggedTip arm;
    const std::vector<double> before = arm.tip();
    const double elbow = arm.demand(2, "position");
    for (int i = 0; i < 1500; ++i) {
        if (i % 100 == 0) arm.cluster().send("/jog", "elbow", {{"velocity", 0.3}});
        arm.stepJudged();
    }
    arm.rest();

    EXPECT_GT(std::abs(arm.demand(2, "position") - elbow), 0.05);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(arm.tip()[i], before[i], 1e-3) << i;
    EXPECT_LE(arm.mostOfLimits, 1 + 1e-9);
}

TEST(AnElbowThatIsJogged, KeepsTheTurnOfTheTipAlsoWhereTurnsDoNotCount) {
    JoggedTip arm{JoggedTip::bent, {{"directions", "true true true false false false"}}};
    const JoggedTip::Posture before = arm.posture();
    const double elbow = arm.demand(2, "position");
    for (int i = 0; i < 1000; ++i) {
        if (i % 100 == 0) arm.cluster().send("/jog", "elbow", {{"velocity", 0.3}});
        arm.stepJudged();
    }
    EXPECT_GT(std::abs(arm.demand(2, "position") - elbow), 0.05);
    EXPECT_LT((arm.posture().position - before.position).norm(), 1e-4);
    EXPECT_LT(arm.posture().rotation.angularDistance(before.rotation), 1e-4);
}

// Three linear axes: fewer than six directions.
struct Gantry : Rig {
    explicit Gantry(const std::string& directions) {
        Pairs relates;
        for (const auto& [number, direction] :
             {std::pair{"1", "1 0 0"}, {"2", "0 1 0"}, {"3", "0 0 1"}}) {
            const std::string axis = std::string{"/axis"} + number;
            const std::string demand = std::string{"/demand"} + number;
            add(axis, "LinearAxisObservation", {}, {{"direction", direction}});
            add(demand, "LinearAxisConcept", {}, {{"direction", direction}});
            relates.emplace_back("axes", axis);
            relates.emplace_back("demands", demand);
        }
        add("/jog", "CartesianJogController", relates, {{"directions", directions}});
    }
};

TEST(ATipThatIsJogged, MovesByFewerThanSixAxesInTheDirectionsThatCount) {
    Gantry gantry{"true true true false false false"};
    gantry.start();
    gantry.startUp();
    for (int i = 0; i < 1000; ++i) {
        if (i % 100 == 0) {
            gantry.cluster().send("/jog", "jog", {{"linear", std::vector{0.1, -0.05, 0.02}}});
        }
        gantry.step();
    }
    EXPECT_NEAR(gantry.get<double>("/demand1", "velocity"), 0.1, 1e-9);
    EXPECT_NEAR(gantry.get<double>("/demand2", "velocity"), -0.05, 1e-9);
    EXPECT_NEAR(gantry.get<double>("/demand3", "velocity"), 0.02, 1e-9);

    const CallResult turned = gantry.call("/jog", "jog", {{"angular", std::vector{0.1, 0.0, 0.0}}});
    EXPECT_EQ(turned.outcome, Outcome::Rejected);
    const CallResult elbow = gantry.call("/jog", "elbow", {{"velocity", 0.1}});
    EXPECT_EQ(elbow.outcome, Outcome::Rejected);
    EXPECT_NE(elbow.text().find("no axis is to spare"), std::string::npos) << elbow.text();
}

TEST(ATipThatIsJogged, IsRefusedAtTheStartWhereTheAxesAreTooFew) {
    Gantry gantry{"true true true true true true"};
    try {
        gantry.start();
        ADD_FAILURE() << "three axes took six directions";
    } catch (const Error& error) {
        EXPECT_NE(std::string{error.what()}.find("3 axes cannot follow 6 directions"),
                  std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace cortex::toolkit::test
