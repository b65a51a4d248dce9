// SPDX-License-Identifier: Apache-2.0
// Ten minutes of an agent on the network with changing load: does it allocate in its loop, or grow?
#include "measure/endurance.hpp"

#include "measure/comms_domain.hpp"
#include "measure/endurance_role.hpp"
#include "measure/scheduler_bench.hpp"
#include "observers/client.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

namespace cortex::profiler {
namespace {

using observers::Clients;
using observers::Load;

double lengthOf(const RunOptions& options) { return options.quick ? 20 : 600; }
double settledAfter(const RunOptions& options) { return options.quick ? 5 : 60; }

// Samples of one run; times from when both clients were there.
struct Run {
    std::vector<EnduranceSample> samples;
    std::uint64_t images = 0, commands = 0;
};

Run observe(const RunOptions& options, Progress& progress) {
    const Domain domain = measurementDomain();
    const std::uint32_t threads =
        options.threads != 0 ? options.threads : std::min(4U, usableCpus());
    EnduranceRole role{domain.number, threads, options.frequency, options.priority};
    Child subject{wordsOf(role)};
    subject.line();
    const auto begin = std::chrono::steady_clock::now();
    Clients clients;
    clients.start(0, Load::View30, domain.number);
    clients.start(1, Load::CommandOften, domain.number);
    clients.waitUntilReady();
    const std::chrono::duration<double> joined = std::chrono::steady_clock::now() - begin;
    Run run;
    for (;;) {
        EnduranceSample now = enduranceFrom(subject);
        now.time -= joined.count();
        if (now.time < 0) continue;
        run.samples.push_back(now);
        if (now.time >= lengthOf(options)) break;
        if (!progress.step(now.time / lengthOf(options), "the agent runs")) break;
    }
    const std::vector<std::uint64_t> counts = clients.stop();
    run.images = counts[0];
    run.commands = counts[1];
    return run;
}

using Field = double EnduranceSample::*;

// Mean of the last tenth less mean of the first after it had settled.
double growth(const std::vector<EnduranceSample>& settled, Field field) {
    const std::size_t part = std::max<std::size_t>(1, settled.size() / 10);
    double change = 0;
    for (std::size_t i = 0; i < part; ++i) {
        change += settled[settled.size() - 1 - i].*field - settled[i].*field;
    }
    return change / static_cast<double>(part);
}

double range(const std::vector<EnduranceSample>& settled, Field field) {
    const auto [least, most] = std::ranges::minmax_element(settled, {}, field);
    return (*most).*field - (*least).*field;
}

Figure figureOf(const Run& run, const Domain& domain) {
    Figure figure{.id = "endurance",
                  .title = "An agent over time",
                  .paper = "Fig. 18 and section 7: no allocation over two minutes",
                  .setup =
                      "1,000 items, ten tasks whose work changes all the time, one tool that "
                      "sees everything at 30 Hz and one that sends 50 commands a second, " +
                      domain.text() + ".",
                  .x = {"time", "s", false},
                  .y = {"memory of the process", "kB", false},
                  .series = {},
                  .marks = {}};
    const std::pair<const char*, Field> lines[]{{"resident", &EnduranceSample::resident},
                                                {"Pss", &EnduranceSample::proportional},
                                                {"private, written to", &EnduranceSample::dirty},
                                                {"allocated", &EnduranceSample::allocated}};
    for (const auto& [name, field] : lines) {
        Series series{name, {}, false};
        for (const EnduranceSample& each : run.samples) {
            series.points.push_back({each.time, each.*field * 1e-3});
        }
        figure.series.push_back(std::move(series));
    }
    return figure;
}

Quantity limited(const char* id, const char* what, const char* unit, double value, double limit) {
    return {
        .id = id, .what = what, .unit = unit, .value = value, .aim = Aim::AtMost, .limit = limit};
}

void addQuantities(const Run& run, double settledAfter, Results& results) {
    std::vector<EnduranceSample> settled = run.samples;
    std::erase_if(settled, [=](const EnduranceSample& each) { return each.time < settledAfter; });
    const EnduranceSample& last = run.samples.back();
    auto& all = results.quantities;
    all.push_back(limited("endurance/allocations", "allocator calls of the loop's threads", "calls",
                          last.loopAllocations, 0));
    all.back().paper = "0 over two minutes";
    if (settled.size() > 1) {
        all.push_back(limited("endurance/growth", "growth of private memory once it has settled",
                              "kB", growth(settled, &EnduranceSample::dirty) * 1e-3, 256));
        all.push_back({.id = "endurance/allocated",
                       .what = "growth of what is allocated once it has settled",
                       .unit = "kB",
                       .value = growth(settled, &EnduranceSample::allocated) * 1e-3});
        all.push_back(limited("endurance/handles", "range of open handles once it has settled",
                              "handles", range(settled, &EnduranceSample::handles), 0));
        all.push_back(limited("endurance/threads", "range of threads once it has settled",
                              "threads", range(settled, &EnduranceSample::threads), 0));
        all.push_back(limited("endurance/tables", "range of the size of its tables", "octets",
                              range(settled, &EnduranceSample::tables), 0));
    }
    const double time = std::max(1.0, last.time - run.samples.front().time);
    const auto rate = [&](const char* id, const char* what, double count) {
        all.push_back(
            {.id = id, .what = what, .unit = "1/s", .value = count / time, .lessIsBetter = false});
    };
    rate("endurance/cycles", "cycles meanwhile", last.cycles - run.samples.front().cycles);
    rate("endurance/images", "images that the tool saw", static_cast<double>(run.images));
    rate("endurance/commands", "commands that were done", static_cast<double>(run.commands));
}

double seconds(const RunOptions& options) { return lengthOf(options) + 5; }

void run(const RunOptions& options, Progress& progress, Results& results) {
    const Run run = observe(options, progress);
    if (run.samples.empty()) return;
    results.figures.push_back(figureOf(run, measurementDomain()));
    addQuantities(run, settledAfter(options), results);
}

}  // namespace

const Measurement& enduranceMeasurement() {
    static constexpr Measurement measurement{
        "endurance", "an agent on the network for ten minutes: allocations, memory, handles",
        seconds, run};
    return measurement;
}

}  // namespace cortex::profiler
