// SPDX-License-Identifier: Apache-2.0
#include "jog_controller.hpp"

#include <algorithm>

namespace cortex::toolkit {

void JogController::populate() {
    const auto observed = inputs("axes");
    const auto demands = outputs("demands");
    requireSameCount(*this, observed.size(), demands.size(), "demands");
    for (std::size_t i = 0; i < demands.size(); ++i) {
        axes_.push_back(
            {AxisInput{observed[i]}, AxisOutput{demands[i]}, AxisLimits{demands[i].type()}});
    }
    holdTime_ = data<const double>("holdTime");
    jogging_ = data<bool>("jogging");
    axis_ = argument<std::int64_t>("jog", "axis");
    velocity_ = argument<double>("jog", "velocity");
    on<&JogController::jog>("jog");
}

bool JogController::stateStartingUp(const Tick& tick) {
    now_ = tick.nominalTime;
    for (Axis& axis : axes_) {
        axis.position = axis.observed.position;
        axis.until = now_;
    }
    return true;
}

Outcome JogController::jog(Call& call) {
    const auto index = static_cast<std::size_t>(call[axis_] - 1);
    if (index >= axes_.size()) return call.reject(Reason::Range, "there is no such axis");
    Axis& axis = axes_[index];
    axis.velocity = std::clamp(call[velocity_].get(), -axis.limits.speed, axis.limits.speed);
    axis.until = now_ + static_cast<std::int64_t>(holdTime_ * 1e9);
    return Outcome::Done;
}

void JogController::stateActive(const Tick& tick) {
    now_ = tick.nominalTime;
    jogging_ = false;
    for (Axis& axis : axes_) {
        const bool lasts = now_ < axis.until;
        const double velocity = lasts ? axis.velocity : 0;
        axis.position = std::clamp(axis.position + velocity * tick.elapsedSeconds(),
                                   axis.limits.min, axis.limits.max);
        axis.demand.write(axis.position, velocity);
        if (lasts) jogging_ = true;
    }
}

void JogController::keep(Archive& archive) {
    archive.version("JogController", 1);
    archive & axes_ & now_;
}

}  // namespace cortex::toolkit
