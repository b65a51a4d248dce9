// SPDX-License-Identifier: Apache-2.0
#include "process/filter.hpp"

#include <cmath>

namespace cortex::toolkit {

void Filter::populate() {
    const std::string item = itemName(*this, "item");
    source_ = input("source").data<double>(item);
    result_ = ScalarOutput{output("result"), item};
    timeConstant_ = data<const double>("timeConstant");
}

// A demand goes on from what stands, an observation begins at its source.
bool Filter::stateStartingUp(const Tick&) {
    if (result_.observes()) result_.write(source_);
    return true;
}

void Filter::stateActive(const Tick& tick) {
    if (!std::isfinite(result_.before())) return result_.write(source_);  // it begins anew
    const double before = result_.before();
    const double share =
        timeConstant_ > 0 ? -std::expm1(-tick.elapsedSeconds() / timeConstant_) : 1.0;
    result_.write(before + share * (source_ - before));
}

}  // namespace cortex::toolkit
