// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/axis_pose_controller.hpp"

#include "handles.hpp"

#include <algorithm>
#include <limits>

namespace cortex::toolkit {

using mechanics::MotionLimits;

void AxisPoseController::populate() {
    AxisController::populate();
    pose_.bind(*this, "pose");
    const std::size_t most = std::min(pose_.size(), plan_.maxAxes);
    if (axisCount() > most) requireSameCount(*this, axisCount(), most, "demands");
    shape_ = data<const std::int64_t>("profile");
    progress_ = data<double>("progress");
    remaining_ = data<double>("remaining");
    speedShare_ = argument<double>("moveTo", "speedShare");
    on<&AxisPoseController::runMoveTo>("moveTo");
    planLimits_.resize(axisCount());
    target_.resize(axisCount());
}

bool AxisPoseController::stateStartingUp(const Tick& tick) {
    aims_ = false;
    return AxisController::stateStartingUp(tick);
}

void AxisPoseController::settingsProposed(ProposedSettings& proposed) { pose_.propose(proposed); }

void AxisPoseController::settingsChanged() { pose_.settle(); }

void AxisPoseController::loopStart(const Tick&) {
    for (std::size_t i = 0; i < axisCount(); ++i) pose_.show(i, nearestInRange(i));
}

MotionLimits AxisPoseController::limitsOf(std::size_t axis, double speedShare) const {
    MotionLimits limits = this->limits(axis).motion(speedShare);
    if (shape_ == Trapezoid) limits.jerk = std::numeric_limits<double>::infinity();
    return limits;
}

bool AxisPoseController::moveTo(std::span<const double> pose, double speedShare) {
    for (std::size_t i = 0; i < axisCount(); ++i) {
        if (!limits(i).inRange(pose[i])) return false;
        planLimits_[i] = limitsOf(i, speedShare);
    }
    if (!plan_.plan(demands(), pose.first(axisCount()), planLimits_)) return false;
    if (pose.data() != target_.data()) std::ranges::copy(pose.first(axisCount()), target_.begin());
    share_ = speedShare;
    time_ = 0;
    aims_ = true;
    lost_ = false;
    return true;
}

void AxisPoseController::stop() {
    for (std::size_t i = 0; i < axisCount(); ++i) planLimits_[i] = limitsOf(i, 1);
    plan_.stop(demands(), planLimits_);
    time_ = 0;
    aims_ = false;
}

// What limits took away is made up for; after a loss somebody has to command anew.
void AxisPoseController::takeOver(const Tick&) {
    lost_ = lost_ || (aims_ && (inputLost() || firstThatDoesNotFollow() < axisCount()));
    if (!aims_ || lost_ || !moveTo(target_, share_)) stop();
}

void AxisPoseController::move(const Tick& tick) {
    if (moves()) time_ += tick.elapsedSeconds();
    for (std::size_t i = 0; i < axisCount(); ++i) demands()[i] = plan_.profile(i).at(time_);
    remaining_ = std::max(0.0, plan_.duration() - time_);
}

Outcome AxisPoseController::proceed(Call& call) {
    if (call.cancelling()) {
        stop();
        return Outcome::Cancelled;
    }
    const std::size_t stands = firstThatDoesNotFollow();
    if (lost_ || stands < axisCount()) {
        aims_ = false;
        if (stands == axisCount()) return call.fail("an axis was lost on the way");
        return call.fail(doesNotFollow(stands).view());
    }
    progress_ = moves() ? time_ / plan_.duration() : 1.0;
    return moves() ? Outcome::Running : Outcome::Done;
}

Outcome AxisPoseController::runMoveTo(Call& call) {
    if (call.first()) {
        if (!pose_.isGiven(call) || !allFollow(call)) return Outcome::Rejected;
        for (std::size_t i = 0; i < axisCount(); ++i) {
            if (!inRange(call, "pose", i, pose_[i])) return Outcome::Rejected;
        }
        if (!moveTo(pose_.values(), call[speedShare_]))
            return call.fail("no motion leads to this pose");
    }
    return proceed(call);
}

void AxisPoseController::keep(Archive& archive) {
    AxisController::keep(archive);
    archive.version("AxisPoseController", 2);
    archive & plan_ & target_ & share_ & time_ & aims_ & lost_;
}

}  // namespace cortex::toolkit
