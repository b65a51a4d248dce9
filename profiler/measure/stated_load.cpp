// SPDX-License-Identifier: Apache-2.0
#include "stated_load.hpp"

#include "measure/measured_loop.hpp"
#include "measure/sweep.hpp"
#include "report/judging.hpp"
#include "report/number_text.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

namespace cortex::profiler {
namespace {

constexpr double mostDuty = 70;  // %, p99

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
                   readable(blocks(options)) +
                   " s of each; an observer reads the newest image 30 times a second.";
    figure.x = {"duration of a cycle", "us", true};
    figure.y = {"share of cycles that are longer", "", true};
    figure.series.push_back({"loop", measured.duration.shareAbove(), false});
    figure.series.push_back({"work in registers", measured.workDuration.shareAbove(), true});
    figure.marks.push_back({Mark::Along::X, measured.period, "the period"});
    figure.marks.push_back(
        {Mark::Along::X, measured.period * mostDuty / 100, readable(mostDuty) + " %"});
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
    Quantity& judged = results.quantities.back();
    const Quantity verdict =
        judgedDuty(measured.duration, measured.workDuration, measured.period, mostDuty);
    judged.aim = verdict.aim;
    judged.limit = verdict.limit;
    judged.doubt = verdict.doubt;
    add("p99.9", "p99.9 of the duty cycle", measured.duty(0.999), {});
}

void addCounts(const StatedLoad& load, const Measured& measured, Results& results) {
    Quantity missed =
        judgedMissed({measured.missed, measured.cycles}, {measured.sleeperMissed, measured.sleeps},
                     {measured.workMissed, measured.works});
    missed.id = load.id + "/missed";
    missed.what = load.what + ": ticks missed of 10,000, less those of the bare sleeper";
    results.quantities.push_back(std::move(missed));
    const auto executed = static_cast<double>(measured.commands);
    const auto expected = static_cast<double>(measured.expectedCommands);
    results
        .add(load.id + "/commands", load.what + ": commands executed more or less than sent",
             "commands", std::abs(executed - expected))
        .atMost(0);
    results
        .add(load.id + "/images", load.what + ": images that the observer read", "1/s",
             static_cast<double>(measured.imagesRead) / measured.seconds)
        .moreIsBetter();
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
