// SPDX-License-Identifier: Apache-2.0
#include "clocks.hpp"

#include "statistics.hpp"

#include <cstddef>
#include <ctime>

namespace cortex::network {

void TakingTurns::start() { origin_ = steadyNow(); }

cs::Trigger TakingTurns::waitForTick() {
    const std::int64_t due = (steadyNow() - origin_) / Period;
    if (due > next_) next_ = due;
    while (!interrupted_) {
        const std::int64_t deadline = origin_ + ++next_ * Period;
        const timespec time{deadline / 1'000'000'000, deadline % 1'000'000'000};
        while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) != 0) continue;
        if (next_ / perSecond % 2 == 0) return {next_ * Period, steadyNow() - deadline, 1, false};
        instead_();
    }
    return {0, 0, 1, true};
}

}  // namespace cortex::network
