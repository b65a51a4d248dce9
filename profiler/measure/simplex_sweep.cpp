// SPDX-License-Identifier: Apache-2.0
#include "simplex_sweep.hpp"

#include <cmath>
#include <tuple>

namespace cortex::profiler {
namespace {

constexpr double paperCycles = 5000;
constexpr std::int64_t settling = 10;  // periods

struct Portion {
    int blocks;
    double loop, sleeper;  // periods in each
};

Portion portion(const RunOptions& options) {
    if (options.quick) return {3, 120, 40};
    return {5, paperCycles / 5, 400};
}

SweepPlan plan(const RunOptions& options) {
    SweepPlan made;
    made.first = {10, 30, 104, 300, 1000, 3000, 10000};
    made.most = 400'000;
    made.grain = 2;
    made.bisections = options.quick ? 4 : 6;
    made.around = options.quick ? std::vector{0.6, 0.8, 1.1, 1.3}
                                : std::vector{0.5, 0.6, 0.7, 0.8, 0.9, 1.05, 1.1, 1.2, 1.3, 1.6};
    return made;
}

double secondsEach(const RunOptions& options) {
    const Portion each = portion(options);
    return each.blocks * (each.loop + each.sleeper) / options.frequency;
}

}  // namespace

double simplexSweepSeconds(const RunOptions& options) {
    // Clusters of tens of thousands take most of a second to make.
    const double making = 0.5;
    return expectedSteps(plan(options)) *
           (secondsEach(options) + settlingSeconds(options) + making);
}

std::string simplexSweepSetup(const RunOptions& options, const Sweep& sweep) {
    const Portion each = portion(options);
    return "Pairs of simplexes, each sends its partner one command per cycle with one argument "
           "that is checked against its range and answered; " +
           conditions(options, sweep.threads, options.frequency) + "; " +
           number(each.blocks * each.loop) + " periods a point in turn with a bare sleeper of " +
           number(each.blocks * each.sleeper) +
           "; an observer reads the newest image 30 times a second. Overflow: p99 of the cycle is "
           "longer than the period, or more ticks are missed than by the sleeper and 1 in 100.";
}

const Sweep& simplexSweep(const RunOptions& options, Progress& progress, Results& results) {
    using Key = std::tuple<bool, std::uint32_t, double, int>;
    static Sweep made;
    static Key madeFor;
    const Key key{options.quick, options.threads, options.frequency, options.priority};
    if (made.complete && key == madeFor) return made;

    const Portion each = portion(options);
    RecordingPlan recording{each.blocks, std::llround(each.loop), std::llround(each.sleeper)};
    recording.settling = settling;
    const SweepSubject subject{"simplexes",
                               [&](double count) {
                                   return MeasuredLoop::ofPartners(std::llround(count), 1,
                                                                   options.frequency, options);
                               },
                               [&](double) { return recording; }};
    made = sweepUpwards(plan(options), subject, progress, results);
    madeFor = key;
    if (options.priority > 0) {
        noteRefusals({"Above 95 % duty cycle the kernel holds real-time threads back for 50 ms of "
                      "each second: the overflow points at real-time priority include that."},
                     results);
    }
    return made;
}

}  // namespace cortex::profiler
