// SPDX-License-Identifier: Apache-2.0
#include "axis_pose_controller.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::toolkit {
namespace {

constexpr double rampShare = 0.2;  // share of the time to speed up, and to slow down

struct Share {
    double way, speed, acceleration;
};

// Trapezoidal speed: share of the way after a share of the time, and its derivatives.
Share trapezoid(double time) {
    const double speed = 1 / (1 - rampShare);
    const double ramp = speed / rampShare;
    if (time < rampShare) return {ramp * time * time / 2, ramp * time, ramp};
    if (time <= 1 - rampShare) return {speed * (time - rampShare / 2), speed, 0};
    const double left = std::max(0.0, 1 - time);
    return {1 - ramp * left * left / 2, ramp * left, left > 0 ? -ramp : 0};
}

}  // namespace

void AxisPoseController::populate() {
    const auto observed = inputs("axes");
    const auto demands = outputs("demands");
    requireSameCount(*this, observed.size(), demands.size(), "demands");
    for (std::size_t i = 0; i < demands.size(); ++i) {
        axes_.push_back(
            {AxisInput{observed[i]}, AxisOutput{demands[i]}, AxisLimits{demands[i].type()}});
    }
    pose_ = array<const double>("pose");
    if (axes_.size() > pose_.size()) requireSameCount(*this, axes_.size(), pose_.size(), "demands");
    progress_ = data<double>("progress");
    speedShare_ = argument<double>("moveTo", "speedShare");
    on<&AxisPoseController::moveTo>("moveTo");
}

bool AxisPoseController::stateStartingUp(const Tick&) {
    for (Axis& axis : axes_) {
        axis.from = axis.observed.position;
        axis.position = axis.from;
        axis.way = 0;
    }
    time_ = 0;
    duration_ = 0;
    return true;
}

bool AxisPoseController::poseIsInRange() const {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        if (pose_[i] < axes_[i].limits.min || pose_[i] > axes_[i].limits.max) return false;
    }
    return true;
}

void AxisPoseController::begin(double speedShare) {
    time_ = 0;
    duration_ = 1e-3;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        Axis& axis = axes_[i];
        axis.from = axis.position;
        axis.way = pose_[i] - axis.from;
        const double speed = std::min(axis.limits.speed, 1e3) * speedShare * (1 - rampShare);
        duration_ = std::max(duration_, std::abs(axis.way) / speed);
    }
}

Outcome AxisPoseController::moveTo(Call& call) {
    if (call.first()) {
        if (!poseIsInRange()) return call.fail("the pose is out of the range of an axis");
        begin(call[speedShare_]);
    }
    if (call.cancelling()) {
        duration_ = 0;
        return Outcome::Cancelled;
    }
    progress_ = std::min(1.0, time_ / duration_);
    return time_ >= duration_ ? Outcome::Done : Outcome::Running;
}

void AxisPoseController::stateActive(const Tick& tick) {
    const bool moves = time_ < duration_;
    if (moves) time_ += tick.elapsedSeconds();
    for (Axis& axis : axes_) {
        double velocity = 0, acceleration = 0;
        if (moves) {
            const Share share = trapezoid(std::min(1.0, time_ / duration_));
            axis.position = axis.from + share.way * axis.way;
            velocity = share.speed * axis.way / duration_;
            acceleration = share.acceleration * axis.way / (duration_ * duration_);
        }
        axis.demand.write(axis.position, velocity, acceleration);
    }
}

void AxisPoseController::keep(Archive& archive) {
    archive.version("AxisPoseController", 1);
    archive & axes_ & duration_ & time_;
}

}  // namespace cortex::toolkit
