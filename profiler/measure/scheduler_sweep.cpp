// SPDX-License-Identifier: Apache-2.0
// What it costs to run real tasks in their order, on one thread and on several, beside a plain loop
// over them and a flow graph of oneTBB.
#include "measure/scheduler_sweep.hpp"

#include "baselines/flow_graph.hpp"
#include "measure/measurement.hpp"
#include "measure/scheduler_bench.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace cortex::profiler {
namespace {

constexpr std::array<std::uint32_t, 3> counts{64, 1024, 16384};

std::vector<std::uint32_t> threadCounts() {
    std::vector<std::uint32_t> threads{1, 2, 4, 8, 16};
    std::erase_if(threads, [](std::uint32_t each) { return each > 1 && each > usableCpus(); });
    return threads;
}

// One graph on so many threads: ns of one task of a cycle.
struct Cost {
    std::vector<double> pool{}, overPlain{};  // by round
    double best = 0, plain = 0, peer = 0, peerPlain = 0;
    double oneThread = 0;  // of a cluster with one, in turn
    std::string policy{};  // of the peer, the better one
    std::uint32_t used = 1;
};

struct Case {
    Shape shape = Shape::Independent;
    std::uint32_t count = 0, threads = 1;
    double work = 0;  // ns
};

template <class Peer>
auto cyclesOf(SchedulerBench& bench, Peer& peer) {
    return [&bench, &peer](std::int64_t count) {
        return timed([&] {
            for (std::int64_t i = 0; i < count; ++i) {
                bench.beginCycle();
                peer.cycle();
            }
        });
    };
}

auto inArena(SchedulerBench& bench, FlowGraph& graph) {
    return [&graph, run = cyclesOf(bench, graph)](std::int64_t count) {
        std::chrono::nanoseconds time{};
        graph.run([&] { time = run(count); });
        return time;
    };
}

Cost measure(const Case& which, const Rounds& rounds) {
    const TaskEdges edges = makeEdges(which.shape, which.count);
    SchedulerBench bench{edges, which.threads, which.work};
    PlainLoop loop{which.count, bench.task()};
    const auto threads = static_cast<int>(which.threads);
    FlowGraph heavy{edges, threads, bench.task(), false};
    FlowGraph light{edges, threads, bench.task(), true};
    std::vector<Contender> all{
        {"pool", [&](std::int64_t count) { return bench.cycles(count); }},
        {"chunks in a plain loop", [&](std::int64_t count) { return bench.plainly(count); }},
        {"plain loop", cyclesOf(bench, loop)},
        {"flow graph", inArena(bench, heavy)},
        {"lightweight flow graph", inArena(bench, light)}};
    std::unique_ptr<SchedulerBench> alone;
    if (which.threads > 1) {
        alone = std::make_unique<SchedulerBench>(edges, 1, which.work);
        all.push_back(
            {"pool, one thread", [&](std::int64_t count) { return alone->cycles(count); }});
    }
    measureInTurn(all, rounds);

    const double count = which.count;
    const Contender& peer = all[3].best() <= all[4].best() ? all[3] : all[4];
    Cost cost{.best = all[0].best() / count,
              .plain = all[1].best() / count,
              .peer = peer.best() / count,
              .peerPlain = all[2].best() / count,
              .oneThread = (alone ? all.back() : all[0]).best() / count,
              .policy = "oneTBB " + peer.name,
              .used = bench.threadsInUse()};
    for (const double each : all[0].rounds) {
        cost.pool.push_back(each / count);
        cost.overPlain.push_back(each / count - cost.plain);
    }
    return cost;
}

std::string idOf(const Case& which) {
    return std::string{"scheduler/"} + name(which.shape) + "/" + std::to_string(which.count) + "/" +
           std::to_string(which.threads);
}

std::string described(const Case& which, const Cost& cost) {
    return std::to_string(which.count) + " " + name(which.shape) + " tasks, " +
           std::to_string(which.threads) + (which.threads == 1 ? " thread" : " threads asked for") +
           (which.threads == 1 ? "" : ", " + std::to_string(cost.used) + " used");
}

void addOverhead(const Case& which, const Cost& cost, Results& results) {
    const double peer = cost.peer - cost.peerPlain;
    Quantity overhead{.id = idOf(which),
                      .what = "scheduling a task: " + described(which, cost) +
                              ", cycle less a plain loop over the same tasks",
                      .unit = "ns",
                      .value = cost.best - cost.plain,
                      .repeats = cost.overPlain,
                      .baseline = peer,
                      .baselineName = cost.policy};
    if (which.count == 1024) {
        overhead.aim = Aim::AtMost;
        overhead.limit = std::min(5.0, peer / 10);
    }
    results.quantities.push_back(std::move(overhead));
}

void addShared(const Case& which, const Cost& cost, Results& results) {
    const double count = which.count;
    Quantity time{.id = idOf(which),
                  .what = "a cycle of " + described(which, cost),
                  .unit = "us",
                  .value = cost.best * count * 1e-3,
                  .repeats = cost.pool,
                  .baseline = cost.peer * count * 1e-3,
                  .baselineName = cost.policy};
    for (double& each : time.repeats) each *= count * 1e-3;
    if (which.count == 1024) {
        time.aim = Aim::AtMost;
        time.limit = cost.peer * count * 1e-3 / 2;
    }
    results.quantities.push_back(std::move(time));
    results.quantities.push_back({.id = idOf(which) + "/against-one",
                                  .what = "a cycle of " + described(which, cost) +
                                          ", beside one thread in turn, 1.1 being noise",
                                  .unit = "ratio",
                                  .value = cost.best / cost.oneThread,
                                  .aim = Aim::AtMost,
                                  .limit = 1.1});
}

struct Lines {
    std::vector<Series> pool, peer;  // by number of threads
    Series plain{.name = "plain loop over the same tasks", .points = {}, .baseline = true};
};

Figure figureOf(Shape shape, Lines lines) {
    Figure figure{
        .id = std::string{"scheduler-"} + name(shape),
        .title = std::string{"Scheduler: a cycle of "} + name(shape) + " tasks",
        .paper = "",
        .setup =
            "Real simplexes with empty hooks, the same tasks everywhere; cycles one after the "
            "other, best millisecond of five rounds in turn; of the flow graph the better of "
            "its policies.",
        .x = {"tasks", "", true},
        .y = {"time of a cycle per task", "ns", true},
        .series = {},
        .marks = {}};
    for (Series& each : lines.pool) figure.series.push_back(std::move(each));
    figure.series.push_back(std::move(lines.plain));
    for (Series& each : lines.peer) figure.series.push_back(std::move(each));
    return figure;
}

bool measureShape(Shape shape, const Rounds& rounds, Progress& progress, double done,
                  Results& results) {
    const auto threads = threadCounts();
    Lines lines;
    for (const std::uint32_t each : threads) {
        const std::string on =
            ", " + std::to_string(each) + (each == 1 ? " thread" : " threads asked for");
        lines.pool.push_back({"CorteX" + on, {}, false});
        lines.peer.push_back({"oneTBB flow graph" + on, {}, true});
    }
    for (const std::uint32_t count : counts) {
        for (std::size_t i = 0; i < threads.size(); ++i) {
            const Case which{shape, count, threads[i]};
            if (!progress.step(done, idOf(which))) return false;
            const Cost cost = measure(which, rounds);
            const double x = count;
            lines.pool[i].points.push_back({x, cost.best});
            lines.peer[i].points.push_back({x, cost.peer});
            if (threads[i] == 1) {
                lines.plain.points.push_back({x, cost.plain});
                addOverhead(which, cost, results);
            } else {
                addShared(which, cost, results);
            }
        }
    }
    results.figures.push_back(figureOf(shape, std::move(lines)));
    return true;
}

// Threads asleep before each cycle, as at 1 kHz.
bool measureWoken(const RunOptions& options, Progress& progress, Results& results) {
    for (const std::uint32_t count : {1024U, 16384U}) {
        for (const std::uint32_t threads : threadCounts()) {
            const Case which{Shape::Layered, count, threads};
            if (!progress.step(0.8, idOf(which) + "/woken")) return false;
            const Cost cost = measure(which, {5, options.quick ? 0.03 : 0.1, 300});
            const double scale = count * 1e-3;
            results.quantities.push_back(
                {.id = idOf(which) + "/woken",
                 .what = "a cycle of " + described(which, cost) + ", 0.3 ms of sleep before each",
                 .unit = "us",
                 .value = cost.best * scale,
                 .repeats = cost.pool,
                 .baseline = cost.peer * scale,
                 .baselineName = cost.policy});
            for (double& each : results.quantities.back().repeats) each *= scale;
        }
    }
    return true;
}

bool measureSpeedUp(const Rounds& rounds, Progress& progress, Results& results) {
    Figure figure{
        .id = "scheduler-speed-up",
        .title = "Scheduler: 16,384 tasks with 200 ns of work each",
        .paper = "",
        .setup = "Beside the same on one thread; best millisecond of five rounds in turn.",
        .x = {"threads asked for", "", false},
        .y = {"speed-up", "", false},
        .series = {},
        .marks = {}};
    for (const Shape shape : {Shape::Independent, Shape::Layered}) {
        Series pool{name(shape), {}, false};
        Series peer{std::string{"oneTBB flow graph, "} + name(shape), {}, true};
        for (const std::uint32_t threads : threadCounts()) {
            const Case which{shape, 16384, threads, 200};
            if (!progress.step(0.85, idOf(which) + "/work")) return false;
            const Cost cost = measure(which, rounds);
            pool.points.push_back({static_cast<double>(threads), cost.oneThread / cost.best});
            peer.points.push_back({static_cast<double>(threads), cost.oneThread / cost.peer});
            Quantity speed{.id = idOf(which) + "/speed-up",
                           .what = "speed-up of tasks of 200 ns: " + described(which, cost),
                           .unit = "times",
                           .value = cost.oneThread / cost.best,
                           .baseline = cost.oneThread / cost.peer,
                           .baselineName = cost.policy,
                           .lessIsBetter = false};
            if (threads == 16) {
                speed.aim = Aim::AtLeast;
                speed.limit = 11;
            }
            if (threads > 1) results.quantities.push_back(std::move(speed));
        }
        figure.series.push_back(std::move(pool));
        figure.series.push_back(std::move(peer));
    }
    results.figures.push_back(std::move(figure));
    return true;
}

void measureCluster(Results& results) {
    SubjectCluster subject{simplexesOf(makeEdges(Shape::Chained, 1024)), {}};
    std::vector<Contender> whole{
        {"cluster", [&](std::int64_t count) { return subject.trigger->burst(count); }}};
    measureInTurn(whole, {});
    Quantity task{.id = "scheduler/cluster/1024/1",
                  .what = "an empty task, all of the cluster's cycle included",
                  .unit = "ns",
                  .value = whole[0].best() / 1024,
                  .repeats = whole[0].rounds,
                  .aim = Aim::AtMost,
                  .limit = 40,
                  .paper = "9.5 us a task with one command"};
    for (double& each : task.repeats) each /= 1024;
    results.quantities.push_back(std::move(task));
}

double seconds(const RunOptions& options) {
    return (options.quick ? 20.0 : 80.0) * static_cast<double>(threadCounts().size()) / 2;
}

void run(const RunOptions& options, Progress& progress, Results& results) {
    const Rounds rounds{5, options.quick ? 0.02 : 0.05, 0};
    measureCluster(results);
    double done = 0;
    for (const Shape shape : allShapes) {
        if (!measureShape(shape, rounds, progress, done, results)) return;
        done += 0.18;
    }
    if (!measureWoken(options, progress, results)) return;
    if (!measureSpeedUp(rounds, progress, results)) return;
    progress.step(1, "scheduler");
}

}  // namespace

const Measurement& schedulerMeasurement() {
    static constexpr Measurement measurement{
        "scheduler", "running tasks in their order, beside oneTBB and a plain loop", seconds, run};
    return measurement;
}

}  // namespace cortex::profiler
