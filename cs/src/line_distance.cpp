// SPDX-License-Identifier: Apache-2.0
#include "line_distance.hpp"

#include "pause_briefly.hpp"
#include "realtime_thread.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <thread>

namespace cortex::cs {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int rounds = 6, passes = 20;  // the first round waits for the other thread
constexpr std::chrono::milliseconds patience{10};
constexpr int pausesPerClockReading = 256;

struct alignas(64) Line {
    std::atomic<int> value{0};
};

bool waitFor(const Line& line, int value, Clock::time_point end) {
    for (int pauses = 1; line.value.load(std::memory_order_acquire) != value; ++pauses) {
        pauseBriefly();
        if (pauses % pausesPerClockReading == 0 && Clock::now() > end) return false;
    }
    return true;
}

double between(int cpu, int other) {
    if (cpu == other) return 0;
    Line line;
    const Clock::time_point end = Clock::now() + patience;
    std::thread answering{[&] {
        const OnCpu there{other};
        for (int pass = 0; pass < rounds * passes; ++pass) {
            if (!waitFor(line, 2 * pass + 1, end)) return;
            line.value.store(2 * pass + 2, std::memory_order_release);
        }
    }};
    double least = std::numeric_limits<double>::infinity();
    {
        const OnCpu here{cpu};
        bool answered = true;
        for (int pass = 0; answered && pass < rounds * passes;) {
            const auto begin = Clock::now();
            for (const int last = pass + passes; answered && pass < last; ++pass) {
                line.value.store(2 * pass + 1, std::memory_order_release);
                answered = waitFor(line, 2 * pass + 2, end);
            }
            const std::chrono::duration<double, std::micro> took = Clock::now() - begin;
            if (answered && pass > passes) least = std::min(least, took.count() / passes);
        }
    }
    answering.join();
    return least < std::numeric_limits<double>::infinity() ? least : 0;
}

}  // namespace

double lineMicroseconds(const std::vector<int>& affinity, std::uint32_t threads) {
    double sum = 0;
    int known = 0;
    for (std::uint32_t thread = 1; thread < threads; ++thread) {
        const double line = between(cpuForThread(affinity, 0), cpuForThread(affinity, thread));
        sum += line;
        known += line > 0 ? 1 : 0;
    }
    return known == 0 ? 0 : sum / known;
}

}  // namespace cortex::cs
