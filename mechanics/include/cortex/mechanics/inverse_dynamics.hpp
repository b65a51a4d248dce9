// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/mechanics/serial_chain.hpp"

#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace cortex::mechanics {

// Mass and how it is spread, in the frame of the joint that moves it.
struct RigidBody {
    using Inertia = Eigen::Matrix<double, 6, 1>;

    double mass = 0;                                   // kg
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // m, of the mass
    Inertia inertia = Inertia::Zero();                 // kg.m2 about it: xx yy zz xy xz yz
};

// Why there can be no such body, and what to do; "" where there can. Its principal moments of
// inertia are 0 or more, and none is above the sum of the other two. Any thread; allocates nothing.
std::string_view finding(const RigidBody& body);

// A joint and the link that it moves. The limits of the joint do not matter.
struct DynamicJoint {
    ChainJoint joint;
    RigidBody link;
    double armature = 0;  // kg.m2 or kg: inertia of motor and gear, as the joint feels it
    double damping = 0;   // N.m.s or N.s/m: against the motion, for each unit of velocity
};

// Inverse dynamics of an open chain of rotary and linear joints on a fixed base: the efforts (N.m
// or N) that a motion needs, by the recursive method of Newton and Euler. Friction is not part of
// it, and armature counts as inertia about its own joint alone.
//   J. Y. S. Luh, M. W. Walker, R. P. C. Paul, On-line computational scheme for mechanical
//     manipulators, J. Dyn. Sys. Meas. Control 102 (1980) 69-76
// Built in the setup phase. It throws std::invalid_argument then, naming every fault. Afterwards
// nothing allocates or throws; const methods may be called from any thread.
class InverseDynamics {
public:
    using JointVector = SerialChain::JointVector;

    // `gravity`: m/s2, acceleration of what falls freely, in the base frame.
    InverseDynamics(const std::vector<DynamicJoint>& joints, const Eigen::Vector3d& gravity);

    int size() const { return static_cast<int>(links_.size()); }

    // What the last link carries beside itself, in its frame, in place of the load before.
    // False: finding() has something against it, and the load before stays.
    bool setLoad(const RigidBody& load);

    // Of the motion with these positions (rad, m), velocities and accelerations (per s, per s2),
    // each of size() joints. What is not finite gives efforts that are not.
    JointVector torques(const JointVector& positions, const JointVector& velocities,
                        const JointVector& accelerations) const;

private:
    struct Link {
        Eigen::Matrix3d rotation;  // of the joint's frame at position 0, in that of the link before
        Eigen::Vector3d offset;
        Eigen::Vector3d direction;
        bool rotary;
        double mass;
        Eigen::Vector3d centre;
        Eigen::Matrix3d inertia;
        double armature;
        double damping;
    };
    struct JointState {
        double position, velocity, acceleration;
    };
    struct Motion;
    struct Moved;

    static Moved move(const Link& link, const JointState& joint, Motion& motion);

    std::vector<Link> links_;
    RigidBody lastLink_;  // without load
    Eigen::Vector3d gravity_;
};

}  // namespace cortex::mechanics
