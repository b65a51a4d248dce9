// SPDX-License-Identifier: Apache-2.0
#include "bare_sleeper.hpp"

#include <ctime>

namespace cortex::profiler {
namespace {

std::int64_t now() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec * 1'000'000'000 + time.tv_nsec;
}

}  // namespace

BareSleeper::BareSleeper(std::int64_t period) : period_{period}, origin_{now()} {}

std::int64_t BareSleeper::sleep() {
    const std::int64_t due = (now() - origin_) / period_;
    if (due > next_) {
        missed_ += due - next_;
        next_ = due;
    }
    const std::int64_t deadline = origin_ + ++next_ * period_;
    const timespec time{deadline / 1'000'000'000, deadline % 1'000'000'000};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) != 0) continue;
    return now() - deadline;
}

}  // namespace cortex::profiler
