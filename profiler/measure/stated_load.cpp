// SPDX-License-Identifier: Apache-2.0
#include "stated_load.hpp"

#include "measure/measured_loop.hpp"
#include "measure/sweep.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace cortex::profiler {
namespace {

constexpr double mostDuty = 70;   // %, p99
constexpr double mostMissed = 1;  // of 10,000, beyond the sleeper

int blocks(const RunOptions& options) { return options.quick ? 5 : 60; }

Figure figureOf(const StatedLoad& load, const RunOptions& options, const Measured& measured,
                std::uint32_t threads) {
    Figure figure;
    figure.id = load.id;
    std::ranges::replace(figure.id, '/', '-');
    figure.title = "Duration of single cycles, " + load.what;
    figure.setup = conditions(options, threads, options.frequency) +
                   "; loop, bare sleeper, and as many threads that work in registers alone for as "
                   "long as a cycle takes, in turn, a second each, " +
                   number(blocks(options)) +
                   " s of each; an observer reads the newest image 30 times a second.";
    figure.x = {"duration of a cycle", "us", true};
    figure.y = {"share of cycles that are longer", "", true};
    figure.series.push_back({"loop", measured.duration.shareAbove(), false});
    figure.series.push_back({"work in registers", measured.workDuration.shareAbove(), true});
    figure.marks.push_back({Mark::Along::X, measured.period, "the period"});
    figure.marks.push_back(
        {Mark::Along::X, measured.period * mostDuty / 100, number(mostDuty) + " %"});
    figure.marks.push_back({Mark::Along::Y, 0.01, "p99"});
    return figure;
}

void addDuty(const StatedLoad& load, const Measured& measured, Results& results) {
    const auto add = [&](const char* name, const char* what, double value,
                         const std::vector<double>& blocks) {
        Quantity& duty = results.quantities.emplace_back();
        duty.id = load.id + "/duty-" + name;
        duty.what = load.what + ": " + what;
        duty.unit = "%";
        duty.value = value;
        for (const double block : blocks) duty.repeats.push_back(100 * block / measured.period);
    };
    add("p50", "median duty cycle", measured.duty(0.5), measured.blockP50);
    add("p99", "p99 of the duty cycle", measured.duty(0.99), measured.blockP99);
    results.quantities.back().aim = Aim::AtMost;
    results.quantities.back().limit = mostDuty;
    add("p99.9", "p99.9 of the duty cycle", measured.duty(0.999), {});
    const auto spread = [](const Histogram& of) {
        return of.percentile(0.99) / std::max(1e-3, of.percentile(0.5));
    };
    results.quantities.push_back({.id = load.id + "/spread",
                                  .what = load.what + ": p99 of the duration over its median",
                                  .unit = "",
                                  .value = spread(measured.duration),
                                  .baseline = spread(measured.workDuration),
                                  .baselineName = "work in registers"});
}

double per10000(std::int64_t missed, std::int64_t of) {
    return static_cast<double>(missed) * 10'000 / std::max(1.0, static_cast<double>(of));
}

void addCounts(const StatedLoad& load, const Measured& measured, Results& results) {
    const double sleeper = per10000(measured.sleeperMissed, measured.sleeps);
    const auto addMissed = [&](const char* name, const char* what, double missed) -> Quantity& {
        results.quantities.push_back({.id = load.id + name,
                                      .what = load.what + what,
                                      .unit = "ticks",
                                      .value = std::max(0.0, missed - sleeper),
                                      .baseline = sleeper,
                                      .baselineName = "bare sleeper"});
        return results.quantities.back();
    };
    Quantity& missed = addMissed("/missed", ": ticks missed of 10,000, less those of the sleeper",
                                 per10000(measured.missed, measured.cycles));
    missed.aim = Aim::AtMost;
    missed.limit = mostMissed;
    const double workMissed = per10000(measured.workMissed, measured.works);
    addMissed("/work-missed", ": the same of as many threads that work in registers", workMissed);
    if (workMissed - sleeper > mostMissed) {
        results.notes.push_back("Too noisy for the ticks missed by " + load.what +
                                " to be judged: work in registers missed too many; run it again.");
    }
    const auto executed = static_cast<double>(measured.commands);
    const auto expected = static_cast<double>(measured.expectedCommands);
    results.quantities.push_back({.id = load.id + "/commands",
                                  .what = load.what + ": commands executed more or less than sent",
                                  .unit = "commands",
                                  .value = std::abs(executed - expected),
                                  .aim = Aim::AtMost,
                                  .limit = 0});
    results.quantities.push_back(
        {.id = load.id + "/images",
         .what = load.what + ": images that the observer read",
         .unit = "1/s",
         .value = static_cast<double>(measured.imagesRead) / measured.seconds,
         .lessIsBetter = false});
}

}  // namespace

double statedLoadSeconds(const RunOptions& options) {
    return 3 * blocks(options) + settlingSeconds(options) + 1;
}

void judgeLoad(const StatedLoad& load, const RunOptions& options, Progress& progress,
               Results& results) {
    if (!progress.step(0, load.what)) return;
    const auto loop =
        MeasuredLoop::ofPartners(load.simplexes, load.commands, options.frequency, options);
    noteRefusals(loop->refusals(), results);
    const auto periods = static_cast<std::int64_t>(std::llround(options.frequency));
    RecordingPlan plan{blocks(options), periods, periods, periods};
    plan.settling = periods / 100;
    plan.workThreads = loop->threads();
    plan.workPriority = options.priority;
    const auto begin = std::chrono::steady_clock::now();
    const Measured measured = loop->run(plan, [&] {
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
        return !progress.step(std::min(passed.count() / statedLoadSeconds(options), 1.0),
                              load.what);
    });
    if (measured.cycles == 0 || measured.sleeps == 0) return;
    results.figures.push_back(figureOf(load, options, measured, loop->threads()));
    addDuty(load, measured, results);
    addCounts(load, measured, results);
}

}  // namespace cortex::profiler
