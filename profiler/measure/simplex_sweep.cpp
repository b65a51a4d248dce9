// SPDX-License-Identifier: Apache-2.0
#include "simplex_sweep.hpp"

#include "report/number_text.hpp"

#include <cmath>
#include <tuple>

namespace cortex::profiler {
namespace {

RecordingPlan portion(const RunOptions& options) {
    RecordingPlan plan{5, 1000, 400};  // the paper's 5,000 cycles
    if (options.quick) plan = {3, 120, 40};
    plan.settling = 10;
    return plan;
}

SweepPlan plan(const RunOptions& options) {
    SweepPlan made;
    made.first = {10, 30, 104, 300, 1000, 3000, 10000};
    made.most = 400'000;
    made.grain = 2;
    made.bisections = options.quick ? 4 : 6;
    made.duty = 70;
    made.around =
        options.quick ? std::vector{1.1, 1.3} : std::vector{0.8, 0.9, 1.05, 1.1, 1.3, 1.6};
    return made;
}

}  // namespace

double simplexSweepSeconds(const RunOptions& options) {
    const RecordingPlan each = portion(options);
    const auto periods =
        static_cast<double>(each.blocks * (each.loopPeriods + each.sleeperPeriods));
    const double making = 0.5;  // clusters of tens of thousands take most of a second
    return expectedSteps(plan(options)) *
           (periods / options.frequency + settlingSeconds(options) + making);
}

std::string simplexSweepSetup(const RunOptions& options, const Sweep& sweep) {
    const RecordingPlan each = portion(options);
    const auto periods = [&](std::int64_t n) {
        return readable(static_cast<double>(each.blocks * n));
    };
    return "Pairs of Active simplexes, each sends its partner one command per cycle with one "
           "argument "
           "that is checked against its range and answered, and writes an item of its own and an "
           "output with two items that are checked against their limits; " +
           conditions(options, sweep.threads, options.frequency) + "; " +
           periods(each.loopPeriods) + " periods a point in turn with a bare sleeper of " +
           periods(each.sleeperPeriods) +
           "; an observer reads the newest image 30 times a second. " + overflowText;
}

const Sweep& simplexSweep(const RunOptions& options, Progress& progress, Results& results) {
    using Key = std::tuple<bool, std::uint32_t, double, int>;
    static Sweep made;
    static Key madeFor;
    const Key key{options.quick, options.threads, options.frequency, options.priority};
    if (made.complete && key == madeFor) return made;

    const SweepSubject subject{"simplexes",
                               [&](double count) {
                                   return MeasuredLoop::ofPartners(std::llround(count), 1,
                                                                   options.frequency, options);
                               },
                               [&](double) { return portion(options); }};
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
