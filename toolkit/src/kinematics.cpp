// SPDX-License-Identifier: Apache-2.0
#include "kinematics.hpp"

#include <algorithm>

namespace cortex::toolkit {
namespace {

constexpr double jumpDistance = 0.02;  // m
constexpr double jumpAngle = 0.1;      // rad

void resize(SerialChain::JointVector& joints, std::size_t size) {
    joints = SerialChain::JointVector::Zero(static_cast<Eigen::Index>(size));
}

}  // namespace

void ForwardKinematics::populate() {
    const auto axes = inputs("axes");
    chain_ = chainOf(*this, axes, array<const double>("tipPosition"),
                     array<const double>("tipRotation"));
    axes_ = axisInputs(axes);
    tip_ = PoseOutput{output("tip")};
    resize(positions_, axes.size());
    resize(velocities_, axes.size());
}

void ForwardKinematics::stateActive(const Tick&) {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        positions_[static_cast<Eigen::Index>(i)] = axes_[i].position;
        velocities_[static_cast<Eigen::Index>(i)] = axes_[i].velocity;
    }
    const Pose pose = chain_->forward(positions_, jacobian_);
    tip_.write(pose, jacobian_.lazyProduct(velocities_));
}

void InverseKinematics::populate() {
    const auto axes = inputs("axes");
    chain_ = chainOf(*this, axes, array<const double>("tipPosition"),
                     array<const double>("tipRotation"));
    axes_ = axisInputs(axes);
    targets_ = axisOutputs(outputs("targets"));
    requireSameCount(*this, axes_.size(), targets_.size(), "targets");
    target_ = PoseInput{input("target")};
    seedDistance_ = data<const double>("seedDistance");
    positionError_ = data<double>("positionError");
    rotationError_ = data<double>("rotationError");
    reached_ = data<bool>("reached");
    seedCount_ = data<std::int64_t>("seedCount");
    for (auto* joints : {&observed_, &solution_, &posture_}) resize(*joints, axes.size());
}

void InverseKinematics::readObserved() {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        observed_[static_cast<Eigen::Index>(i)] = axes_[i].position;
    }
}

// More than its velocity makes of it since the last cycle, as that of a clutch which has let go.
bool InverseKinematics::jumps(const Pose& aim, double seconds) const {
    const Twist way = difference(aimed_, aim) - target_.velocity() * seconds;
    return way.head<3>().norm() > jumpDistance || way.tail<3>().norm() > jumpAngle;
}

void InverseKinematics::seed() {
    solution_ = observed_;
    posture_ = observed_;
    seedCount_ += 1;
}

bool InverseKinematics::stateStartingUp(const Tick&) {
    readObserved();
    seed();
    aimed_ = target_.pose();
    return true;
}

void InverseKinematics::stateActive(const Tick& tick) {
    readObserved();
    const Pose aim = target_.pose();
    if (jumps(aim, tick.passedSeconds()) ||
        (observed_ - solution_).cwiseAbs().maxCoeff() > seedDistance_)
        seed();
    aimed_ = aim;
    const SerialChain::JointVector before = solution_;
    SerialChain::InverseOptions options;
    options.tolerance = 1e-8;
    options.period = tick.elapsedSeconds();
    reached_ = chain_->inverse(aim, solution_, posture_, options).converged;
    const Twist error = difference(chain_->forward(solution_), aim);
    positionError_ = error.head<3>().norm();
    rotationError_ = error.tail<3>().norm();
    for (std::size_t i = 0; i < targets_.size(); ++i) {
        const auto joint = static_cast<Eigen::Index>(i);
        // At its limit the quotient can exceed the speed by its rounding.
        const double limit = chain_->maxSpeed()[joint];
        const double speed = (solution_[joint] - before[joint]) / options.period;
        targets_[i].write(solution_[joint], std::clamp(speed, -limit, limit));
    }
}

void InverseKinematics::keep(Archive& archive) {
    archive.version("InverseKinematics", 2);
    toolkit::keep(archive, aimed_);
    toolkit::keep(archive, solution_);
    toolkit::keep(archive, posture_);
}

}  // namespace cortex::toolkit
