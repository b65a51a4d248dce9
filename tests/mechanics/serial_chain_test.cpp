// SPDX-License-Identifier: Apache-2.0
#include "cortex/mechanics/serial_chain.hpp"

#include "mechanics/lbr_chain.hpp"
#include "toolkit/allocation_counter.hpp"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

namespace cortex::mechanics {
namespace {

using test::lbrChain;
using test::lbrJoints;
using test::lbrPosture;
using JointVector = SerialChain::JointVector;
using Jacobian = SerialChain::Jacobian;

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}

    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    Eigen::Vector3d vector(double size) {
        return {between(-size, size), between(-size, size), between(-size, size)};
    }
    Eigen::Vector3d direction() {
        Eigen::Vector3d v = vector(1);
        while (v.norm() < 0.1 || v.norm() > 1) v = vector(1);
        return v.normalized();
    }
    Pose pose(double size) {
        const Eigen::AngleAxisd turn(between(-3, 3), direction());
        return {vector(size), Eigen::Quaterniond(turn)};
    }
    JointVector joints(const SerialChain& chain, double share = 1) {
        JointVector q(chain.size());
        for (int i = 0; i < chain.size(); ++i) {
            const double reach = share * (chain.max()[i] - chain.min()[i]) / 2;
            q[i] = chain.midRange()[i] + between(-reach, reach);
        }
        return q;
    }
    std::vector<ChainJoint> chainJoints(int count) {
        std::vector<ChainJoint> joints;
        for (int i = 0; i < count; ++i) {
            const bool rotary = between(0, 1) < 0.6;
            const double low = between(-2, 0);
            joints.push_back({vector(0.5), vector(3), direction(),
                              rotary ? JointKind::Rotary : JointKind::Linear, low,
                              low + between(0.5, 3), between(0.2, 2)});
        }
        return joints;
    }

private:
    std::mt19937 engine_;
};

KDL::Vector toKdl(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

KDL::Chain kdlChain(const std::vector<ChainJoint>& joints, const Pose& tip) {
    KDL::Chain chain;
    for (const ChainJoint& joint : joints) {
        const Eigen::Vector3d& turn = joint.originRotation;
        chain.addSegment(KDL::Segment(
            KDL::Joint(KDL::Joint::None),
            KDL::Frame(KDL::Rotation::RPY(turn.x(), turn.y(), turn.z()), toKdl(joint.origin))));
        const auto kind =
            joint.kind == JointKind::Rotary ? KDL::Joint::RotAxis : KDL::Joint::TransAxis;
        chain.addSegment(KDL::Segment(KDL::Joint(KDL::Vector::Zero(), toKdl(joint.direction), kind),
                                      KDL::Frame::Identity()));
    }
    const Eigen::Quaterniond& turn = tip.rotation;
    chain.addSegment(
        KDL::Segment(KDL::Joint(KDL::Joint::None),
                     KDL::Frame(KDL::Rotation::Quaternion(turn.x(), turn.y(), turn.z(), turn.w()),
                                toKdl(tip.position))));
    return chain;
}

// Largest difference in the tip's frame and in the Jacobian, over some random joint positions.
double differenceFromKdl(const std::vector<ChainJoint>& joints, const Pose& tip, Random& random,
                         int poses = 20) {
    const SerialChain chain(joints, tip);
    const KDL::Chain oracle = kdlChain(joints, tip);
    KDL::ChainFkSolverPos_recursive forward(oracle);
    KDL::ChainJntToJacSolver jacobianOf(oracle);
    KDL::JntArray kdlJoints(static_cast<unsigned>(chain.size()));
    KDL::Jacobian kdlJacobian(static_cast<unsigned>(chain.size()));
    Jacobian jacobian;
    double worst = 0;
    for (int trial = 0; trial < poses; ++trial) {
        const JointVector q = random.joints(chain);
        kdlJoints.data = q;
        KDL::Frame frame;
        forward.JntToCart(kdlJoints, frame);
        jacobianOf.JntToJac(kdlJoints, kdlJacobian);

        const Pose pose = chain.forward(q, jacobian);

        const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
        for (int row = 0; row < 3; ++row) {
            worst = std::max(worst, std::abs(pose.position[row] - frame.p(row)));
            for (int column = 0; column < 3; ++column) {
                worst = std::max(worst, std::abs(rotation(row, column) - frame.M(row, column)));
            }
        }
        worst = std::max(worst, (jacobian - kdlJacobian.data).cwiseAbs().maxCoeff());
    }
    return worst;
}

void expectWithinLimits(const SerialChain& chain, const JointVector& q) {
    ASSERT_TRUE(q.allFinite());
    for (int i = 0; i < chain.size(); ++i) {
        ASSERT_GE(q[i], chain.min()[i]) << "joint " << i + 1;
        ASSERT_LE(q[i], chain.max()[i]) << "joint " << i + 1;
    }
}

SerialChain::InverseOptions withoutPull() {
    SerialChain::InverseOptions options;
    options.posturePull = 0;
    return options;
}

TEST(SerialChain, StandsStraightUpAtTheHeightOfTheDataSheet) {
    const Pose tip = lbrChain().forward(JointVector::Zero(7));

    EXPECT_NEAR(tip.position.x(), 0, 1e-12);
    EXPECT_NEAR(tip.position.y(), 0, 1e-12);
    EXPECT_NEAR(tip.position.z(), 1.306, 1e-12);
    EXPECT_NEAR(tip.rotation.angularDistance(Eigen::Quaterniond::Identity()), 0, 1e-12);
}

TEST(SerialChain, AgreesWithKdlForTheLbr) {
    Random random(1);

    EXPECT_LT(differenceFromKdl(lbrJoints(), {{0, 0, 0.126}, {1, 0, 0, 0}}, random), 1e-14);
}

TEST(SerialChain, AgreesWithKdlForAnyMixOfRotaryAndLinearJoints) {
    Random random(2);
    for (int count = 1; count <= SerialChain::maxJoints; ++count) {
        for (int repeat = 0; repeat < 10; ++repeat) {
            const std::vector<ChainJoint> joints = random.chainJoints(count);

            ASSERT_LT(differenceFromKdl(joints, random.pose(0.4), random), 1e-12)
                << count << " joints";
        }
    }
}

int posesOfARobot() {
    const char* asked = std::getenv("CORTEX_POSES");
    return asked ? std::atoi(asked) : 100;
}

struct Robot {
    const char* name;
    std::vector<ChainJoint> joints;
    Pose tip;
};

// An arm of seven axes, one of six with a wrist, and a gantry that carries a turning wrist.
std::vector<Robot> threeRobots() {
    const auto turning = [](const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
        return ChainJoint{origin, {0, 0, 0}, direction, JointKind::Rotary, -2.6, 2.6, 2};
    };
    const auto sliding = [](const Eigen::Vector3d& direction) {
        return ChainJoint{{0, 0, 0}, {0, 0, 0}, direction, JointKind::Linear, 0, 3, 1};
    };
    return {{"seven axes", lbrJoints(), {{0, 0, 0.126}, {1, 0, 0, 0}}},
            {"six axes",
             {turning({0, 0, 0.4}, {0, 0, 1}), turning({0.05, 0, 0}, {0, 1, 0}),
              turning({0, 0, 0.45}, {0, 1, 0}), turning({0.04, 0, 0}, {1, 0, 0}),
              turning({0.42, 0, 0}, {0, 1, 0}), turning({0.08, 0, 0}, {1, 0, 0})},
             {{0.1, 0, 0}, {1, 0, 0, 0}}},
            {"a gantry with a wrist",
             {sliding({1, 0, 0}), sliding({0, 1, 0}), sliding({0, 0, -1}),
              turning({0, 0, -0.2}, {0, 0, 1}), turning({0, 0, 0}, {0, 1, 0}),
              turning({0, 0, -0.1}, {0, 0, 1})},
             {{0, 0, -0.1}, {1, 0, 0, 0}}}};
}

TEST(ThreeRobots, AgreeWithKdlAndComeBackToAPoseFromNearby) {
    Random random(7);
    for (const Robot& robot : threeRobots()) {
        EXPECT_LT(differenceFromKdl(robot.joints, robot.tip, random, posesOfARobot()), 1e-12)
            << robot.name;
        const SerialChain chain(robot.joints, robot.tip);
        int found = 0;
        double farthest = 0;
        for (int i = 0; i < posesOfARobot(); ++i) {
            const JointVector goal = random.joints(chain, 0.8);
            JointVector q = goal;
            for (int k = 0; k < q.size(); ++k) q[k] += random.between(-0.05, 0.05);
            const Pose target = chain.forward(goal);
            if (!chain.inverse(target, q).converged) continue;
            ++found;
            farthest = std::max(farthest, difference(chain.forward(q), target).norm());
        }
        EXPECT_GE(found, posesOfARobot() * 99 / 100) << robot.name;
        EXPECT_LE(farthest, 1e-6) << robot.name;
        std::cout << robot.name << ": " << found << " of " << posesOfARobot()
                  << " poses found, farthest " << farthest << "\n";
    }
}

TEST(SerialChain, DifferenceIsTheTwistThatLeadsFromOnePoseToTheOther) {
    Random random(3);
    for (int trial = 0; trial < 100; ++trial) {
        const Pose from = random.pose(1);
        const Eigen::Vector3d turn = random.between(0, 3.1) * random.direction();
        const Eigen::Quaterniond rotation(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
        const Eigen::Vector3d step = random.vector(1);

        const Twist twist = difference(from, {from.position + step, rotation * from.rotation});

        ASSERT_LT((twist.head<3>() - step).norm(), 1e-12);
        ASSERT_LT((twist.tail<3>() - turn).norm(), 1e-9);
    }
}

TEST(SerialChain, ServoStepsConvergeWithinTheLimits) {
    const SerialChain chain = lbrChain();
    Random random(4);
    int iterations = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const JointVector goal = random.joints(chain, 0.9);
        const Pose target = chain.forward(goal);
        JointVector q = goal;
        for (int i = 0; i < q.size(); ++i) q[i] += random.between(-0.02, 0.02);

        const InverseResult result = chain.inverse(target, q);

        ASSERT_TRUE(result.converged) << "trial " << trial << ", residual " << result.residual;
        ASSERT_LT(difference(chain.forward(q), target).norm(), 1e-6);
        expectWithinLimits(chain, q);
        iterations += result.iterations;
    }
    EXPECT_LT(iterations, 1000 * 5);
}

TEST(SerialChain, FindsMostRandomTargetsAndNeverLeavesTheLimits) {
    const SerialChain chain = lbrChain();
    SerialChain::InverseOptions options;
    options.maxIterations = 200;
    Random random(5);
    int found = 0;
    const int trials = 500;
    for (int trial = 0; trial < trials; ++trial) {
        const Pose target = chain.forward(random.joints(chain));
        JointVector q = random.joints(chain);

        const InverseResult result = chain.inverse(target, q, chain.midRange(), options);

        expectWithinLimits(chain, q);
        ASSERT_NEAR(result.residual, difference(chain.forward(q), target).norm(), 1e-12);
        ASSERT_EQ(result.converged, result.residual < options.tolerance);
        if (result.converged) ++found;
    }
    RecordProperty("percentFound", 100 * found / trials);
    EXPECT_GT(found, trials * 3 / 4);
}

TEST(SerialChain, InverseOfRandomMixedChainsUndoesForward) {
    Random random(6);
    int found = 0;
    for (int trial = 0; trial < 500; ++trial) {
        const SerialChain chain(random.chainJoints(6 + trial % 11), random.pose(0.3));
        const JointVector goal = random.joints(chain, 0.8);
        JointVector q = goal;
        for (int i = 0; i < q.size(); ++i) q[i] += random.between(-0.05, 0.05);

        const InverseResult result = chain.inverse(chain.forward(goal), q);

        expectWithinLimits(chain, q);
        if (result.converged) ++found;
    }
    EXPECT_GE(found, 495);
}

TEST(SerialChain, UnreachableTargetsEndNearbyWithinTheLimits) {
    const SerialChain chain = lbrChain();
    Random random(7);
    for (int trial = 0; trial < 200; ++trial) {
        const Eigen::Vector3d farAway = random.between(1.5, 10) * random.direction();
        const Pose target{farAway, random.pose(0).rotation};
        JointVector q = random.joints(chain);
        const double before = difference(chain.forward(q), target).norm();

        const InverseResult result = chain.inverse(target, q);

        ASSERT_FALSE(result.converged);
        ASSERT_TRUE(std::isfinite(result.residual));
        ASSERT_LT(result.residual, before);
        expectWithinLimits(chain, q);
    }
}

TEST(SerialChain, StretchesTowardsATargetOutOfReach) {
    const SerialChain chain = lbrChain();
    JointVector q = lbrPosture();
    const Pose target{{2, 0, 0.36}, chain.forward(q).rotation};

    SerialChain::InverseOptions options = withoutPull();
    options.maxIterations = 500;
    const InverseResult result = chain.inverse(target, q, q, options);

    EXPECT_FALSE(result.converged);
    EXPECT_GT(chain.forward(q).position.x(), 0.7);
}

TEST(SerialChain, EscapesTheStretchedPosture) {
    const SerialChain chain = lbrChain();
    JointVector q = JointVector::Constant(7, 1e-3);
    Pose target = chain.forward(lbrPosture());

    SerialChain::InverseOptions options;
    options.maxIterations = 200;
    const InverseResult result = chain.inverse(target, q, lbrPosture(), options);

    EXPECT_TRUE(result.converged) << result.residual;
}

TEST(SerialChain, MovesNoJointFasterThanItsSpeedInOnePeriod) {
    const SerialChain chain = lbrChain();
    SerialChain::InverseOptions options;
    options.period = 0.001;
    Random random(8);
    for (int trial = 0; trial < 200; ++trial) {
        const JointVector start = random.joints(chain);
        JointVector q = start;

        chain.inverse(chain.forward(random.joints(chain)), q, chain.midRange(), options);

        for (int i = 0; i < q.size(); ++i) {
            ASSERT_LE(std::abs(q[i] - start[i]), 0.001 * chain.maxSpeed()[i] + 1e-12);
        }
        expectWithinLimits(chain, q);
    }
}

TEST(SerialChain, PullsTowardsThePostureWithoutMovingTheTip) {
    const SerialChain chain = lbrChain();
    JointVector q = lbrPosture();
    q[2] += 0.5;
    chain.inverse(chain.forward(lbrPosture()), q, q, withoutPull());
    JointVector unpulled = q;
    const double before = (q - lbrPosture()).norm();
    const Pose start = chain.forward(q);
    for (int step = 1; step <= 3000; ++step) {
        const double way = 0.1 * std::sin(step * 2 * std::numbers::pi / 1000);
        const Pose target{start.position + Eigen::Vector3d(0, way, 0), start.rotation};

        ASSERT_TRUE(chain.inverse(target, q, lbrPosture(), {}).converged);
        ASSERT_TRUE(chain.inverse(target, unpulled, lbrPosture(), withoutPull()).converged);

        ASSERT_LT(difference(chain.forward(q), target).norm(), 1e-6);
    }
    EXPECT_GT(before, 0.3);
    EXPECT_LT((q - lbrPosture()).norm(), 0.4 * before);
    EXPECT_GT((unpulled - lbrPosture()).norm(), 0.8 * before);
}

TEST(SerialChain, StandsStillWhereTheTargetStandsStill) {
    const SerialChain chain = lbrChain();
    const JointVector start = lbrPosture();
    JointVector q = start;

    const InverseResult result = chain.inverse(chain.forward(start), q);

    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.iterations, 0);
    EXPECT_EQ(q, start);
}

TEST(SerialChain, BringsAStartOutsideTheLimitsBackIntoThem) {
    const SerialChain chain = lbrChain();
    JointVector q = 2 * chain.max();

    chain.inverse(chain.forward(lbrPosture()), q);

    expectWithinLimits(chain, q);
}

TEST(SerialChain, LeavesTheJointsAloneWhenTheTargetOrStartIsNoNumber) {
    const SerialChain chain = lbrChain();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    const std::vector<Pose> targets = {{{nan, 0, 0}, {1, 0, 0, 0}},
                                       {{0, infinite, 0}, {1, 0, 0, 0}},
                                       {{0, 0, 1}, {nan, 0, 0, 0}},
                                       {{0, 0, 1}, {0, 0, 0, 0}}};
    for (const Pose& target : targets) {
        JointVector q = lbrPosture();

        const InverseResult result = chain.inverse(target, q);

        EXPECT_FALSE(result.converged);
        EXPECT_EQ(q, lbrPosture());
    }
    JointVector q = lbrPosture();
    q[3] = nan;
    EXPECT_FALSE(chain.inverse(chain.forward(lbrPosture()), q).converged);
    EXPECT_EQ(q[0], lbrPosture()[0]);
}

TEST(SerialChain, IsRepeatableToTheBit) {
    const SerialChain chain = lbrChain();
    Random random(9);
    for (int trial = 0; trial < 50; ++trial) {
        const Pose target = chain.forward(random.joints(chain));
        const JointVector start = random.joints(chain);
        JointVector first = start;
        JointVector second = start;

        chain.inverse(target, first);
        chain.inverse(target, second);

        ASSERT_EQ(first, second);
    }
}

TEST(SerialChain, AllocatesNothingAfterConstruction) {
    Random random(10);
    for (const int count : {1, 6, 7, 16}) {
        const SerialChain chain(random.chainJoints(count), random.pose(0.3));
        const Pose target = chain.forward(random.joints(chain));
        JointVector q = random.joints(chain);
        Jacobian jacobian;

        const auto before = toolkit::test::allocationCount();
        chain.forward(q, jacobian);
        chain.inverse(target, q);
        chain.inverse(random.pose(20), q);
        EXPECT_EQ(toolkit::test::allocationCount(), before) << count << " joints";
    }
}

TEST(SerialChain, RefusesAFaultyDescriptionAndNamesEveryFault) {
    std::vector<ChainJoint> joints = lbrJoints();
    joints[1].direction = {0, 2, 0};
    joints[2].min = joints[2].max;
    joints[4].maxSpeed = 0;
    joints[5].origin.x() = std::numeric_limits<double>::infinity();
    std::string message;
    try {
        SerialChain chain(joints);
    } catch (const std::invalid_argument& error) {
        message = error.what();
    }

    for (const char* part :
         {"joint 2: direction", "joint 3: limits", "joint 5: maxSpeed", "joint 6: origin"}) {
        EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
    }
}

TEST(SerialChain, RefusesNoJointsAndMoreThanSixteen) {
    EXPECT_THROW(SerialChain(std::vector<ChainJoint>()), std::invalid_argument);
    EXPECT_THROW(SerialChain(std::vector<ChainJoint>(17, lbrJoints()[0])), std::invalid_argument);
}

}  // namespace
}  // namespace cortex::mechanics
