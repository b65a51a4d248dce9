// SPDX-License-Identifier: Apache-2.0
// Cost per task of a whole cycle; what it is beside others is the profiler's business.
#include "subject/subject.hpp"

#include <benchmark/benchmark.h>

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

void sizes(benchmark::internal::Benchmark* benchmark) {
    for (const std::int64_t count : {100, 1000, 10000}) {
        for (const std::int64_t threads : {1, 2}) benchmark->Args({count, threads});
    }
    benchmark->ArgNames({"simplexes", "threads"});
}

BENCHMARK(emptyTasks)->Apply(sizes)->UseManualTime();
BENCHMARK(tasksWithACommand)->Apply(sizes)->UseManualTime();
BENCHMARK(manyCommands)->Arg(10)->Arg(1000)->Arg(2000)->ArgName("commands")->UseManualTime();

}  // namespace

}  // namespace cortex::profiler
