// SPDX-License-Identifier: Apache-2.0
// Cost per task of a whole cycle; what it is beside others is the profiler's business.
#include "subject/subject.hpp"

#include <benchmark/benchmark.h>

namespace cortex::profiler {
namespace {

// Runs bursts and reports their own time: of a task, or of what else there are so many of.
void measure(benchmark::State& state, SimplexTree&& tree, std::uint32_t threads,
             std::int64_t parts) {
    constexpr std::int64_t burstCycles = 200;
    cs::ClusterOptions options;
    options.threads = threads;
    SubjectCluster bench{std::move(tree), options};
    for (auto _ : state) {
        const auto time = bench.trigger->burst(burstCycles);
        state.SetIterationTime(std::chrono::duration<double>(time).count());
    }
    const auto all = static_cast<double>(state.iterations() * burstCycles * parts);
    state.counters["each"] = {all, benchmark::Counter::kIsRate | benchmark::Counter::kInvert};
    state.counters["threads"] = bench.cluster.threadsInUse();
}

void emptyTasks(benchmark::State& state) {
    const int count = static_cast<int>(state.range(0)), chain = 4;
    measure(state, emptySimplexes(count, chain), static_cast<std::uint32_t>(state.range(1)), count);
}

// The same number of tasks in one chain, or in chains of 64: a chain is one chunk.
void chainedTasks(benchmark::State& state) {
    constexpr int count = 1024;
    measure(state, emptySimplexes(count, static_cast<int>(state.range(0))), 1, count);
}

// 10 simplexes with many commands each, as the paper's Fig. 27: time per command.
void manyCommands(benchmark::State& state) {
    Partner::commandsPerCycle = static_cast<std::uint32_t>(state.range(0));
    measure(state, partners(10), 1, 10 * state.range(0));
    Partner::commandsPerCycle = 1;
}

BENCHMARK(emptyTasks)->ArgsProduct({{100, 1000, 10000}, {1, 2}})->UseManualTime();
BENCHMARK(chainedTasks)->Arg(64)->Arg(1024)->UseManualTime();
BENCHMARK(manyCommands)->Arg(1)->Arg(10)->Arg(1000)->Arg(2000)->UseManualTime();

}  // namespace
}  // namespace cortex::profiler
