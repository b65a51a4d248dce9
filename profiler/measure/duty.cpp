// SPDX-License-Identifier: Apache-2.0
// Duty cycle against the number of simplexes, each with one command per cycle: the paper's Fig. 23.
#include "measure/measurements.hpp"
#include "measure/simplex_sweep.hpp"

#include <utility>

namespace cortex::profiler {
namespace {

constexpr double paperSimplexes = 105;

Figure dutyFigure(const RunOptions& options, const Sweep& sweep) {
    Figure figure{.id = "fig23-duty-cycle",
                  .title = "Duty cycle against the number of simplexes",
                  .paper =
                      "Fig. 23: the duty cycle rises in proportion to the number of simplexes, "
                      "each of which sends one command per cycle; about 105 of them fill the "
                      "period of 1 kHz on 4 threads.",
                  .setup = simplexSweepSetup(options, sweep),
                  .x = {"simplexes", "", true},
                  .y = {"duty cycle", "%", true},
                  .series = {},
                  .marks = {}};
    figure.series.push_back(lineOf(sweep, "mean", [](const Measured& m) { return m.meanDuty(); }));
    figure.series.push_back(lineOf(sweep, "p50", [](const Measured& m) { return m.duty(0.5); }));
    figure.series.push_back(lineOf(sweep, "p99", [](const Measured& m) { return m.duty(0.99); }));
    figure.marks.push_back({Mark::Along::X, paperSimplexes, "paper: 105 simplexes, nearly 100 %"});
    figure.marks.push_back({Mark::Along::Y, 100, "the whole period"});
    figure.marks.push_back({Mark::Along::Y, 70, "70 %"});
    markOverflow(sweep, figure);
    return figure;
}

void addCapacity(const Sweep& sweep, Results& results) {
    if (sweep.points.empty()) return;
    Quantity atSeventy{.id = "duty/simplexes-at-70",
                       .what = "simplexes with a command per cycle each at 70 % duty cycle (p99)",
                       .unit = "simplexes",
                       .value = sweep.atDuty(70),
                       .aim = Aim::AtLeast,
                       .limit = 20'000,
                       .paper = "105 at nearly 100 %",
                       .lessIsBetter = false};
    results.quantities.push_back(std::move(atSeventy));
    if (sweep.overflow == 0) return;
    results.quantities.push_back({.id = "duty/simplexes-without-overflow",
                                  .what = "most simplexes without overflow",
                                  .unit = "simplexes",
                                  .value = sweep.withoutOverflow,
                                  .paper = "105",
                                  .lessIsBetter = false});
    for (const SweepPoint& point : sweep.points) {
        if (point.x != sweep.withoutOverflow) continue;
        results.quantities.push_back(
            {.id = "duty/time-per-simplex",
             .what = "time of the cycle per simplex with its command, at that number (median)",
             .unit = "ns",
             .value = point.measured.duration.percentile(0.5) * 1e3 / point.x});
    }
}

void addCorrectness(const Sweep& sweep, Results& results) {
    std::uint64_t executed = 0, expected = 0, rejected = 0, images = 0;
    double readings = 0, seconds = 0;
    for (const auto& [x, measured] : sweep.points) {
        executed += measured.commands;
        expected += measured.expectedCommands;
        rejected += measured.rejected;
        images += measured.imagesRead;
        seconds += measured.seconds;
        readings = measured.clockReadings;
    }
    if (expected == 0) return;
    const auto difference =
        static_cast<double>(executed > expected ? executed - expected : expected - executed);
    const auto share = static_cast<double>(executed) / static_cast<double>(expected);
    results.quantities.push_back({.id = "duty/commands-executed",
                                  .what = "executed commands per cycle and simplex, all points",
                                  .unit = "",
                                  .value = share,
                                  .aim = Aim::AtLeast,
                                  .limit = 1,
                                  .lessIsBetter = false});
    results.quantities.push_back({.id = "duty/commands-missing",
                                  .what = "commands more or less than cycles × simplexes",
                                  .unit = "commands",
                                  .value = difference,
                                  .aim = Aim::AtMost,
                                  .limit = 0});
    results.quantities.push_back({.id = "duty/commands-rejected",
                                  .what = "rejected commands",
                                  .unit = "commands",
                                  .value = static_cast<double>(rejected),
                                  .aim = Aim::AtMost,
                                  .limit = 0});
    results.quantities.push_back({.id = "duty/observer-images",
                                  .what = "images that the observer read",
                                  .unit = "1/s",
                                  .value = static_cast<double>(images) / seconds,
                                  .lessIsBetter = false});
    results.quantities.push_back(
        {.id = "duty/recording-cost",
         .what = "cost of recording a cycle: " + number(readings) + " readings of the clock",
         .unit = "ns",
         .value = readings * clockReadingCost()});
}

void run(const RunOptions& options, Progress& progress, Results& results) {
    const Sweep& sweep = simplexSweep(options, progress, results);
    if (sweep.points.empty()) return;
    results.figures.push_back(dutyFigure(options, sweep));
    addCapacity(sweep, results);
    addCorrectness(sweep, results);
}

}  // namespace

Measurement dutyMeasurement() {
    return {"duty", "duty cycle against the number of simplexes (paper: Fig. 23)",
            simplexSweepSeconds, run};
}

}  // namespace cortex::profiler
