// SPDX-License-Identifier: Apache-2.0
#include "safety_panel.hpp"

namespace cortex::toolkit {

void SimulatedSafetyPanel::populate() {
    const OutputSimplex status = output("status");
    emergencyStop_ = status.data<bool>("emergencyStop");
    resetNeeded_ = status.data<bool>("resetNeeded");
    stopped_ = pressed_ = emergencyStop_;  // as a system file begins
    on<&SimulatedSafetyPanel::press>("press");
    on<&SimulatedSafetyPanel::release>("release");
    on<&SimulatedSafetyPanel::reset>("reset");
}

Outcome SimulatedSafetyPanel::press(Call&) {
    pressed_ = stopped_ = true;
    return Outcome::Done;
}

Outcome SimulatedSafetyPanel::release(Call&) {
    pressed_ = false;
    return Outcome::Done;
}

Outcome SimulatedSafetyPanel::reset(Call& call) {
    if (pressed_)
        return call.reject(Reason::State, "the emergency stop button is pressed: release it first");
    stopped_ = false;
    return Outcome::Done;
}

void SimulatedSafetyPanel::loopEnd(const Tick&) {
    emergencyStop_ = stopped_;
    resetNeeded_ = stopped_ && !pressed_;
}

void SimulatedSafetyPanel::keep(Archive& archive) {
    archive.version("SimulatedSafetyPanel", 1);
    archive & pressed_ & stopped_;
}

}  // namespace cortex::toolkit
