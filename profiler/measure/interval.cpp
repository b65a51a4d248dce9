// SPDX-License-Identifier: Apache-2.0
// Interval between two executions of a task, its deviation below and above the overflow point: the
// paper's Fig. 24, 25 and 26.
#include "measure/measurements.hpp"
#include "measure/simplex_sweep.hpp"

namespace cortex::profiler {
namespace {

using Holds = std::function<bool(const SweepPoint&)>;

Figure intervalFigure(const RunOptions& options, const Sweep& sweep) {
    Figure figure{.id = "fig24-interval",
                  .title = "Fig. 24: Interval between executions of a task",
                  .paper =
                      "A task is executed every millisecond up to 105 simplexes; from "
                      "110 on every cycle runs over its tick and the interval becomes 2 ms.",
                  .setup = simplexSweepSetup(options, sweep) +
                           " The task of one simplex in the middle notes when it begins.",
                  .x = {"simplexes", "", true},
                  .y = {"interval", "us", false},
                  .series = {},
                  .marks = {}};
    const auto add = [&](const char* name, const std::function<double(const Measured&)>& value) {
        figure.series.push_back(lineOf(sweep, name, value));
    };
    add("mean", [](const Measured& m) { return m.interval.mean(); });
    add("p50", [](const Measured& m) { return m.interval.percentile(0.5); });
    add("p99", [](const Measured& m) { return m.interval.percentile(0.99); });
    add("max", [](const Measured& m) { return m.interval.max(); });
    figure.marks.push_back({Mark::Along::X, 105, "paper: 105, the last at 1 ms"});
    markOverflow(sweep, figure);
    return figure;
}

Figure deviationFigure(const RunOptions& options, const Sweep& sweep, bool overflown,
                       const Holds& holds) {
    Figure figure;
    figure.id = overflown ? "fig26-interval-deviation-overflow" : "fig25-interval-deviation";
    figure.title = overflown ? "Fig. 26: Deviation of the interval above the overflow point"
                             : "Fig. 25: Deviation of the interval below the overflow point";
    figure.paper = overflown ? "The same from 110 to 130 simplexes, overflown: far larger."
                             : "Up to 100 simplexes the interval between executions "
                               "deviates by at most 3 us.";
    figure.setup = simplexSweepSetup(options, sweep) +
                   " Deviation: from the period, absolute, but for the standard one. The sleeper "
                   "runs on the loop's own thread.";
    figure.x = {"simplexes", "", true};
    figure.y = {"deviation", "us", true};
    const auto add = [&](const char* name, const std::function<double(const Measured&)>& value,
                         bool baseline = false) {
        figure.series.push_back(lineOf(sweep, name, value, holds, baseline));
    };
    add("standard", [](const Measured& m) { return m.interval.deviation(); });
    add("p99", [](const Measured& m) { return m.intervalError.percentile(0.99); });
    add("max", [](const Measured& m) { return m.intervalError.max(); });
    add(
        "sleeper, p99", [](const Measured& m) { return m.sleeperIntervalError.percentile(0.99); },
        true);
    add("sleeper, max", [](const Measured& m) { return m.sleeperIntervalError.max(); }, true);
    if (!overflown) figure.marks.push_back({Mark::Along::Y, 3, "paper: at most 3 us"});
    return figure;
}

void addQuantities(const Sweep& sweep, const Holds& below, Results& results) {
    Quantity error{.id = "interval/deviation-p99",
                   .what =
                       "p99 deviation of the interval below the overflow point, median of all "
                       "numbers of simplexes",
                   .unit = "us",
                   .baselineName = "bare sleeper",
                   .paper = "at most 3 us"};
    std::vector<double> sleeper;
    for (const SweepPoint& point : sweep.points) {
        if (!below(point)) continue;
        error.repeats.push_back(point.measured.intervalError.percentile(0.99));
        sleeper.push_back(point.measured.sleeperIntervalError.percentile(0.99));
    }
    if (error.repeats.empty()) return;
    error.value = median(error.repeats);
    error.baseline = median(sleeper);
    results.quantities.push_back(std::move(error));
}

void runInterval(const RunOptions& options, Progress& progress, Results& results) {
    const Sweep& sweep = simplexSweep(options, progress, results);
    if (sweep.points.empty()) return;
    const Holds below = [&](const SweepPoint& point) { return point.x <= sweep.withoutOverflow(); };
    const Holds above = [&](const SweepPoint& point) { return point.x > sweep.withoutOverflow(); };
    results.figures.push_back(intervalFigure(options, sweep));
    results.figures.push_back(deviationFigure(options, sweep, false, below));
    results.figures.push_back(deviationFigure(options, sweep, true, above));
    addQuantities(sweep, below, results);
}

}  // namespace

Measurement intervalMeasurement() {
    return {"interval",
            "interval between executions of a task, below and above overflow (Fig. 24 to 26)",
            "Interval between executions (Fig. 24 to 26)", simplexSweepSeconds, runInterval};
}

}  // namespace cortex::profiler
