// SPDX-License-Identifier: Apache-2.0
#include "sine_controller.hpp"

#include <cmath>
#include <numbers>

namespace cortex::toolkit {

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
    archive.version("SineController", 2);
    archive.time(startedAt_);
}

}  // namespace cortex::toolkit
