// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace cortex {

// What a task sees of time. Control laws use cycle, nominalTime and elapsed; what divides by time
// or compares with the outside uses passed. Lateness is measured and differs from run to run.
struct Tick {
    static constexpr std::int64_t mostPeriods = 3;  // of the task, that one of its runs is worth

    std::int64_t cycle = 0;        // executed cycles, from 1
    std::int64_t nominalTime = 0;  // ns since the cluster's start: the deadline, not the wake-up
    std::int64_t passed = 0;       // ns of nominal time since this simplex last ran
    // The same, but at most `mostPeriods`: whatever moves makes up for no standstill of the loop.
    std::int64_t elapsed = 0;   // ns
    std::int64_t lateness = 0;  // ns from the deadline to the wake-up

    double seconds() const { return static_cast<double>(nominalTime) * 1e-9; }
    double passedSeconds() const { return static_cast<double>(passed) * 1e-9; }
    double elapsedSeconds() const { return static_cast<double>(elapsed) * 1e-9; }
};

}  // namespace cortex
