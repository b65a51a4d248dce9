// SPDX-License-Identifier: Apache-2.0
// Latency of commands of 10 simplexes against how many each sends: the paper's Fig. 27 and 28.
#include "measure/measurements.hpp"
#include "measure/stated_load.hpp"
#include "measure/sweep.hpp"
#include "report/number_text.hpp"

#include <cmath>
#include <utility>

namespace cortex::profiler {
namespace {

using Holds = std::function<bool(const SweepPoint&)>;
using Value = std::function<double(const Measured&)>;

constexpr int simplexes = 10;
constexpr double paperCommands = 10;

SweepPlan plan(const RunOptions& options) {
    SweepPlan made;
    made.first = {1, 3, 10, 30, 100, 300, 1000, 2000};
    made.most = 100'000;
    made.bisections = options.quick ? 4 : 6;
    made.duty = 70;
    made.around =
        options.quick ? std::vector{1.1, 1.5} : std::vector{0.8, 0.9, 1.05, 1.1, 1.3, 1.6, 2.0};
    return made;
}

RecordingPlan portion(const RunOptions& options) {
    if (options.quick) return {3, 100, 20};
    return {5, 500, 100};
}

double sweepSeconds(const RunOptions& options) {
    const RecordingPlan each = portion(options);
    const auto periods = static_cast<double>(each.loopPeriods + each.sleeperPeriods);
    return expectedSteps(plan(options)) *
           (periods / options.frequency + 0.1 + settlingSeconds(options));
}

double latencySeconds(const RunOptions& options) {
    return sweepSeconds(options) + statedLoadSeconds(options);
}

std::string setup(const RunOptions& options, const Sweep& sweep) {
    const RecordingPlan each = portion(options);
    return "10 Active simplexes in pairs, each sends so many commands per cycle and writes an item "
           "of "
           "its own and an output with two limited items; " +
           conditions(options, sweep.threads, options.frequency) + "; " +
           readable(static_cast<double>(each.blocks * each.loopPeriods)) +
           " periods a point. One of each pair is answered in the same cycle, the other in the "
           "next. A pair reads the clock: from before the first command is sent until the last one "
           "of the cycle has been executed. " +
           overflowText;
}

void addLatencies(Figure& figure, const Sweep& sweep, const Holds& holds) {
    const auto add = [&](const char* name, const Value& value) {
        figure.series.push_back(lineOf(sweep, name, value, holds));
    };
    add("same cycle, p50", [](const Measured& m) { return m.sameCycle.percentile(0.5); });
    add("same cycle, p99", [](const Measured& m) { return m.sameCycle.percentile(0.99); });
    add("same cycle, max", [](const Measured& m) { return m.sameCycle.max(); });
    add("next cycle, p50", [](const Measured& m) { return m.nextCycle.percentile(0.5); });
    add("next cycle, p99", [](const Measured& m) { return m.nextCycle.percentile(0.99); });
    add("next cycle, max", [](const Measured& m) { return m.nextCycle.max(); });
    add("all, p99 of the metric", [](const Measured& m) { return m.clusterLatencyP99; });
}

Figure latencyFigure(const RunOptions& options, const Sweep& sweep, bool overflown,
                     const Holds& holds) {
    Figure figure;
    figure.id = overflown ? "fig28-latency-overflow" : "fig27-latency";
    figure.title = overflown ? "Fig. 28: Latency of commands above the overflow point"
                             : "Fig. 27: Latency of commands below the overflow point";
    figure.paper = overflown
                       ? "Above 10 commands per simplex the loop overflows, runs at "
                         "500 Hz, and latency is 2 ms and more; from 13 on it varies less again."
                       : "Latency varies the more the more commands each of 10 simplexes "
                         "sends, by up to 14 us; 10 commands are the most without overflow.";
    figure.setup = setup(options, sweep);
    figure.x = {"commands per simplex and cycle", "", true};
    figure.y = {"latency", "us", true};
    addLatencies(figure, sweep, holds);
    if (!overflown) {
        figure.marks.push_back({Mark::Along::X, paperCommands, "paper: the last without overflow"});
    }
    markOverflow(sweep, figure);
    return figure;
}

Figure deviationFigure(const RunOptions& options, const Sweep& sweep, bool overflown,
                       const Holds& holds) {
    Figure figure;
    figure.id = overflown ? "fig28-latency-deviation-overflow" : "fig27-latency-deviation";
    figure.title = overflown ? "Fig. 28: Deviation of latency above the overflow point"
                             : "Fig. 27: Deviation of latency below the overflow point";
    figure.paper = overflown ? "Overflown, latency deviates in steps of the period."
                             : "Latency deviates by at most 14 us before the overflow.";
    figure.setup = setup(options, sweep) + " Deviation: from the median, absolute.";
    figure.x = {"commands per simplex and cycle", "", true};
    figure.y = {"deviation", "us", true};
    const auto add = [&](const char* name, const Value& value, bool baseline = false) {
        figure.series.push_back(lineOf(sweep, name, value, holds, baseline));
    };
    add("same cycle, p99", [](const Measured& m) { return m.sameCycleError.percentile(0.99); });
    add("same cycle, max", [](const Measured& m) { return m.sameCycleError.max(); });
    add("next cycle, p99", [](const Measured& m) { return m.nextCycleError.percentile(0.99); });
    add("next cycle, max", [](const Measured& m) { return m.nextCycleError.max(); });
    add(
        "interval of the sleeper, p99",
        [](const Measured& m) { return m.sleeperIntervalError.percentile(0.99); }, true);
    if (!overflown) figure.marks.push_back({Mark::Along::Y, 14, "paper: at most 14 us"});
    return figure;
}

void addCapacity(const Sweep& sweep, Results& results) {
    Quantity atSeventy = capacityOf(sweep, 2000);
    atSeventy.id = "latency/commands-at-70";
    atSeventy.what =
        "most commands per cycle of each of 10 simplexes within 70 % duty cycle (p99), with all "
        "less";
    atSeventy.unit = "commands";
    atSeventy.paper = "10 at nearly 100 %";
    results.quantities.push_back(std::move(atSeventy));
    if (sweep.overflow() == 0) return;
    results
        .add("latency/commands-without-overflow",
             "most commands per cycle of each of 10 simplexes without "
             "overflow",
             "commands", sweep.withoutOverflow())
        .moreIsBetter()
        .inPaper("10");
}

void addLatency(const Sweep& sweep, Results& results) {
    std::int64_t cycles = 0;
    std::uint64_t executed = 0, expected = 0;
    for (const auto& [x, measured] : sweep.points) {
        cycles = std::max(cycles, measured.greatestLatencyCycles);
        executed += measured.commands;
        expected += measured.expectedCommands;
        if (x != paperCommands) continue;
        results.add("latency/same-cycle-p99",
                    "p99 latency in the same cycle, 10 simplexes with "
                    "10 commands each",
                    "us", measured.sameCycle.percentile(0.99));
        results
            .add("latency/next-cycle-deviation-p99",
                 "p99 deviation of latency to the next cycle, 10 "
                 "simplexes with 10 commands each",
                 "us", measured.nextCycleError.percentile(0.99))
            .beside(measured.sleeperIntervalError.percentile(0.99), "interval of a bare sleeper")
            .inPaper("at most 14 us");
    }
    if (expected == 0) return;
    results
        .add("latency/cycles", "greatest latency of a command in executed cycles", "cycles",
             static_cast<double>(cycles))
        .atMost(1)
        .inPaper("2 ms, overflown");
    const double difference = static_cast<double>(executed) - static_cast<double>(expected);
    results
        .add("latency/commands-missing", "commands executed more or less than sent, all points",
             "commands", std::abs(difference))
        .atMost(0);
}

void runLatency(const RunOptions& options, Progress& progress, Results& results) {
    const SweepSubject subject{"commands per simplex",
                               [&](double commands) {
                                   return MeasuredLoop::ofPartners(
                                       simplexes, static_cast<std::uint32_t>(commands),
                                       options.frequency, options);
                               },
                               [&](double) { return portion(options); }};
    const double sweepPart = sweepSeconds(options) / latencySeconds(options);
    PartProgress sweeping{progress, 0, sweepPart}, judging{progress, sweepPart, 1};
    const Sweep sweep = sweepUpwards(plan(options), subject, sweeping, results);
    if (sweep.points.empty()) return;
    const Holds below = [&](const SweepPoint& point) { return point.x <= sweep.withoutOverflow(); };
    const Holds above = [&](const SweepPoint& point) { return point.x > sweep.withoutOverflow(); };
    results.figures.push_back(latencyFigure(options, sweep, false, below));
    results.figures.push_back(deviationFigure(options, sweep, false, below));
    results.figures.push_back(latencyFigure(options, sweep, true, above));
    results.figures.push_back(deviationFigure(options, sweep, true, above));
    addCapacity(sweep, results);
    addLatency(sweep, results);
    const StatedLoad load{"latency/2000", "10 simplexes with 2,000 commands per cycle each", 10,
                          2000};
    judgeLoad(load, options, judging, results);
}

}  // namespace

Measurement latencyMeasurement() {
    return {"latency", "latency of commands against how many are sent (Fig. 27 and 28)",
            "Latency of commands against their number (Fig. 27 and 28)", latencySeconds,
            runLatency};
}

}  // namespace cortex::profiler
