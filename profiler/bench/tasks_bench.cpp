// SPDX-License-Identifier: Apache-2.0
// Cost per task of a whole cycle, beside oneTBB's flow graph and a plain loop over the same work.
#include "subject/subject.hpp"

#include <memory>
#include <vector>

#include <malloc.h>

#include <benchmark/benchmark.h>
#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

namespace cortex::profiler {

namespace {

constexpr int chainLength = 4;
constexpr std::int64_t burstCycles = 200;

cs::ClusterOptions withThreads(std::int64_t threads) {
    cs::ClusterOptions options;
    options.threads = static_cast<std::uint32_t>(threads);
    return options;
}

void report(benchmark::State& state, std::int64_t tasks) {
    state.counters["per_task"] =
        benchmark::Counter(static_cast<double>(state.iterations() * burstCycles * tasks),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

// Runs bursts and reports their own time.
void measure(benchmark::State& state, SubjectCluster& bench, std::int64_t tasks) {
    for (auto _ : state) {
        const auto time = bench.trigger->burst(burstCycles);
        state.SetIterationTime(std::chrono::duration<double>(time).count());
    }
    report(state, tasks);
    state.counters["threads"] = bench.cluster.threadsInUse();
}

void emptyTasks(benchmark::State& state) {
    SubjectCluster bench{emptySimplexes(static_cast<int>(state.range(0)), chainLength),
                         withThreads(state.range(1))};
    measure(state, bench, state.range(0));
}

void tasksWithACommand(benchmark::State& state) {
    Partner::commandsPerCycle = 1;
    SubjectCluster bench{partners(static_cast<int>(state.range(0))), withThreads(state.range(1))};
    measure(state, bench, state.range(0));
}

// 10 simplexes with many commands each, as the paper's Fig. 27: time per command.
void manyCommands(benchmark::State& state) {
    Partner::commandsPerCycle = static_cast<std::uint32_t>(state.range(0));
    SubjectCluster bench{partners(10), withThreads(1)};
    measure(state, bench, 10 * state.range(0));
    Partner::commandsPerCycle = 1;
}

// What a task of the flow graph and of the plain loop does: the three calls of an empty task.
struct Hooks {
    virtual ~Hooks() = default;
    virtual void loopStart(std::int64_t) {}
    virtual void state(std::int64_t) {}
    virtual void loopEnd(std::int64_t) {}
    void run(std::int64_t cycle) {
        loopStart(cycle);
        state(cycle);
        loopEnd(cycle);
    }
};
struct EmptyHooks final : Hooks {
    std::int64_t count = 0;
    void loopStart(std::int64_t cycle) override { benchmark::DoNotOptimize(count += cycle); }
};

std::vector<std::unique_ptr<Hooks>> makeHooks(std::int64_t count) {
    std::vector<std::unique_ptr<Hooks>> hooks;
    for (std::int64_t i = 0; i < count; ++i) hooks.push_back(std::make_unique<EmptyHooks>());
    return hooks;
}

void tbbFlowGraph(benchmark::State& state) {
    namespace flow = oneapi::tbb::flow;
    const auto threads = static_cast<std::size_t>(state.range(1));
    const oneapi::tbb::global_control limit{oneapi::tbb::global_control::max_allowed_parallelism,
                                            threads};
    oneapi::tbb::task_arena arena{static_cast<int>(threads)};
    const auto hooks = makeHooks(state.range(0));
    std::int64_t cycle = 0;
    arena.execute([&] {
        flow::graph graph;
        flow::broadcast_node<flow::continue_msg> start{graph};
        std::vector<std::unique_ptr<flow::continue_node<flow::continue_msg>>> nodes;
        for (std::size_t i = 0; i < hooks.size(); ++i) {
            Hooks* work = hooks[i].get();
            nodes.push_back(std::make_unique<flow::continue_node<flow::continue_msg>>(
                graph, [work, &cycle](const flow::continue_msg&) { work->run(cycle); }));
            if (i % chainLength == 0)
                flow::make_edge(start, *nodes.back());
            else
                flow::make_edge(*nodes[i - 1], *nodes.back());
        }
        for (auto _ : state) {
            for (std::int64_t i = 0; i < burstCycles; ++i) {
                ++cycle;
                start.try_put(flow::continue_msg{});
                graph.wait_for_all();
            }
        }
    });
    report(state, state.range(0));
}

void plainLoop(benchmark::State& state) {
    const auto hooks = makeHooks(state.range(0));
    std::int64_t cycle = 0;
    for (auto _ : state) {
        for (std::int64_t i = 0; i < burstCycles; ++i) {
            ++cycle;
            for (const auto& work : hooks) work->run(cycle);
        }
    }
    report(state, state.range(0));
}

// With all indexes and one image slot; the other slots of the pool are counted out.
void bytesPerEmptySimplex(benchmark::State& state) {
    const int few = 1000;
    const int many = 11000;
    const auto used = [] {
        const struct mallinfo2 info = mallinfo2();
        return static_cast<double>(info.uordblks + info.hblkhd);
    };
    double bytes = 0;
    for (auto _ : state) {
        cs::ClusterOptions options;
        options.imageReaders = 1;
        const double before = used();
        auto small = std::make_unique<SubjectCluster>(emptySimplexes(few, chainLength), options);
        const double between = used();
        auto large = std::make_unique<SubjectCluster>(emptySimplexes(many, chainLength), options);
        const double after = used();
        const auto arena = [](SubjectCluster& bench) {
            return static_cast<double>(bench.cluster.agent().tables().arena().size());
        };
        const double otherSlots = 2 * (arena(*large) - arena(*small));
        bytes = ((after - between) - (between - before) - otherSlots) / (many - few);
    }
    state.counters["bytes"] = bytes;
}

void sizes(benchmark::internal::Benchmark* benchmark) {
    for (const std::int64_t count : {100, 1000, 10000}) {
        for (const std::int64_t threads : {1, 2}) benchmark->Args({count, threads});
    }
    benchmark->ArgNames({"simplexes", "threads"});
}

BENCHMARK(plainLoop)->Arg(100)->Arg(1000)->Arg(10000)->ArgName("simplexes");
BENCHMARK(emptyTasks)->Apply(sizes)->UseManualTime();
BENCHMARK(tbbFlowGraph)->Apply(sizes)->UseRealTime();
BENCHMARK(tasksWithACommand)->Apply(sizes)->UseManualTime();
BENCHMARK(manyCommands)->Arg(10)->Arg(1000)->Arg(2000)->ArgName("commands")->UseManualTime();
BENCHMARK(bytesPerEmptySimplex)->Iterations(1);

}  // namespace

}  // namespace cortex::profiler
