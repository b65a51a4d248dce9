// SPDX-License-Identifier: Apache-2.0
#include "process/rate_limiter.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::toolkit {

void RateLimiter::populate() {
    const std::string item = itemName(*this, "item");
    source_ = input("source").data<double>(item);
    result_ = ScalarOutput{output("result"), item};
    rate_ = data<const double>("rate");
    limiting_ = data<bool>("limiting");
}

void RateLimiter::stateActive(const Tick& tick) {
    const double step = result_.step(rate_, tick.elapsedSeconds());
    const double before = result_.before();
    const bool stands = result_.observes() && std::isnan(source_.get());
    const double result =
        stands ? before : std::clamp<double>(source_, before - step, before + step);
    if (stands && !inputLost()) setQuality(Quality::Bad);
    limiting_ = result != source_;
    result_.write(result);
}

}  // namespace cortex::toolkit
