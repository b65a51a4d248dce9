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

OnCpu::OnCpu(int number) {
    sched_getaffinity(0, sizeof before_, &before_);
    for (std::size_t cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
        if (!CPU_ISSET(cpu, &before_) || number-- > 0) continue;
        cpu_set_t only{};
        CPU_SET(cpu, &only);
        sched_setaffinity(0, sizeof only, &only);
        return;
    }
}

OnCpu::~OnCpu() { sched_setaffinity(0, sizeof before_, &before_); }

}  // namespace cortex::network
