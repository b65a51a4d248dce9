// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"
#include "report/statistics.hpp"

#include <cstdint>
#include <vector>

// How what was measured becomes a verdict: met, missed, or not judged where the machine was too
// noisy. Everything here is a pure function.
namespace cortex::profiler {

// p99 of the lateness of wake-ups, second by second, us.
struct Lateness {
    std::vector<double> p99s;

    double typical() const { return median(p99s); }
    // How much of every two seconds the first differ from the others, 1 or more.
    double nullRatio() const;
};

// Of wake-ups in blocks of a second, ns.
template <class Wakes>
Lateness latenessOf(const Wakes& wakes) {
    Lateness lateness;
    std::vector<double> second;
    for (std::size_t i = 0; i < wakes.size(); ++i) {
        second.push_back(static_cast<double>(wakes[i].lateness) * 1e-3);
        if (i + 1 < wakes.size() && wakes[i + 1].block == wakes[i].block) continue;
        lateness.p99s.push_back(percentile(second, 0.99));
        second.clear();
    }
    return lateness;
}

// A loop and a bare sleeper in turn, on the same thread.
struct LoopAndSleeper {
    Lateness loop, sleeper;
    double ratio() const { return loop.typical() / sleeper.typical(); }
};

inline constexpr double mostLateness = 1.2;   // times the sleeper's
inline constexpr double mostNullRatio = 1.3;  // above it nothing is judged

// The lateness of the loop in that of the sleeper; 1.2 at most.
Quantity judgedLateness(const LoopAndSleeper& found);
// How that changes when something is added; the larger of 1.2 and the null ratio at most.
Quantity judgedChange(const LoopAndSleeper& with, const LoopAndSleeper& without);

// Ticks missed of all that there were.
struct Missed {
    std::int64_t ticks = 0, of = 0;
    double per10000() const;
};
// What the loop missed of 10,000 beyond the sleeper; 1 at most. Not judged where threads that only
// compute miss as many.
Quantity judgedMissed(const Missed& loop, const Missed& sleeper, const Missed& work);

// p99 of the duty cycle, in %; `most` at most. Not judged where it is above, the median is not, and
// threads that only compute for as long are above 1.3 times their median once in 100 cycles, too.
Quantity judgedDuty(const Histogram& duration, const Histogram& work, double period, double most);

// The most that a sweep found, `wanted` at least. Not judged where it is less and ended where half
// of the cycles took no more than half of `most`, in %: that was not the load.
Quantity judgedCapacity(double found, double medianDutyAbove, double most, double wanted);

// Best of the rounds, ns a task: a thread pool and a flow graph, and a plain loop over the same
// tasks, which is what both are compared with.
struct TaskTimes {
    std::vector<double> pool, plain;
    double peer = 0;
};
// What the pool adds to the plain loop; 5 ns and a tenth of what the flow graph adds at most. Not
// judged where the plain loop differs more than that from itself.
Quantity judgedOverhead(const TaskTimes& times);

}  // namespace cortex::profiler
