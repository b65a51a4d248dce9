// SPDX-License-Identifier: Apache-2.0
#include "axis_controllers.hpp"

#include <cmath>
#include <numbers>

namespace cortex::toolkit {

void HoldAxisController::populate() {
    axes_ = axisInputs(inputs("axes"));
    demands_ = axisOutputs(outputs("demands"));
    requireSameCount(*this, axes_.size(), demands_.size(), "demands");
    held_.resize(axes_.size());
}

bool HoldAxisController::stateStartingUp(const Tick&) {
    for (std::size_t i = 0; i < axes_.size(); ++i) held_[i] = axes_[i].position;
    return true;
}

void HoldAxisController::stateActive(const Tick&) {
    for (std::size_t i = 0; i < demands_.size(); ++i) demands_[i].write(held_[i], 0);
}

void HoldAxisController::keep(Archive& archive) {
    archive.version("HoldAxisController", 1);
    archive & held_;
}

void FollowAxisController::populate() {
    targets_ = axisInputs(inputs("targets"));
    demands_ = axisOutputs(outputs("demands"));
    requireSameCount(*this, inputs("axes").size(), demands_.size(), "demands");
    requireSameCount(*this, inputs("axes").size(), targets_.size(), "targets");
}

void FollowAxisController::stateActive(const Tick&) {
    for (std::size_t i = 0; i < demands_.size(); ++i) {
        demands_[i].write(targets_[i].position, targets_[i].velocity, targets_[i].acceleration);
    }
}

void SineController::populate() {
    axis_.emplace(output("axis"));
    amplitude_ = data<const double>("amplitude");
    frequency_ = data<const double>("frequency");
}

bool SineController::stateStartingUp(const Tick& tick) {
    startedAt_ = tick.nominalTime;
    return true;
}

void SineController::stateActive(const Tick& tick) {
    const double turning = 2 * std::numbers::pi * frequency_;
    const double angle = turning * static_cast<double>(tick.nominalTime - startedAt_) * 1e-9;
    const double position = amplitude_ * std::sin(angle);
    axis_->write(position, amplitude_ * turning * std::cos(angle), -turning * turning * position);
}

void SineController::keep(Archive& archive) {
    archive.version("SineController", 1);
    archive & startedAt_;
}

}  // namespace cortex::toolkit
