// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"
#include "cortex/core/type_model.hpp"

#include <cstdint>

namespace cortex::cs {

// One number and its change per second.
struct Motion {
    double position = 0, velocity = 0;
};

struct StopLimits {
    double min, max;      // of the position
    double deceleration;  // rate of the velocity; infinite: at once
};

// A cycle later: the velocity is nearer to 0 by the deceleration, and the position is where the
// mean of both velocities leads while it moves, p' = p + (v + v')·t/2 with t = dt, or
// |v|/deceleration where that is less: a long cycle makes no longer way. At the end of its range it
// stands.
Motion slowed(const Motion& from, const StopLimits& limits, double elapsedSeconds) CORTEX_REALTIME;

// Two items of one demand that are safe="stop": an item and the one that is derivativeOf it. As
// each cycle begins from what went out last, this has no state of its own.
class Stopping {
public:
    struct Cells {
        const double* accepted;  // as it went out last
        double* safe;
    };
    Stopping(const DataItem& item, const DataItem& derivative, Cells position, Cells velocity);

    // Writes the safe values of this cycle.
    void step(double elapsedSeconds) const CORTEX_REALTIME;
    // Whether it still moves: the place of the first element that does, or -1.
    std::int64_t moving() const CORTEX_REALTIME;
    const DataItem& derivative() const { return *derivative_; }
    double velocity(std::int64_t element) const { return velocity_.accepted[element]; }

private:
    const DataItem* derivative_;
    Cells position_, velocity_;
    StopLimits limits_;
};

}  // namespace cortex::cs
