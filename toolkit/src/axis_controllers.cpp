// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/axis_controllers.hpp"

#include "handles.hpp"

#include <cmath>

namespace cortex::toolkit {

using mechanics::MotionLimits;
using mechanics::MotionState;
using mechanics::Profile;

void HoldAxisController::populate() {
    AxisController::populate();
    stops_.resize(axisCount());
}

void HoldAxisController::takeOver(const Tick&) {
    for (std::size_t i = 0; i < axisCount(); ++i) {
        const MotionState& now = demands()[i];
        stops_[i] = mechanics::planVelocity(now, 0, limits(i).motion())
                        .value_or(Profile::standing({now.position, 0, 0}));
    }
    time_ = 0;
}

void HoldAxisController::move(const Tick& tick) {
    time_ += tick.elapsedSeconds();
    for (std::size_t i = 0; i < axisCount(); ++i) demands()[i] = stops_[i].at(time_);
}

void HoldAxisController::keep(Archive& archive) {
    AxisController::keep(archive);
    archive.version("HoldAxisController", 2);
    archive & stops_ & time_;
}

void FollowAxisController::populate() {
    AxisController::populate();
    const auto targets = inputs("targets");
    requireSameCount(*this, axisCount(), targets.size(), "targets");
    for (const InputSimplex& target : targets) {
        targets_.push_back({target.data<double>("position"),
                            target.data<double>("velocity"),
                            target.data<double>("acceleration"),
                            {}});
    }
}

MotionState FollowAxisController::target(std::size_t axis) {
    const Target& target = targets_[axis];
    return {target.position, target.velocity, target.acceleration};
}

void FollowAxisController::takeOver(const Tick& tick) {
    const double elapsed = tick.elapsedSeconds();
    for (std::size_t i = 0; i < axisCount(); ++i) {
        targets_[i].offset = Profile{};
        if (!std::isfinite(limits(i).acceleration)) continue;
        const MotionState aim = target(i), now = demands()[i];
        const MotionLimits half = limits(i).motion();
        // Where the target was in the cycle before, which is when the demand was there.
        const double before = aim.position - elapsed * aim.velocity;
        const auto offset =
            mechanics::planPosition({now.position - before, now.velocity - aim.velocity,
                                     now.acceleration - aim.acceleration},
                                    0, {half.velocity / 2, half.acceleration / 2, half.jerk / 2});
        if (offset) targets_[i].offset = *offset;
    }
    time_ = 0;
}

void FollowAxisController::move(const Tick& tick) {
    time_ += tick.elapsedSeconds();
    for (std::size_t i = 0; i < axisCount(); ++i) {
        const MotionState aim = target(i), offset = targets_[i].offset.at(time_);
        demands()[i] = {aim.position + offset.position, aim.velocity + offset.velocity,
                        aim.acceleration + offset.acceleration};
    }
}

void FollowAxisController::keep(Archive& archive) {
    AxisController::keep(archive);
    archive.version("FollowAxisController", 1);
    archive & targets_ & time_;
}

}  // namespace cortex::toolkit
