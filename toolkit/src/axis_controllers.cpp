// SPDX-License-Identifier: Apache-2.0
#include "axis_controllers.hpp"

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

void FollowAxisController::populate() {
    targets_ = axisInputs(inputs("targets"));
    demands_ = axisOutputs(outputs("demands"));
    requireSameCount(*this, inputs("axes").size(), demands_.size(), "demands");
    requireSameCount(*this, inputs("axes").size(), targets_.size(), "targets");
}

void FollowAxisController::stateActive(const Tick&) {
    for (std::size_t i = 0; i < demands_.size(); ++i) {
        demands_[i].write(targets_[i].position, targets_[i].velocity);
    }
}

}  // namespace cortex::toolkit
