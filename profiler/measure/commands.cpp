// SPDX-License-Identifier: Apache-2.0
// Latency of commands against the frequency of the loop: the paper's Fig. 29.
#include "measure/measurements.hpp"
#include "measure/sweep.hpp"
#include "report/number_text.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::profiler {
namespace {

constexpr int simplexes = 1000;

SweepPlan plan(const RunOptions& options) {
    SweepPlan made;
    made.first = {100, 200, 500, 1000, 2000, 5000, 10'000};
    made.most = 100'000;
    made.grain = 10;
    made.bisections = options.quick ? 3 : 5;
    made.around = options.quick ? std::vector{1.3} : std::vector{0.85, 1.1, 1.3, 1.6};
    return made;
}

double loopSeconds(const RunOptions& options) { return options.quick ? 0.25 : 2; }

double commandsSeconds(const RunOptions& options) {
    return expectedSteps(plan(options)) *
           (loopSeconds(options) * 1.25 + settlingSeconds(options) + 0.1);
}

Figure latencyFigure(const RunOptions& options, const Sweep& sweep) {
    Figure figure;
    figure.id = "fig29-latency-frequency";
    figure.title = "Fig. 29: Latency of commands against the frequency of the loop";
    figure.paper =
        "Latency over the frequency of the loop at an unnamed number of simplexes with "
        "one command each; the text gives no values.";
    figure.setup =
        readable(simplexes) +
        " Active simplexes in pairs, one command per cycle each, with an item of their own and an "
        "output with two limited items; " +
        conditions(options, sweep.threads, 0) + "; " + readable(loopSeconds(options)) +
        " s a point. One of each pair is answered in the same cycle, the other in the "
        "next. A pair reads the clock, from before sending until it is executed. " +
        overflowText;
    figure.x = {"loop frequency", "Hz", true};
    figure.y = {"latency", "us", true};
    const auto add = [&](const char* name, const std::function<double(const Measured&)>& value,
                         bool baseline = false) {
        figure.series.push_back(lineOf(sweep, name, value, {}, baseline));
    };
    add("same cycle, p50", [](const Measured& m) { return m.sameCycle.percentile(0.5); });
    add("same cycle, p99", [](const Measured& m) { return m.sameCycle.percentile(0.99); });
    add("next cycle, p50", [](const Measured& m) { return m.nextCycle.percentile(0.5); });
    add("next cycle, p99", [](const Measured& m) { return m.nextCycle.percentile(0.99); });
    add("next cycle, max", [](const Measured& m) { return m.nextCycle.max(); });
    add("period", [](const Measured& m) { return m.period; }, true);
    markOverflow(sweep, figure);
    return figure;
}

void addQuantities(const Sweep& sweep, Results& results) {
    if (sweep.overflow() > 0) {
        results
            .add("commands/frequency-without-overflow",
                 "highest frequency without overflow of 1,000 "
                 "simplexes with one command each",
                 "Hz", sweep.withoutOverflow())
            .moreIsBetter()
            .inPaper("1000 with 105 simplexes");
    }
    for (const auto& [x, measured] : sweep.points) {
        if (x != 1000) continue;
        results.add("commands/same-cycle-p99",
                    "p99 latency in the same cycle at 1 kHz, 1,000 "
                    "simplexes with one command each",
                    "us", measured.sameCycle.percentile(0.99));
        results
            .add("commands/next-cycle-p99",
                 "p99 latency to the next cycle at 1 kHz, the same simplexes", "us",
                 measured.nextCycle.percentile(0.99))
            .beside(measured.period, "the period");
    }
}

void runCommands(const RunOptions& options, Progress& progress, Results& results) {
    const auto periods = [&](double frequency) {
        return std::max<std::int64_t>(200, std::llround(frequency * loopSeconds(options)));
    };
    const SweepSubject subject{
        "Hz",
        [&](double frequency) {
            return MeasuredLoop::ofPartners(simplexes, 1, frequency, options);
        },
        [&](double frequency) {
            return RecordingPlan{1, periods(frequency), periods(frequency) / 5};
        }};
    const Sweep sweep = sweepUpwards(plan(options), subject, progress, results);
    if (sweep.points.empty()) return;
    results.figures.push_back(latencyFigure(options, sweep));
    addQuantities(sweep, results);
}

}  // namespace

Measurement commandsMeasurement() {
    return {"commands", "latency of commands against the frequency of the loop (Fig. 29)",
            "Latency of commands against the frequency (Fig. 29)", commandsSeconds, runCommands};
}

}  // namespace cortex::profiler
