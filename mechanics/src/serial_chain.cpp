// SPDX-License-Identifier: Apache-2.0
#include "cortex/mechanics/serial_chain.hpp"

#include "joint_geometry.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include <Eigen/Cholesky>

namespace cortex::mechanics {
namespace {

using JointVector = SerialChain::JointVector;
using Jacobian = SerialChain::Jacobian;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Largest tip step (m, rad) of one iteration: farther away the Jacobian says little.
constexpr double largestStep = 0.5;
// Damping that remains at the target: keeps the 6x6 matrix positive definite in a singular posture.
constexpr double leastDamping = 1e-9;
// The factor of the damping at the start, and its bounds: a failed step raises it, a good one
// lowers it.
constexpr double firstFactor = 1e-2;
constexpr double leastFactor = 1e-3;
constexpr double largestFactor = 1e12;

bool isFinite(const Pose& pose) {
    return pose.position.allFinite() && pose.rotation.coeffs().allFinite() &&
           pose.rotation.squaredNorm() > 0;
}

std::string findings(const std::vector<ChainJoint>& joints, const Pose& tip) {
    std::string text = countFinding(joints.size());
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const ChainJoint& joint = joints[i];
        text += geometryFindings(i, joint);
        if (!std::isfinite(joint.min) || !std::isfinite(joint.max) || !(joint.min < joint.max)) {
            text += jointFinding(i, "limits are not finite or not in order: give min < max");
        }
        if (!std::isfinite(joint.maxSpeed) || !(joint.maxSpeed > 0)) {
            text += jointFinding(i, "maxSpeed is not above 0: give the greatest speed");
        }
    }
    if (!isFinite(tip)) text += "\n  tip offset is not finite: give numbers and a unit quaternion";
    return text;
}

// What one iteration works on: a point of the search and what was computed there.
struct Point {
    JointVector joints;
    Jacobian jacobian;
    Twist error;
    double residual = 0;
};

void evaluate(const SerialChain& chain, const Pose& target, Point& point) {
    point.error = difference(chain.forward(point.joints, point.jacobian), target);
    point.residual = point.error.norm();
}

// One damped step: dq = J'(JJ' + d I)^-1 (e - J p) + p, where p is the pull towards the posture.
// This is Nakamura and Hanafusa's damped least squares with Liegeois' nullspace term; where d
// vanishes it is J+ e + (I - J+ J) p, so that the pull moves the arm but not its tip.
JointVector dampedStep(const Jacobian& jacobian, const Twist& error, const JointVector& pull,
                       double damping) {
    Matrix6 normal = jacobian.lazyProduct(jacobian.transpose());
    normal.diagonal().array() += damping;
    const Twist remaining = error - jacobian.lazyProduct(pull);
    const Twist weights = normal.llt().solve(remaining);
    JointVector step = jacobian.transpose().lazyProduct(weights);
    step += pull;
    return step;
}

// Joints that stand at a limit and would be pushed through it are taken out, and the others share
// their work: without that the clamp would bend the step off its way and end short of the target.
JointVector boundedStep(const Point& point, JointVector pull, double damping,
                        const JointVector& low, const JointVector& high) {
    const double scale = std::min(1.0, largestStep / point.residual);
    Jacobian free = point.jacobian;
    JointVector step;
    for (Eigen::Index round = 0; round < free.cols(); ++round) {
        step = dampedStep(free, scale * point.error, pull, damping);
        bool blocked = false;
        for (Eigen::Index i = 0; i < free.cols(); ++i) {
            const double place = point.joints[i];
            if ((place <= low[i] && step[i] < 0) || (place >= high[i] && step[i] > 0)) {
                free.col(i).setZero();
                pull[i] = 0;
                blocked = true;
            }
        }
        if (!blocked) break;
    }
    return step;
}

JointVector clamped(const JointVector& joints, const JointVector& low, const JointVector& high) {
    return joints.cwiseMin(high).cwiseMax(low);
}

}  // namespace

Twist difference(const Pose& from, const Pose& to) {
    Twist twist;
    twist.head<3>() = to.position - from.position;
    Eigen::Quaterniond turn = to.rotation * from.rotation.conjugate();
    if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
    const double length = turn.vec().norm();
    const double scale = length < 1e-9 ? 2.0 : 2 * std::atan2(length, turn.w()) / length;
    twist.tail<3>() = scale * turn.vec();
    return twist;
}

SerialChain::SerialChain(const std::vector<ChainJoint>& joints, const Pose& tip) : tip_(tip) {
    if (const std::string text = findings(joints, tip); !text.empty()) {
        throw std::invalid_argument("serial chain refused:" + text);
    }
    tip_.rotation.normalize();
    const auto count = static_cast<Eigen::Index>(joints.size());
    for (JointVector* vector : {&min_, &max_, &maxSpeed_, &midRange_}) vector->resize(count);
    links_.reserve(joints.size());
    for (Eigen::Index i = 0; i < count; ++i) {
        const ChainJoint& joint = joints[static_cast<std::size_t>(i)];
        links_.push_back({fromRollPitchYaw(joint.originRotation), joint.origin,
                          joint.direction.normalized(), joint.kind == JointKind::Rotary});
        min_[i] = joint.min;
        max_[i] = joint.max;
        maxSpeed_[i] = joint.maxSpeed;
        midRange_[i] = (joint.min + joint.max) / 2;
    }
}

Pose SerialChain::forward(const JointVector& joints) const {
    Jacobian unused;
    return forward(joints, unused);
}

Pose SerialChain::forward(const JointVector& joints, Jacobian& jacobian) const {
    assert(joints.size() == size());
    jacobian.resize(6, size());
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < joints.size(); ++i) {
        const Link& link = links_[static_cast<std::size_t>(i)];
        position += rotation * link.offset;
        rotation *= link.rotation;
        const Eigen::Vector3d direction = rotation * link.direction;
        if (link.rotary) {
            rotation *= Eigen::AngleAxisd(joints[i], link.direction).toRotationMatrix();
            jacobian.col(i) << position, direction;  // the place, until the tip's is known
        } else {
            position += joints[i] * direction;
            jacobian.col(i) << direction, Eigen::Vector3d::Zero();
        }
    }
    position += rotation * tip_.position;
    for (Eigen::Index i = 0; i < joints.size(); ++i) {
        if (!links_[static_cast<std::size_t>(i)].rotary) continue;
        const Eigen::Vector3d lever = position - jacobian.col(i).head<3>();
        const Eigen::Vector3d direction = jacobian.col(i).tail<3>();
        jacobian.col(i).head<3>() = direction.cross(lever);
    }
    return {position, Eigen::Quaterniond(rotation) * tip_.rotation};
}

SerialChain::Box SerialChain::reachable(const JointVector& start, double period) const {
    Box box{min_, max_};
    if (period > 0) {
        box.low = clamped(start - period * maxSpeed_, min_, max_);
        box.high = clamped(start + period * maxSpeed_, min_, max_);
    }
    return box;
}

// Levenberg-Marquardt on the pose: the damping grows with the squared residual, as in Sugihara's
// solvability-unconcerned method, and by a factor that rises after a step that led away.
//   Y. Nakamura, H. Hanafusa, Inverse kinematic solutions with singularity robustness for robot
//     manipulator control, J. Dyn. Sys. Meas. Control 108 (1986) 163-171
//   A. Liegeois, Automatic supervisory control of the configuration and behavior of multibody
//     mechanisms, IEEE Trans. Sys. Man Cybern. 7 (1977) 868-871
//   T. Sugihara, Solvability-unconcerned inverse kinematics by the Levenberg-Marquardt method,
//     IEEE Trans. Robotics 27 (2011) 984-991
InverseResult SerialChain::inverse(const Pose& target, JointVector& joints,
                                   const JointVector& posture,
                                   const InverseOptions& options) const {
    assert(joints.size() == size() && posture.size() == size());
    InverseResult result{false, 0, std::numeric_limits<double>::infinity()};
    if (!isFinite(target) || !joints.allFinite() || !posture.allFinite()) return result;

    const Pose wanted{target.position, target.rotation.normalized()};
    const Box box = reachable(joints, options.period);
    std::array<Point, 2> points;
    Point* here = &points[0];
    Point* next = &points[1];
    here->joints = clamped(joints, box.low, box.high);
    evaluate(*this, wanted, *here);
    double factor = firstFactor;
    while (here->residual >= options.tolerance && result.iterations < options.maxIterations &&
           factor < largestFactor) {
        ++result.iterations;
        const double residual = here->residual;
        // Scaled by the residual, the pull fades out at the target: a tip that stands, stands
        // still. After a failed step there is none: it is free of tip motion only where damping is
        // small.
        const double share = std::min(0.5, options.posturePull * std::min(residual, largestStep));
        const JointVector pull = (factor > firstFactor ? 0 : share) * (posture - here->joints);
        const double damping = factor * residual * residual + leastDamping;
        next->joints = here->joints + boundedStep(*here, pull, damping, box.low, box.high);
        next->joints = clamped(next->joints, box.low, box.high);
        evaluate(*this, wanted, *next);
        if (next->residual < residual) {
            std::swap(here, next);
            factor = std::max(factor / 10, leastFactor);
        } else {
            factor *= 10;
        }
    }
    joints = here->joints;
    result.residual = here->residual;
    result.converged = here->residual < options.tolerance;
    return result;
}

InverseResult SerialChain::inverse(const Pose& target, JointVector& joints) const {
    return inverse(target, joints, midRange_, InverseOptions());
}

}  // namespace cortex::mechanics
