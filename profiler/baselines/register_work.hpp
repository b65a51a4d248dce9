// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace cortex::profiler {

// Cycles of a loop that only computes in registers, on the calling thread and on others, which have
// nothing to tell each other but that they have begun and ended: what makes some cycles longer than
// others is the machine. The others have SCHED_FIFO `priority` (0: none) and a CPU each, as far as
// the system lets them; between cycles they sleep to the next,
// https://man7.org/linux/man-pages/man2/clock_nanosleep.2.html.
class RegisterWork {
public:
    RegisterWork(std::uint32_t threads, int priority);
    ~RegisterWork();
    RegisterWork(const RegisterWork&) = delete;
    RegisterWork& operator=(const RegisterWork&) = delete;

    void prepare(std::int64_t deadline);  // the others wake then; monotonic, ns
    // Once after each prepare(): on all threads; returns when the last is done.
    void cycle(std::int64_t rounds);

private:
    void help(std::uint32_t number, int priority);

    std::atomic<std::int64_t> deadline_{0}, rounds_{0};
    std::atomic<std::uint32_t> prepared_{0}, begun_{0}, done_{0};
    std::atomic<bool> ending_{false};
    std::vector<std::thread> helpers_;
};

}  // namespace cortex::profiler
