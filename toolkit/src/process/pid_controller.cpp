// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/pid_controller.hpp"

#include "process/number_range.hpp"
#include "process/scalar_output.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cortex::toolkit {

void PidController::populate() {
    measured_ = input("measured").data<double>(itemName(*this, "measuredItem"));
    setpoint_ = input("setpoint").data<double>(itemName(*this, "setpointItem"));
    const std::string item = itemName(*this, "outputItem");
    const OutputSimplex demand = output("output");
    output_ = demand.data<double>(item);
    accepted_ = demand.accepted<double>(item);
    const NumberRange range{*demand.type().findData(item)};
    least_ = range.least;
    greatest_ = range.greatest;
    kp_ = data<const double>("kp");
    ki_ = data<const double>("ki");
    kd_ = data<const double>("kd");
    filterTime_ = data<const double>("filterTime");
    trackingTime_ = data<const double>("trackingTime");
    outputMin_ = data<const double>("outputMin");
    outputMax_ = data<const double>("outputMax");
    error_ = data<double>("error");
    integral_ = data<double>("integral");
}

bool PidController::stateStartingUp(const Tick&) {
    begins_ = true;
    return true;
}

// The integral is such that the output goes on from the one that stands.
void PidController::begin(double error, double added) {
    begins_ = false;
    gain_ = kp_;
    derivative_ = 0;
    lastMeasured_ = measured_;
    integral_ = accepted_ - kp_ * error - added;
}

// Without one of its own it is the integral time.
double PidController::trackingTime() const {
    if (trackingTime_ > 0) return trackingTime_;
    return ki_ != 0 ? std::abs(kp_ / ki_) : std::numeric_limits<double>::infinity();
}

void PidController::stateActive(const Tick& tick) {
    const double seconds = tick.elapsedSeconds();
    const double error = setpoint_ - measured_;
    const double added = feedForward(tick);
    if (begins_) {
        begin(error, added);
    } else {
        const double share = std::min(seconds / trackingTime(), 1.0);  // of what was limited
        const double change = measured_ - lastMeasured_;
        integral_ = integral_ + ki_ * error * seconds + (accepted_ - wanted_) * share +
                    (gain_ - kp_) * error;  // a new gain changes no output
        derivative_ =
            (filterTime_ * derivative_ - kd_ * change) / (filterTime_ + tick.passedSeconds());
        gain_ = kp_;
        lastMeasured_ = measured_;
    }
    error_ = error;
    wanted_ = kp_ * error + integral_ + derivative_ + added;
    const bool own = outputMin_ != 0 || outputMax_ != 0;
    output_ = own ? std::clamp<double>(wanted_, std::max<double>(outputMin_, least_),
                                       std::min<double>(outputMax_, greatest_))
                  : std::clamp(wanted_, least_, greatest_);
}

void PidController::settingsProposed(ProposedSettings& proposed) {
    const double least = proposed[outputMin_], greatest = proposed[outputMax_];
    const bool own = least != 0 || greatest != 0;
    if (own && !(std::max(least, least_) < std::min(greatest, greatest_)))
        proposed.refuse(
            "outputMin is not below outputMax, or both are outside of the demand's range");
}

void PidController::keep(Archive& archive) {
    archive.version("PidController", 1);
    archive & wanted_ & lastMeasured_ & derivative_ & gain_ & begins_;
}

}  // namespace cortex::toolkit
