// SPDX-License-Identifier: Apache-2.0
#include "tasks/stopping.hpp"

#include "tasks/number_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cortex::cs {

Motion slowed(const Motion& from, const StopLimits& limits, double elapsedSeconds) {
    const double step = limits.deceleration * elapsedSeconds;
    Motion to;
    if (std::abs(from.velocity) > step)
        to.velocity = from.velocity - std::copysign(step, from.velocity);
    const double moving = std::min(elapsedSeconds, std::abs(from.velocity) / limits.deceleration);
    to.position = from.position + (from.velocity + to.velocity) / 2 * moving;
    const double inRange = std::clamp(to.position, limits.min, limits.max);
    if (inRange != to.position) to = {inRange, 0};
    return to;
}

Stopping::Stopping(const DataItem& item, const DataItem& derivative, Cells position, Cells velocity)
    : derivative_{&derivative},
      position_{position},
      velocity_{velocity},
      limits_{leastOf(item), greatestOf(item),
              derivative.rate.value_or(std::numeric_limits<double>::infinity())} {}

void Stopping::step(double elapsedSeconds) const {
    for (std::uint32_t i = 0; i < derivative_->length; ++i) {
        const Motion to =
            slowed({position_.accepted[i], velocity_.accepted[i]}, limits_, elapsedSeconds);
        position_.safe[i] = to.position;
        velocity_.safe[i] = to.velocity;
    }
}

std::int64_t Stopping::moving() const {
    for (std::uint32_t i = 0; i < derivative_->length; ++i) {
        if (velocity_.accepted[i] != 0) return i;
    }
    return -1;
}

}  // namespace cortex::cs
