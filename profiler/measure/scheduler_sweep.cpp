// SPDX-License-Identifier: Apache-2.0
// What it costs to run real tasks in their order, on one thread and on several, beside a plain loop
// over them and a flow graph of oneTBB.
#include "baselines/flow_graph.hpp"
#include "measure/measurements.hpp"
#include "measure/scheduler_bench.hpp"
#include "report/judging.hpp"

#include <algorithm>
#include <array>
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
    TaskTimes times{};
    double best = 0, plain = 0;
    double oneThread = 0;  // of a cluster with one, in turn
    std::string policy{};  // of the peer, the better one
    std::uint32_t used = 1;
};

struct Case {
    Shape shape = Shape::Independent;
    std::uint32_t count = 0, threads = 1;
};

auto inArena(SchedulerBench& bench, FlowGraph& graph) {
    return [&](std::int64_t count) {
        std::chrono::nanoseconds time{};
        graph.run([&] {
            time = timed([&] {
                for (std::int64_t i = 0; i < count; ++i) {
                    bench.beginCycle();
                    graph.cycle();
                }
            });
        });
        return time;
    };
}

Cost measure(const Case& which, const Rounds& rounds) {
    const TaskEdges edges = makeEdges(which.shape, which.count);
    SchedulerBench bench{edges, which.threads};
    const auto threads = static_cast<int>(which.threads);
    FlowGraph heavy{edges, threads, bench.task(), false};
    FlowGraph light{edges, threads, bench.task(), true};
    std::vector<Contender> all{
        {"pool", [&](std::int64_t count) { return bench.cycles(count); }},
        {"plain loop", [&](std::int64_t count) { return bench.plainly(count); }},
        {"flow graph", inArena(bench, heavy)},
        {"lightweight flow graph", inArena(bench, light)}};
    std::unique_ptr<SchedulerBench> alone;
    if (which.threads > 1) {
        alone = std::make_unique<SchedulerBench>(edges, 1);
        all.push_back(
            {"pool, one thread", [&](std::int64_t count) { return alone->cycles(count); }});
    }
    measureInTurn(all, rounds);

    const double count = which.count;
    const Contender& peer = all[2].best() <= all[3].best() ? all[2] : all[3];
    Cost cost{.best = all[0].best() / count,
              .plain = all[1].best() / count,
              .oneThread = (alone ? all.back() : all[0]).best() / count,
              .policy = "oneTBB " + peer.name,
              .used = bench.threadsInUse()};
    cost.times.peer = peer.best() / count;
    for (const double each : all[0].rounds) cost.times.pool.push_back(each / count);
    for (const double each : all[1].rounds) cost.times.plain.push_back(each / count);
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
    Quantity overhead = judgedOverhead(cost.times);
    overhead.id = idOf(which);
    overhead.what = "scheduling a task: " + described(which, cost) +
                    ", cycle less a plain loop over the same tasks, best of 5 rounds";
    overhead.baselineName = cost.policy;
    if (which.count != 1024) overhead.aim = Aim::None;
    results.quantities.push_back(std::move(overhead));
}

void addShared(const Case& which, const Cost& cost, Results& results) {
    const double count = which.count;
    Quantity time{.id = idOf(which),
                  .what = "a cycle of " + described(which, cost) + ", best of 5 rounds",
                  .unit = "us",
                  .value = cost.best * count * 1e-3,
                  .repeats = cost.times.pool,
                  .baseline = cost.times.peer * count * 1e-3,
                  .baselineName = cost.policy};
    for (double& each : time.repeats) each *= count * 1e-3;
    if (which.count == 1024) {
        time.aim = Aim::AtMost;
        time.limit = cost.times.peer * count * 1e-3 / 2;
    }
    results.quantities.push_back(std::move(time));
    results
        .add(idOf(which) + "/against-one",
             "a cycle of " + described(which, cost) +
                 ", beside one thread in turn, best of 5 rounds",
             "ratio", cost.best / cost.oneThread)
        .atMost(1.1);
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
            "Real simplexes in Standby with empty hooks, without items and outputs of their own, "
            "the "
            "same tasks everywhere; cycles one after the "
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
            lines.peer[i].points.push_back({x, cost.times.peer});
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

void measureCluster(Results& results) {
    SubjectCluster subject{simplexesOf(makeEdges(Shape::Chained, 1024)), {}};
    std::vector<Contender> whole{
        {"cluster", [&](std::int64_t count) { return subject.trigger->burst(count); }}};
    measureInTurn(whole, {});
    Quantity task{
        .id = "scheduler/cluster/1024/1",
        .what = "an empty Active task, all of the cluster's cycle included, best of 5 rounds",
        .unit = "ns",
        .value = whole[0].best() / 1024,
        .repeats = whole[0].rounds,
        .aim = Aim::AtMost,
        .limit = 40,
        .paper = "9.5 us a task with one command"};
    for (double& each : task.repeats) each /= 1024;
    results.quantities.push_back(std::move(task));
}

double schedulerSeconds(const RunOptions& options) {
    return (options.quick ? 15.0 : 40.0) * static_cast<double>(threadCounts().size()) / 2;
}

void runScheduler(const RunOptions& options, Progress& progress, Results& results) {
    const Rounds rounds{5, options.quick ? 0.02 : 0.05};
    measureCluster(results);
    double done = 0;
    for (const Shape shape : allShapes) {
        if (!measureShape(shape, rounds, progress, done, results)) return;
        done += 0.25;
    }
    progress.step(1, "scheduler");
}

}  // namespace

Measurement schedulerMeasurement() {
    return {"scheduler", "running tasks in their order, beside oneTBB and a plain loop",
            "Scheduling", schedulerSeconds, runScheduler};
}

}  // namespace cortex::profiler
