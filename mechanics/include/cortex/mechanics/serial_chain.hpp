// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace cortex::mechanics {

// Position (m) and rotation of a frame. The rotation is a unit quaternion.
struct Pose {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

// Translation (m) and rotation vector (rad) that lead from one pose to another, in the base frame.
using Twist = Eigen::Matrix<double, 6, 1>;

Twist difference(const Pose& from, const Pose& to);

enum class JointKind { Rotary, Linear };

// One joint as URDF describes it: a fixed offset in the parent's link, then a turn about or a
// slide along `direction`. Positions in rad or m, speed in rad/s or m/s.
struct ChainJoint {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();          // m, in the parent link's frame
    Eigen::Vector3d originRotation = Eigen::Vector3d::Zero();  // rad: roll, pitch, yaw, fixed axes
    Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();      // unit vector, in the joint's frame
    JointKind kind = JointKind::Rotary;
    double min = 0;
    double max = 0;
    double maxSpeed = 0;
};

// How far inverse() came.
struct InverseResult {
    bool converged = false;
    int iterations = 0;
    double residual = 0;  // length of the remaining Twist, with 1 m counted as 1 rad
};

// Kinematics of an open chain of rotary and linear joints, the base's frame first.
// Built in the setup phase; throws std::invalid_argument then, naming every fault. Afterwards all
// methods are const, allocate nothing, and may be called from any thread.
class SerialChain {
public:
    static constexpr int maxJoints = 16;
    using JointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, maxJoints, 1>;
    using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, maxJoints>;

    // When inverse() ends, and how it treats the posture.
    struct InverseOptions {
        double tolerance = 1e-6;  // of the residual
        int maxIterations = 50;
        // Seconds that one call stands for: no joint moves farther than its speed allows.
        // 0: as far as the limits allow.
        double period = 0;
        // Share of the way back to the posture per metre (or radian) of tip motion, 0: none.
        double posturePull = 1;
    };

    explicit SerialChain(const std::vector<ChainJoint>& joints, const Pose& tip = {});

    int size() const { return static_cast<int>(links_.size()); }
    const JointVector& min() const { return min_; }
    const JointVector& max() const { return max_; }
    const JointVector& maxSpeed() const { return maxSpeed_; }
    const JointVector& midRange() const { return midRange_; }

    Pose forward(const JointVector& joints) const;

    // The Jacobian maps joint speeds to the tip's velocity (linear above angular) in the base
    // frame.
    Pose forward(const JointVector& joints, Jacobian& jacobian) const;

    // Moves `joints`, which holds the start, towards the target and never out of the limits.
    // If it does not converge, `joints` is the nearest that was found. A start or target that is
    // not finite leaves `joints` as it is.
    InverseResult inverse(const Pose& target, JointVector& joints, const JointVector& posture,
                          const InverseOptions& options) const;
    InverseResult inverse(const Pose& target, JointVector& joints) const;

private:
    struct Link {
        Eigen::Matrix3d rotation;
        Eigen::Vector3d offset;
        Eigen::Vector3d direction;
        bool rotary;
    };
    struct Box {
        JointVector low;
        JointVector high;
    };

    Box reachable(const JointVector& start, double period) const;

    std::vector<Link> links_;
    Pose tip_;
    JointVector min_;
    JointVector max_;
    JointVector maxSpeed_;
    JointVector midRange_;
};

}  // namespace cortex::mechanics
