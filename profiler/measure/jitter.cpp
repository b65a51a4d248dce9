// SPDX-License-Identifier: Apache-2.0
// Jitter of 50 empty simplexes against the frequency of the loop, the paper's Fig. 30, and the
// lateness at 1 kHz judged against a bare sleeper.
#include "measure/measurements.hpp"
#include "measure/sweep.hpp"
#include "report/judging.hpp"
#include "report/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cortex::profiler {
namespace {

using Value = std::function<double(const Measured&)>;

constexpr int jitterSimplexes = 50;
constexpr double judgedFrequency = 1000;

std::vector<double> frequencies() {
    return {50, 100, 200, 400, 700, 1000, 2000, 3000, 5000, 10'000};
}

double secondsEach(const RunOptions& options) { return options.quick ? 0.5 : 8; }  // both
int judgedSeconds(const RunOptions& options) { return options.quick ? 4 : 60; }

// Of the loop at one frequency, and as many of the sleeper.
std::int64_t periodsEach(const RunOptions& options, double frequency) {
    return std::max<std::int64_t>(50, std::llround(frequency * secondsEach(options) / 2));
}

double jitterSeconds(const RunOptions& options) {
    double sum = 2 * judgedSeconds(options);
    for (const double frequency : frequencies()) {
        const std::int64_t periods = 2 * periodsEach(options, frequency) + RecordingPlan{}.runIn;
        sum += static_cast<double>(periods) / frequency + 0.05;
    }
    return sum;
}

Figure jitterFigure(const RunOptions& options, const Sweep& sweep) {
    Figure figure;
    figure.id = "fig30-jitter";
    figure.title = "Fig. 30: Jitter against the frequency of the loop";
    figure.paper =
        "With 50 empty simplexes jitter stays between -0.02 and 0.01 (no unit is given) "
        "below 400 Hz, and grows and varies more above.";
    figure.setup =
        "50 empty simplexes, Active, without items and outputs of their own; " +
        conditions(options, sweep.threads, 0) + "; " + readable(secondsEach(options)) +
        " s a point, half of it a bare sleeper on the same thread in turn. Jitter: how late "
        "a cycle begins after its deadline.";
    figure.x = {"loop frequency", "Hz", true};
    figure.y = {"jitter", "us", true};
    const auto add = [&](const char* name, const Value& value, bool baseline = false) {
        figure.series.push_back(lineOf(sweep, name, value, {}, baseline));
    };
    for (const auto& [name, part] : {std::pair{"p50", 0.5}, {"p99", 0.99}, {"p99.9", 0.999}}) {
        add(name, [part](const Measured& m) { return m.lateness.percentile(part); });
    }
    add("max", [](const Measured& m) { return m.lateness.max(); });
    add("standard deviation", [](const Measured& m) { return m.lateness.deviation(); });
    add("sleeper, p50", [](const Measured& m) { return m.sleeperLateness.percentile(0.5); }, true);
    add("sleeper, p99", [](const Measured& m) { return m.sleeperLateness.percentile(0.99); }, true);
    add("sleeper, max", [](const Measured& m) { return m.sleeperLateness.max(); }, true);
    figure.marks.push_back({Mark::Along::X, 400, "paper: larger above 400 Hz"});
    return figure;
}

bool measureJitter(const RunOptions& options, Steps& steps, Results& results) {
    Sweep sweep;
    for (const double frequency : frequencies()) {
        if (!steps.next(readable(frequency) + " Hz")) break;
        const auto loop = MeasuredLoop::ofEmpty(jitterSimplexes, frequency, options);
        sweep.threads = loop->threads();
        noteRefusals(loop->refusals(), results);
        const std::int64_t half = periodsEach(options, frequency) / 2;
        Measured measured = loop->run({2, half, half}, [&] { return !steps.keepsOn(); });
        if (!measured.complete) break;
        sweep.points.push_back({frequency, std::move(measured)});
    }
    if (!sweep.points.empty()) results.figures.push_back(jitterFigure(options, sweep));
    return !steps.stopped();
}

Figure latenessFigure(const RunOptions& options, const Measured& measured, std::uint32_t threads) {
    Figure figure;
    figure.id = "fig30-lateness-1khz";
    figure.title = "Lateness of single cycles at 1 kHz";
    figure.setup = "50 empty simplexes, Active, without items and outputs of their own; " +
                   conditions(options, threads, judgedFrequency) +
                   "; loop and bare sleeper in turn, a second each, " +
                   readable(judgedSeconds(options)) + " s of each.";
    figure.x = {"lateness", "us", true};
    figure.y = {"share of cycles that are later", "", true};
    figure.series.push_back({"loop", measured.lateness.shareAbove(), false});
    figure.series.push_back({"bare sleeper", measured.sleeperLateness.shareAbove(), true});
    figure.marks.push_back({Mark::Along::Y, 0.01, "p99"});
    return figure;
}

void addTails(const Measured& measured, Results& results) {
    const auto& [loop, sleeper] = measured.judged;
    const auto add = [&](const char* id, const char* what, double ours, double floor,
                         std::vector<double> repeats) {
        results.add(id, what, "us", ours)
            .ofRepeats(std::move(repeats))
            .beside(floor, "bare sleeper")
            .inPaper("below 40 us, no percentile given");
    };
    const Histogram &ours = measured.lateness, &floor = measured.sleeperLateness;
    add("jitter/lateness-p99", "median of the seconds' p99 of lateness, 1 kHz", loop.typical(),
        sleeper.typical(), loop.p99s);
    add("jitter/lateness-p99.9", "p99.9 of lateness, 1 kHz", ours.percentile(0.999),
        floor.percentile(0.999), {});
    add("jitter/lateness-p99.99", "p99.99 of lateness, 1 kHz", ours.percentile(0.9999),
        floor.percentile(0.9999), {});
    add("jitter/lateness-max", "greatest lateness, 1 kHz", ours.max(), floor.max(), {});
}

void addMissed(const Measured& measured, Results& results) {
    results
        .add("jitter/missed-ticks", "ticks missed by 50 empty simplexes at 1 kHz", "ticks",
             static_cast<double>(measured.missed))
        .beside(static_cast<double>(measured.sleeperMissed), "bare sleeper");
}

void judgeLateness(const RunOptions& options, Steps& steps, Results& results) {
    if (!steps.next("lateness at 1 kHz beside a bare sleeper")) return;
    const auto loop = MeasuredLoop::ofEmpty(jitterSimplexes, judgedFrequency, options);
    const int blocks = judgedSeconds(options);
    int asked = 0;
    const Measured measured = loop->run({blocks, 1000, 1000}, [&] {
        // A step for each part of this longest one, so that it is seen to go on.
        return ++asked % (2 * blocks) == 0 ? !steps.next("lateness at 1 kHz beside a bare sleeper")
                                           : !steps.keepsOn();
    });
    if (measured.cycles == 0 || measured.sleeps == 0) return;
    results.figures.push_back(latenessFigure(options, measured, loop->threads()));
    Quantity ratio = judgedLateness(measured.judged);
    ratio.id = "jitter/lateness-ratio";
    ratio.what =
        "lateness of the loop over that of a bare sleeper, 1 kHz (medians of the seconds' p99)";
    results.quantities.push_back(std::move(ratio));
    addTails(measured, results);
    addMissed(measured, results);
}

void runJitter(const RunOptions& options, Progress& progress, Results& results) {
    Steps steps{progress, static_cast<int>(frequencies().size()) + 11};
    if (measureJitter(options, steps, results)) judgeLateness(options, steps, results);
}

}  // namespace

Measurement jitterMeasurement() {
    return {"jitter", "jitter against the frequency of the loop, lateness at 1 kHz (Fig. 30)",
            "Jitter and lateness (Fig. 30)", jitterSeconds, runJitter};
}

}  // namespace cortex::profiler
