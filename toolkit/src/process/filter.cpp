// SPDX-License-Identifier: Apache-2.0
#include "process/filter.hpp"

#include <cmath>

namespace cortex::toolkit {

void Filter::populate() {
    const std::string item = itemName(*this, "item");
    const OutputSimplex result = output("result");
    source_ = input("source").data<double>(item);
    result_ = ScalarOutput{result, item};
    observes_ = result.type().role == Role::Observation;
    timeConstant_ = data<const double>("timeConstant");
}

bool Filter::stateStartingUp(const Tick&) {
    if (observes_) result_.write(source_);
    return true;
}

void Filter::stateActive(const Tick& tick) {
    const double before = result_.before();
    const double share =
        timeConstant_ > 0 ? -std::expm1(-tick.elapsedSeconds() / timeConstant_) : 1.0;
    result_.write(before + share * (source_ - before));
}

}  // namespace cortex::toolkit
