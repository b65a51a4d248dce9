// SPDX-License-Identifier: Apache-2.0
#include "cortex/mechanics/tip_velocity.hpp"

#include "mechanics/lbr_chain.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace cortex::mechanics {
namespace {

using test::lbrChain;
using test::lbrPosture;

constexpr Directions everyDirection{true, true, true, true, true, true};

SerialChain::Jacobian jacobianAt(const SerialChain& chain, const SerialChain::JointVector& joints) {
    SerialChain::Jacobian jacobian;
    chain.forward(joints, jacobian);
    return jacobian;
}

TEST(VelocitiesOfJoints, MoveTheTipAsAskedForAwayFromSingularPostures) {
    const SerialChain chain = lbrChain();
    std::mt19937 random{41};
    std::uniform_real_distribution<double> between{-1, 1};
    int tried = 0;
    while (tried < 1000) {
        SerialChain::JointVector joints(7);
        for (int i = 0; i < 7; ++i) joints[i] = 2 * between(random);
        const auto jacobian = jacobianAt(chain, joints);
        Twist tip;
        for (int i = 0; i < 6; ++i) tip[i] = between(random);
        const TipVelocity found = jointVelocities(jacobian, tip, everyDirection);
        if (found.lost > 0) continue;
        ++tried;
        ASSERT_LT((jacobian * found.joints - tip).norm(), 1e-9) << tried;
    }
}

TEST(VelocitiesOfJoints, MoveTheTipAsAskedForHoweverFarTheArmIsStretched) {
    const SerialChain chain = lbrChain();
    Twist outwards = Twist::Zero();
    outwards[2] = 0.1;
    double before = 0;
    for (const double bent : {0.9, 0.3, 0.1}) {
        SerialChain::JointVector joints = SerialChain::JointVector::Zero(7);
        joints[3] = bent;
        joints[5] = bent;
        const auto jacobian = jacobianAt(chain, joints);
        const TipVelocity found = jointVelocities(jacobian, outwards, everyDirection);
        EXPECT_LT((jacobian * found.joints - outwards).norm(), 1e-7) << bent;
        EXPECT_GT(found.joints.norm(), 2 * before) << bent << ": faster joints, the same tip";
        EXPECT_GT(found.needs[0], 0.5) << bent;
        before = found.joints.norm();
    }
}

TEST(VelocitiesOfJoints, SayWhatIsLostWhereTheArmIsStretched) {
    const SerialChain chain = lbrChain();
    const auto jacobian = jacobianAt(chain, SerialChain::JointVector::Zero(7));
    Twist tip = Twist::Zero();
    tip[2] = 0.1;  // along the arm
    const TipVelocity along = jointVelocities(jacobian, tip, everyDirection);
    EXPECT_NEAR(along.lost, 1, 1e-9);
    EXPECT_NEAR(along.joints.norm(), 0, 1e-6);
    tip = Twist::Zero();
    tip[5] = 0.1;  // about the arm
    const TipVelocity about = jointVelocities(jacobian, tip, everyDirection);
    EXPECT_NEAR(about.lost, 0, 1e-9);
    EXPECT_LT((jacobian * about.joints - tip).norm(), 1e-9);
}

TEST(VelocitiesOfJoints, CountOnlyTheDirectionsThatAreAskedFor) {
    const std::vector<ChainJoint> sliding{
        {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, JointKind::Linear, -1, 1, 1},
        {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}, JointKind::Linear, -1, 1, 1},
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}, JointKind::Linear, -1, 1, 1}};
    const SerialChain gantry{sliding};
    Twist tip;
    tip << 0.1, -0.2, 0.3, 7, 8, 9;
    const TipVelocity found = jointVelocities(jacobianAt(gantry, SerialChain::JointVector::Zero(3)),
                                              tip, {true, true, true, false, false, false});
    EXPECT_NEAR(found.joints[0], 0.1, 1e-12);
    EXPECT_NEAR(found.joints[1], -0.2, 1e-12);
    EXPECT_NEAR(found.joints[2], 0.3, 1e-12);
    EXPECT_EQ(found.lost, 0);
}

TEST(ASelfMotion, TurnsTheElbowAndLeavesTheTip) {
    const SerialChain chain = lbrChain();
    SerialChain::JointVector joints = lbrPosture();
    SerialChain::JointVector before = SerialChain::JointVector::Zero(7);
    for (int i = 0; i < 500; ++i) {
        const auto jacobian = jacobianAt(chain, joints);
        const auto motion = selfMotion(jacobian, everyDirection, before);
        ASSERT_NEAR(motion.norm(), 1, 1e-12);
        ASSERT_LT((jacobian * motion).norm(), 1e-9);
        if (i > 0) {
            ASSERT_GT(motion.dot(before), 0.9) << "it does not turn back";
        }
        before = motion;
        joints += 1e-3 * motion;
    }
    EXPECT_GT((joints - lbrPosture()).norm(), 0.4);
}

TEST(ASelfMotion, IsNoneWhereEveryAxisIsNeeded) {
    const SerialChain chain = lbrChain();
    const auto jacobian = jacobianAt(chain, lbrPosture());
    SerialChain::Jacobian six = jacobian.leftCols(6);
    EXPECT_EQ(selfMotion(six, everyDirection, SerialChain::JointVector::Zero(6)).norm(), 0);
}

}  // namespace
}  // namespace cortex::mechanics
