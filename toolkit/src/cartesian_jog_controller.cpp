// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/cartesian_jog_controller.hpp"

#include "cortex/core/error.hpp"

#include "handles.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace cortex::toolkit {

using mechanics::MotionLimits;
using mechanics::MotionState;
using JointVector = SerialChain::JointVector;

namespace {

constexpr std::size_t ofElbow = 6;

// The greatest velocity from which a stop takes no more than the way, as with a trapezoid of the
// acceleration: a step of the velocity by v takes v/A + A/J, or 2·sqrt(v/J) below A²/J.
double fastestStopWithin(double way, const MotionLimits& limits) {
    if (way <= 0) return 0;
    const double a = limits.acceleration, j = limits.jerk;
    if (!std::isfinite(j)) return std::sqrt(2 * a * way);
    const double edge = a * a / j;  // of the velocity: below, A is not reached
    if (way <= edge * std::sqrt(edge / j)) return std::cbrt(way * way * j);
    return -edge / 2 + std::sqrt(edge * edge / 4 + 2 * a * way);
}

double limitedTo(double value, double most) { return std::clamp(value, -most, most); }

}  // namespace

void CartesianJogController::populate() {
    AxisController::populate();
    const auto axes = inputs("axes");
    chain_ = chainOf(*this, axes, array<const double>("tipPosition"),
                     array<const double>("tipRotation"));
    readDirections();
    joints_ = elbow_ = JointVector::Zero(static_cast<Eigen::Index>(axisCount()));
    next_.resize(axisCount());
    frame_ = data<const std::int64_t>("frame");
    holdTime_ = data<const double>("holdTime");
    linearSpeed_ = data<const double>("linearSpeed");
    angularSpeed_ = data<const double>("angularSpeed");
    elbowSpeed_ = data<const double>("elbowSpeed");
    rampTime_ = data<const double>("rampTime");
    manipulability_ = data<double>("manipulability");
    singularDistance_ = data<double>("singularDistance");
    heldBack_ = data<std::int64_t>("heldBack");
    jogging_ = data<bool>("jogging");
    linear_ = arrayArgument<double>("jog", "linear");
    angular_ = arrayArgument<double>("jog", "angular");
    elbowVelocity_ = argument<double>("elbow", "velocity");
    on<&CartesianJogController::jog>("jog");
    on<&CartesianJogController::elbow>("elbow");
    on<&CartesianJogController::halt>("halt");
}

void CartesianJogController::readDirections() {
    const auto stated = array<const bool>("directions");
    std::copy(stated.begin(), stated.end(), directions_.begin());
    const int counted = mechanics::count(directions_);
    if (counted >= 1 && static_cast<std::size_t>(counted) <= axisCount()) return;
    throw Error(path() + ": " + std::to_string(axisCount()) + " axes cannot follow " +
                std::to_string(counted) +
                " directions: set in the item directions which of x y z and the turns about them "
                "count, such as \"true true true false false false\"");
}

// --- motion -----------------------------------------------------------------------------------

MotionLimits CartesianJogController::limitsOf(std::size_t motion) const {
    const double speed = motion < 3 ? linearSpeed_ : motion < ofElbow ? angularSpeed_ : elbowSpeed_;
    const double ramp = rampTime_;
    return {speed, 2 * speed / ramp, 4 * speed / (ramp * ramp)};
}

// Each velocity of the tip goes to what was asked for with a limited change of its acceleration.
void CartesianJogController::slowTowardsAim(double seconds) {
    const bool lasts = now_ < until_;
    jogging_ = lasts;
    for (std::size_t i = 0; i < motions; ++i) {
        const auto step = mechanics::planVelocity(smooth_[i], lasts ? aim_[i] : 0.0, limitsOf(i));
        smooth_[i] = step ? step->at(seconds) : MotionState{};
        smooth_[i].position = 0;
    }
}

// Of the joints, for the velocities of tip and elbow in this cycle.
JointVector CartesianJogController::wanted() {
    const Pose tip = chain_->forward(joints_, jacobian_);
    if (frame_ == Tip) {
        const Eigen::Matrix3d back = tip.rotation.conjugate().toRotationMatrix();
        for (Eigen::Index i = 0; i < jacobian_.cols(); ++i) {
            jacobian_.col(i).head<3>() = back * jacobian_.col(i).head<3>().eval();
            jacobian_.col(i).tail<3>() = back * jacobian_.col(i).tail<3>().eval();
        }
    }
    Twist twist;
    for (std::size_t i = 0; i < ofElbow; ++i) {
        twist[static_cast<Eigen::Index>(i)] = directions_[i] ? smooth_[i].velocity : 0.0;
    }
    const auto found = mechanics::jointVelocities(jacobian_, twist, directions_);
    manipulability_ = found.manipulability;
    singularDistance_ = found.smallest;
    if (found.damped && jogging_) heldBack_ = Singularity;
    const double turn = smooth_[ofElbow].velocity;
    if (turn == 0) return found.joints;
    elbow_ = mechanics::selfMotion(jacobian_, directions_, elbow_);
    return found.joints + turn * elbow_;
}

// How much of it no axis is too fast for, and none comes nearer to a limit than its braking way.
double CartesianJogController::share(const JointVector& wanted, double seconds) {
    double share = 1;
    for (std::size_t i = 0; i < axisCount(); ++i) {
        const double velocity = wanted[static_cast<Eigen::Index>(i)];
        const double speed = std::abs(velocity);
        if (speed == 0) continue;
        const MotionLimits most = limits(i).motion();
        const double position = demands()[i].position;
        const double way = velocity > 0 ? limits(i).max - position : position - limits(i).min;
        const double stoppable = fastestStopWithin(way - speed * seconds, most);
        const double allowed = std::min(most.velocity, stoppable);
        if (allowed >= speed * share) continue;
        heldBack_ = stoppable < most.velocity ? Limit : Speed;
        share = allowed / speed;
    }
    return share;
}

// Each axis by its own limits. False, and nothing is moved: one could not stop before its range
// ends.
bool CartesianJogController::stepAll(const JointVector& velocities, double seconds) {
    for (std::size_t i = 0; i < axisCount(); ++i) {
        const MotionLimits most = limits(i).motion();
        const double velocity = limitedTo(velocities[static_cast<Eigen::Index>(i)], most.velocity);
        const auto step = mechanics::planVelocity(demands()[i], velocity, most);
        if (!step) return false;
        next_[i] = step->at(seconds);
        const auto stop = mechanics::planVelocity(next_[i], 0, most);
        if (!stop || !limits(i).inRange(stop->end().position)) return false;
    }
    std::ranges::copy(next_, demands().begin());
    return true;
}

// Also where it is not Active, or an axis is lost: then move() is not called.
void CartesianJogController::loopStart(const Tick&) { jogging_ = false; }

void CartesianJogController::takeOver(const Tick&) {
    until_ = now_;
    smooth_ = {};
}

void CartesianJogController::move(const Tick& tick) {
    now_ = tick.nominalTime;
    heldBack_ = Nothing;
    for (std::size_t i = 0; i < axisCount(); ++i)
        joints_[static_cast<Eigen::Index>(i)] = demands()[i].position;
    const double seconds = tick.elapsedSeconds();
    slowTowardsAim(seconds);
    const JointVector velocities = wanted();
    if (stepAll(share(velocities, seconds) * velocities, seconds)) return;
    heldBack_ = Limit;
    for (std::size_t i = 0; i < axisCount(); ++i) {
        const auto stop = mechanics::planVelocity(demands()[i], 0, limits(i).motion());
        demands()[i] = stop ? stop->at(seconds) : MotionState{demands()[i].position, 0, 0};
    }
}

// --- commands ---------------------------------------------------------------------------------

Outcome CartesianJogController::jog(Call& call) {
    if (!allFollow(call)) return Outcome::Rejected;
    const auto linear = call[linear_], angular = call[angular_];
    for (std::size_t i = 0; i < 3; ++i) {
        if ((linear[i] != 0 && !directions_[i]) || (angular[i] != 0 && !directions_[i + 3]))
            return call.reject(Reason::Range, "directions says that one of these does not count");
        aim_[i] = limitedTo(linear[i], linearSpeed_);
        aim_[i + 3] = limitedTo(angular[i], angularSpeed_);
    }
    aim_[ofElbow] = 0;
    until_ = now_ + static_cast<std::int64_t>(holdTime_ * 1e9);
    return Outcome::Done;
}

Outcome CartesianJogController::elbow(Call& call) {
    if (!allFollow(call)) return Outcome::Rejected;
    if (axisCount() <= static_cast<std::size_t>(mechanics::count(directions_)))
        return call.reject(Reason::State, "no axis is to spare: each is needed for the tip");
    aim_ = {};
    aim_[ofElbow] = limitedTo(call[elbowVelocity_], elbowSpeed_);
    until_ = now_ + static_cast<std::int64_t>(holdTime_ * 1e9);
    return Outcome::Done;
}

Outcome CartesianJogController::halt(Call&) {
    until_ = now_;
    return Outcome::Done;
}

void CartesianJogController::keep(Archive& archive) {
    AxisController::keep(archive);
    archive.version("CartesianJogController", 1);
    archive & smooth_ & aim_ & now_ & until_;
    toolkit::keep(archive, elbow_);
}

}  // namespace cortex::toolkit
