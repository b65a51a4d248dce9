// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace cortex::profiler {

// The best that a loop can do on this machine: it sleeps to absolute deadlines on the monotonic
// clock, https://man7.org/linux/man-pages/man2/clock_nanosleep.2.html, and does nothing else.
// On the thread that calls, with its priority and its CPUs.
class BareSleeper {
public:
    explicit BareSleeper(std::int64_t period);  // ns; the first deadline is one period from now

    // Sleeps to the next deadline; ns from it to the wake-up. Deadlines that have passed already
    // are counted and skipped.
    std::int64_t sleep();
    std::int64_t tick() const { return next_; }  // deadlines that have passed
    std::int64_t missed() const { return missed_; }

private:
    std::int64_t period_, origin_;
    std::int64_t next_ = 0, missed_ = 0;
};

}  // namespace cortex::profiler
