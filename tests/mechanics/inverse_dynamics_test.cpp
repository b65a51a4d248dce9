// SPDX-License-Identifier: Apache-2.0
#include "cortex/mechanics/inverse_dynamics.hpp"

#include "mechanics/lbr_chain.hpp"
#include "toolkit/allocation_counter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>

namespace cortex::mechanics {
namespace {

using test::lbrDynamics;
using test::lbrPosture;
using Efforts = InverseDynamics::JointVector;

const Eigen::Vector3d downwards{0, 0, -9.80665};

// The motion of all joints at one time.
struct Motion {
    Efforts positions, velocities, accelerations;
};

class RandomRobots {
public:
    explicit RandomRobots(unsigned seed) : engine_{seed} {}

    double between(double low, double high) {
        return std::uniform_real_distribution<double>{low, high}(engine_);
    }
    Eigen::Vector3d vector(double size) {
        return {between(-size, size), between(-size, size), between(-size, size)};
    }
    Efforts joints(int count, double size) {
        return Efforts::NullaryExpr(count, [this, size] { return between(-size, size); });
    }
    Motion motion(int count) { return {joints(count, 3), joints(count, 2), joints(count, 10)}; }
    // A box with its sides turned anyhow, so that no product of inertia is 0.
    RigidBody body() {
        const double mass = between(0.1, 10);
        const Eigen::Vector3d sides = (vector(0.5).cwiseAbs().array() + 0.02).matrix();
        const Eigen::Vector3d squares = sides.cwiseAbs2();
        const Eigen::Vector3d moments =
            mass / 12 * (squares.sum() * Eigen::Vector3d::Ones() - squares);
        return {mass, vector(0.3), turned(moments)};
    }
    RigidBody::Inertia turned(const Eigen::Vector3d& moments) {
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd{between(-3, 3), vector(1).normalized()}.toRotationMatrix();
        const Eigen::Matrix3d all = turn * moments.asDiagonal() * turn.transpose();
        RigidBody::Inertia inertia;
        inertia << all(0, 0), all(1, 1), all(2, 2), all(0, 1), all(0, 2), all(1, 2);
        return inertia;
    }
    std::vector<DynamicJoint> mixed(int count) {
        std::vector<DynamicJoint> joints;
        for (int i = 0; i < count; ++i) {
            const JointKind kind = i % 3 == 1 ? JointKind::Linear : JointKind::Rotary;
            joints.push_back({{vector(0.5), vector(3), vector(1).normalized(), kind},
                              body(),
                              between(0, 1),
                              between(0, 1)});
        }
        return joints;
    }
    std::vector<DynamicJoint> gantry() {
        const auto slide = [this](const Eigen::Vector3d& direction) {
            return DynamicJoint{
                {{0, 0, 0.2}, {0, 0, 0}, direction, JointKind::Linear}, body(), 2, 3};
        };
        return {slide({1, 0, 0}), slide({0, 1, 0}), slide({0, 0, -1})};
    }

private:
    std::mt19937 engine_;
};

KDL::Vector kdlVector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

KDL::Chain massesInKdl(const std::vector<DynamicJoint>& joints) {
    KDL::Chain chain;
    for (const DynamicJoint& each : joints) {
        const Eigen::Vector3d& turn = each.joint.originRotation;
        const auto& [mass, centre, inertia] = each.link;
        chain.addSegment(KDL::Segment{KDL::Joint{KDL::Joint::None},
                                      KDL::Frame{KDL::Rotation::RPY(turn.x(), turn.y(), turn.z()),
                                                 kdlVector(each.joint.origin)}});
        const auto kind =
            each.joint.kind == JointKind::Rotary ? KDL::Joint::RotAxis : KDL::Joint::TransAxis;
        chain.addSegment(KDL::Segment{
            KDL::Joint{KDL::Vector::Zero(), kdlVector(each.joint.direction), kind},
            KDL::Frame::Identity(),
            KDL::RigidBodyInertia{mass, kdlVector(centre),
                                  KDL::RotationalInertia{inertia[0], inertia[1], inertia[2],
                                                         inertia[3], inertia[4], inertia[5]}}});
    }
    return chain;
}

// The largest difference, as a share of the largest effort. KDL is asked for the masses alone.
double dynamicsApartFromKdl(const std::vector<DynamicJoint>& joints, int states,
                            RandomRobots& random) {
    const InverseDynamics dynamics{joints, downwards};
    const KDL::Chain chain = massesInKdl(joints);
    KDL::ChainIdSolver_RNE solver{chain, kdlVector(downwards)};
    const int count = dynamics.size();
    const auto size = static_cast<unsigned>(count);
    KDL::JntArray q{size}, v{size}, a{size}, result{size};
    double worst = 0;
    for (int state = 0; state < states; ++state) {
        const Motion motion = random.motion(count);
        q.data = motion.positions;
        v.data = motion.velocities;
        a.data = motion.accelerations;
        const KDL::Wrenches none(chain.getNrOfSegments(), KDL::Wrench::Zero());
        EXPECT_EQ(solver.CartToJnt(q, v, a, none, result), 0);
        Efforts expected = result.data;
        for (int i = 0; i < count; ++i) {
            const DynamicJoint& each = joints[static_cast<std::size_t>(i)];
            expected[i] += each.armature * a.data[i] + each.damping * v.data[i];
        }
        const Efforts efforts =
            dynamics.torques(motion.positions, motion.velocities, motion.accelerations);
        const double scale = std::max(1.0, expected.cwiseAbs().maxCoeff());
        worst = std::max(worst, (efforts - expected).cwiseAbs().maxCoeff() / scale);
    }
    return worst;
}

TEST(InverseDynamics, AgreesWithKdlForTheLbr) {
    RandomRobots random{1};
    EXPECT_LT(dynamicsApartFromKdl(lbrDynamics(), 1000, random), 1e-9);
}

TEST(InverseDynamics, AgreesWithKdlForAGantry) {
    RandomRobots random{2};
    EXPECT_LT(dynamicsApartFromKdl(random.gantry(), 1000, random), 1e-9);
}

TEST(InverseDynamics, AgreesWithKdlForAnyMixOfRotaryAndLinearJoints) {
    RandomRobots random{3};
    for (int count = 1; count <= SerialChain::maxJoints; ++count) {
        EXPECT_LT(dynamicsApartFromKdl(random.mixed(count), 70, random), 1e-9)
            << count << " joints";
    }
}

TEST(InverseDynamics, HoldsTheLbrWithTheTorquesOfItsWeight) {
    const InverseDynamics dynamics{lbrDynamics(), downwards};
    const Efforts still = Efforts::Zero(7);

    const Efforts efforts = dynamics.torques(lbrPosture(), still, still);

    Efforts expected{7};
    expected << 0, -52.771484, -0.480523, 20.973181, -0.648991, -0.049862, 0;
    EXPECT_LT((efforts - expected).cwiseAbs().maxCoeff(), 1e-6) << efforts.transpose();
}

// Kinetic and potential energy, from the kinematics of each link alone.
double energy(const std::vector<DynamicJoint>& joints, const Efforts& positions,
              const Efforts& velocities) {
    double sum = 0;
    std::vector<ChainJoint> chain;
    for (const DynamicJoint& each : joints) {
        chain.push_back(each.joint);
        chain.back().min = -1;
        chain.back().max = chain.back().maxSpeed = 1;
        const auto count = static_cast<Eigen::Index>(chain.size());
        SerialChain::Jacobian jacobian;
        const Pose pose = SerialChain{chain, {each.link.centre, {1, 0, 0, 0}}}.forward(
            positions.head(count), jacobian);
        const Twist twist = jacobian.lazyProduct(velocities.head(count));
        const Eigen::Vector3d turn = pose.rotation.conjugate() * twist.tail<3>();
        const auto& inertia = each.link.inertia;
        const double turning =
            inertia[0] * turn.x() * turn.x() + inertia[1] * turn.y() * turn.y() +
            inertia[2] * turn.z() * turn.z() +
            2 * (inertia[3] * turn.x() * turn.y() + inertia[4] * turn.x() * turn.z() +
                 inertia[5] * turn.y() * turn.z());
        const double speed = velocities[count - 1];
        sum += each.link.mass * (twist.head<3>().squaredNorm() / 2 - downwards.dot(pose.position)) +
               turning / 2 + each.armature * speed * speed / 2;
    }
    return sum;
}

TEST(InverseDynamics, SpendsThePowerThatGoesIntoEnergyAndDamping) {
    RandomRobots random{4};
    for (int trial = 0; trial < 20; ++trial) {
        const std::vector<DynamicJoint> joints = random.mixed(1 + trial % 8);
        const InverseDynamics dynamics{joints, downwards};
        const auto [q, v, a] = random.motion(dynamics.size());
        const auto energyAt = [&](double time) {
            return energy(joints, q + time * v + time * time / 2 * a, v + time * a);
        };
        double power = dynamics.torques(q, v, a).dot(v);
        for (int i = 0; i < v.size(); ++i)
            power -= joints[static_cast<std::size_t>(i)].damping * v[i] * v[i];

        const double h = 1e-4;
        const double change =
            (8 * (energyAt(h) - energyAt(-h)) - energyAt(2 * h) + energyAt(-2 * h)) / (12 * h);
        EXPECT_NEAR(power, change, 1e-6 * std::max(1.0, energyAt(0))) << joints.size() << " joints";
    }
}

TEST(InverseDynamics, TakesALoadForAHeavierLastLink) {
    RandomRobots random{5};
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<DynamicJoint> joints = random.mixed(4);
        const RigidBody load = random.body();
        InverseDynamics loaded{joints, downwards};
        ASSERT_TRUE(loaded.setLoad(random.body()));  // replaced by the next one
        ASSERT_TRUE(loaded.setLoad(load));
        // The load on a joint of its own that never moves.
        joints.push_back({{{0, 0, 0}, {0, 0, 0}, {0, 0, 1}, JointKind::Rotary}, load});
        Motion motion = random.motion(5);
        motion.positions[4] = motion.velocities[4] = motion.accelerations[4] = 0;

        const Efforts heavier = InverseDynamics{joints, downwards}.torques(
            motion.positions, motion.velocities, motion.accelerations);
        const Efforts efforts = loaded.torques(motion.positions.head(4), motion.velocities.head(4),
                                               motion.accelerations.head(4));

        EXPECT_LT((efforts - heavier.head(4)).cwiseAbs().maxCoeff(), 1e-9 * heavier.norm());
        EXPECT_GT((InverseDynamics{{joints.begin(), joints.end() - 1}, downwards}.torques(
                       motion.positions.head(4), motion.velocities.head(4),
                       motion.accelerations.head(4)) -
                   efforts)
                      .norm(),
                  1e-3);
    }
}

TEST(InverseDynamics, KeepsItsLoadWhereThereCanBeNoSuchOne) {
    InverseDynamics dynamics{lbrDynamics(), downwards};
    const Efforts still = Efforts::Zero(7);
    ASSERT_TRUE(dynamics.setLoad({2, {0, 0, 0.1}, RigidBody::Inertia::Zero()}));
    const Efforts before = dynamics.torques(lbrPosture(), still, still);

    EXPECT_FALSE(dynamics.setLoad({-1, {0, 0, 0}, RigidBody::Inertia::Zero()}));

    EXPECT_EQ(dynamics.torques(lbrPosture(), still, still), before);
}

RigidBody::Inertia inertiaOf(double xx, double yy, double zz, double xy = 0) {
    RigidBody::Inertia inertia;
    inertia << xx, yy, zz, xy, 0, 0;
    return inertia;
}

TEST(RigidBodies, CanBePointsRodsAndPlates) {
    EXPECT_EQ(finding({0, {1, 0, 0}, inertiaOf(0, 0, 0)}), "");
    EXPECT_EQ(finding({1, {1, 0, 0}, inertiaOf(0, 0, 0)}), "");
    EXPECT_EQ(finding({1, {0, 0, 0}, inertiaOf(0.1, 0.1, 0)}), "");
    RandomRobots random{7};
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(finding({1, {0, 0, 0}, random.turned({0.1, 0.1, 0})}), "");
        EXPECT_EQ(finding({1, {0, 0, 0}, random.turned({0.1, 0.2, 0.3})}), "");
    }
}

TEST(RigidBodies, AreRefusedWithAReason) {
    const auto why = [](double mass, const RigidBody::Inertia& inertia) {
        return finding({mass, {0, 0, 0}, inertia});
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::string_view notFinite = "mass, centre or inertia is not finite: give numbers";
    EXPECT_EQ(why(nan, inertiaOf(1, 1, 1)), notFinite);
    EXPECT_EQ(why(1, inertiaOf(1, nan, 1)), notFinite);
    EXPECT_EQ(finding({1, {0, nan, 0}, inertiaOf(1, 1, 1)}), notFinite);
    EXPECT_EQ(why(-1, inertiaOf(1, 1, 1)), "mass is below 0: give 0 or more");
    EXPECT_EQ(why(0, inertiaOf(1, 1, 1)), "inertia without a mass: give the mass, too");
    EXPECT_EQ(why(1, inertiaOf(1, 1, 1, 1.5)),
              "inertia has a principal moment below 0: check its numbers and their order, xx yy zz "
              "xy xz yz");
    EXPECT_EQ(why(1, inertiaOf(0.1, 0.2, 0.31)),
              "inertia has a principal moment above the sum of the other two: give it about the "
              "centre of mass");
}

std::string refusalOf(const std::vector<DynamicJoint>& joints, const Eigen::Vector3d& gravity) {
    try {
        const InverseDynamics dynamics{joints, gravity};
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "none";
}

TEST(InverseDynamics, RefusesAFaultyDescriptionAndNamesEveryFault) {
    const double infinite = std::numeric_limits<double>::infinity();
    std::vector<DynamicJoint> joints = lbrDynamics();
    joints[0].joint.origin.x() = infinite;
    joints[1].joint.direction = {0, 2, 0};
    joints[2].link.mass = -1;
    joints[3].armature = -0.1;
    joints[4].damping = infinite;

    EXPECT_EQ(refusalOf(joints, {0, 0, infinite}),
              "inverse dynamics refused:"
              "\n  joint 1: origin is not finite: give numbers"
              "\n  joint 2: direction is no unit vector: give it the length 1"
              "\n  joint 3: mass is below 0: give 0 or more"
              "\n  joint 4: armature is not finite or below 0: give 0 or more"
              "\n  joint 5: damping is not finite or below 0: give 0 or more"
              "\n  gravity is not finite: give numbers");
}

TEST(InverseDynamics, RefusesNoJointsAndMoreThanSixteen) {
    EXPECT_EQ(refusalOf({}, downwards), "inverse dynamics refused:\n  has 0 joints: give 1 to 16");
    EXPECT_EQ(refusalOf(std::vector<DynamicJoint>(17, lbrDynamics()[0]), downwards),
              "inverse dynamics refused:\n  has 17 joints: give 1 to 16");
}

TEST(InverseDynamics, AllocatesNothingAfterConstruction) {
    RandomRobots random{6};
    for (const int count : {1, 7, 16}) {
        InverseDynamics dynamics{random.mixed(count), downwards};
        const RigidBody load = random.body();
        const Motion motion = random.motion(count);

        const auto before = toolkit::test::allocationCount();
        EXPECT_TRUE(dynamics.setLoad(load));
        dynamics.torques(motion.positions, motion.velocities, motion.accelerations);
        EXPECT_EQ(toolkit::test::allocationCount(), before) << count << " joints";
    }
}

}  // namespace
}  // namespace cortex::mechanics
