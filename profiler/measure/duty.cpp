// SPDX-License-Identifier: Apache-2.0
// Duty cycle against the number of simplexes, each with one command per cycle: the paper's Fig. 23.
#include "measure/measurements.hpp"
#include "measure/simplex_sweep.hpp"
#include "measure/stated_load.hpp"
#include "report/number_text.hpp"

#include <utility>

namespace cortex::profiler {
namespace {

constexpr double paperSimplexes = 105;

Figure dutyFigure(const RunOptions& options, const Sweep& sweep) {
    Figure figure{.id = "fig23-duty-cycle",
                  .title = "Fig. 23: Duty cycle against the number of simplexes",
                  .paper =
                      "The duty cycle rises in proportion to the number of simplexes, "
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

void addTimePerSimplex(const SweepPoint& point, Results& results) {
    const double nanoseconds = 1e3 / point.x;
    Quantity time{.id = "duty/time-per-simplex",
                  .what = "time of the cycle per simplex with its command, at that number (median)",
                  .unit = "ns",
                  .value = point.measured.duration.percentile(0.5) * nanoseconds};
    for (const double block : point.measured.blockP50) time.repeats.push_back(block * nanoseconds);
    results.quantities.push_back(std::move(time));
}

void addCapacity(const Sweep& sweep, Results& results) {
    if (sweep.points.empty()) return;
    Quantity atSeventy = capacityOf(sweep, 20'000);
    atSeventy.id = "duty/simplexes-at-70";
    atSeventy.what =
        "most simplexes with a command per cycle each within 70 % duty cycle (p99), with all less";
    atSeventy.unit = "simplexes";
    atSeventy.paper = "105 at nearly 100 %";
    results.quantities.push_back(std::move(atSeventy));
    if (sweep.overflow() == 0) return;
    results
        .add("duty/simplexes-without-overflow", "most simplexes without overflow", "simplexes",
             sweep.withoutOverflow())
        .moreIsBetter()
        .inPaper("105");
    for (const SweepPoint& point : sweep.points) {
        if (point.x == sweep.withoutOverflow()) addTimePerSimplex(point, results);
    }
}

void addCommands(const Sweep& sweep, Results& results) {
    std::uint64_t executed = 0, expected = 0, rejected = 0;
    for (const auto& [x, measured] : sweep.points) {
        executed += measured.commands;
        expected += measured.expectedCommands;
        rejected += measured.rejected;
    }
    if (expected == 0) return;
    const auto difference =
        static_cast<double>(executed > expected ? executed - expected : expected - executed);
    results
        .add("duty/commands-missing", "commands more or less than cycles × simplexes", "commands",
             difference)
        .atMost(0);
    results
        .add("duty/commands-rejected", "rejected commands", "commands",
             static_cast<double>(rejected))
        .atMost(0);
}

double dutySeconds(const RunOptions& options) {
    return simplexSweepSeconds(options) + statedLoadSeconds(options);
}

void runDuty(const RunOptions& options, Progress& progress, Results& results) {
    const double sweepPart = simplexSweepSeconds(options) / dutySeconds(options);
    PartProgress sweeping{progress, 0, sweepPart}, judging{progress, sweepPart, 1};
    const Sweep& sweep = simplexSweep(options, sweeping, results);
    if (sweep.points.empty()) return;
    results.figures.push_back(dutyFigure(options, sweep));
    addCapacity(sweep, results);
    addCommands(sweep, results);
    const StatedLoad load{"duty/20000", "20,000 simplexes with a command per cycle each", 20'000,
                          1};
    judgeLoad(load, options, judging, results);
}

}  // namespace

Measurement dutyMeasurement() {
    return {"duty", "duty cycle against the number of simplexes (Fig. 23)",
            "Duty cycle against the number of simplexes (Fig. 23)", dutySeconds, runDuty};
}

}  // namespace cortex::profiler
