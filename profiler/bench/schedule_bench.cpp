// SPDX-License-Identifier: Apache-2.0
// The scheduler alone: a cycle of the thread pool over real SimplexCS tasks, and the same tasks in
// a plain loop. The difference is the scheduling overhead of DESIGN's table of numbers.
#include "scheduler.hpp"
#include "subject/subject.hpp"
#include "task_runner.hpp"
#include "thread_pool.hpp"

#include <benchmark/benchmark.h>

namespace cortex::profiler {

namespace {

struct Fixture {
    SimplexTree tree;
    AgentRuntime agent;
    cs::Schedule schedule;
    std::unique_ptr<cs::TaskRunner> runner;

    Fixture(int count, std::uint32_t threads)
        : tree{prepare(count)}, agent{"bench", tree, options(threads)} {
        cs::TaskGraph graph;
        for (const SimplexInfo& info : agent.structure().simplexes) {
            graph.nodes.push_back({info.path, info.layout->type->isA("Active"), 1, 0});
        }
        for (const Edge& edge : agent.structure().edges) {
            graph.edges.emplace_back(edge.target, edge.owner);
        }
        agent.setCanonicalOrder(cs::canonicalOrder(graph));
        schedule = cs::makeSchedule(graph, {.threads = threads, .force = true});
        runner = std::make_unique<cs::TaskRunner>(agent, schedule, 1'000'000);
        agent.start();
    }
    ~Fixture() { agent.stop(); }

    static SimplexTree prepare(int count) {
        SimplexTree tree = emptySimplexes(count, 4);
        tree.add("/bench", "Cluster");
        return tree;
    }
    static AgentOptions options(std::uint32_t threads) {
        AgentOptions result;
        result.loopThreads = threads;
        return result;
    }
};

void perTask(benchmark::State& state, std::int64_t tasks) {
    state.counters["per_task"] =
        benchmark::Counter(static_cast<double>(state.iterations() * tasks),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void poolCycle(benchmark::State& state) {
    Fixture fixture{static_cast<int>(state.range(0)), static_cast<std::uint32_t>(state.range(1))};
    cs::ThreadPool pool{fixture.schedule,
                        [](void* runner, std::uint32_t chunk, std::uint32_t worker) {
                            static_cast<cs::TaskRunner*>(runner)->run(chunk, worker);
                        },
                        fixture.runner.get(),
                        {}};
    Tick tick;
    for (auto _ : state) {
        ++tick.cycle;
        tick.nominalTime += 1'000'000;
        fixture.runner->beginCycle(tick);
        pool.cycle();
    }
    perTask(state, state.range(0));
}

void sameTasksInAPlainLoop(benchmark::State& state) {
    Fixture fixture{static_cast<int>(state.range(0)), 1};
    Tick tick;
    for (auto _ : state) {
        ++tick.cycle;
        tick.nominalTime += 1'000'000;
        fixture.runner->beginCycle(tick);
        for (std::uint32_t i = 0; i < fixture.schedule.chunks.size(); ++i) {
            fixture.runner->run(i, 0);
        }
    }
    perTask(state, state.range(0));
}

BENCHMARK(sameTasksInAPlainLoop)->Arg(1024)->ArgName("simplexes");
BENCHMARK(poolCycle)
    ->Args({1024, 1})
    ->Args({1024, 2})
    ->ArgNames({"simplexes", "threads"})
    ->UseRealTime();

}  // namespace

}  // namespace cortex::profiler
