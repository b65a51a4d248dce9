// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <thread>
#include <vector>

namespace cortex::profiler {

// Computes in registers: no memory, no branch that is mispredicted. Chains that do not depend on
// each other keep a core as busy as a loop of tasks does.
inline void computeRounds(std::int64_t rounds) {
    std::uint64_t a = 1, b = 2, c = 3, d = 4;
    for (std::int64_t i = 0; i < rounds; ++i) {
        a = (a ^ (a >> 3U)) + 5;
        b = (b ^ (b >> 3U)) + 7;
        c = (c ^ (c >> 3U)) + 11;
        d = (d ^ (d >> 3U)) + 13;
        asm volatile("" : "+r"(a), "+r"(b), "+r"(c), "+r"(d));  // each round is wanted
    }
}

// How many rounds take so long, in ns, where nothing disturbs them: by the best of short runs.
inline std::int64_t roundsOf(std::int64_t nanoseconds) {
    constexpr std::int64_t rounds = 10'000;
    std::int64_t best = std::numeric_limits<std::int64_t>::max();
    for (int i = 0; i < 20; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        computeRounds(rounds);
        const std::chrono::nanoseconds took = std::chrono::steady_clock::now() - begin;
        best = std::min<std::int64_t>(best, took.count());
    }
    return nanoseconds * rounds / std::max<std::int64_t>(best, 1);
}

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
