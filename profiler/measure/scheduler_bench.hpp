// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"

#include "baselines/flow_graph.hpp"
#include "baselines/in_turn.hpp"
#include "subject/graphs.hpp"
#include "tasks/task_runner.hpp"
#include "threads/scheduler.hpp"
#include "threads/thread_pool.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

namespace cortex::profiler {

// The schedule of real SimplexCS tasks as a cluster would have it, without the rest of a cluster:
// cycles of its thread pool, or the same tasks for others to run.
class SchedulerBench {
public:
    // So many threads are asked for; how many are used is up to the library.
    SchedulerBench(const TaskEdges& edges, std::uint32_t threads);
    ~SchedulerBench();
    SchedulerBench(const SchedulerBench&) = delete;
    SchedulerBench& operator=(const SchedulerBench&) = delete;

    std::chrono::nanoseconds cycles(std::int64_t count);
    // No scheduling at all: the limit.
    std::chrono::nanoseconds plainly(std::int64_t count);
    std::uint32_t threadsInUse() const { return pool_->threads(); }

    // The same tasks one by one, for others to run them in the same order, on threads of a flow
    // graph too. Without what the pool's run of tasks adds: it reads the clock once.
    TaskFunction task();
    void beginCycle();

private:
    double microsecondsOfTask();

    SimplexTree tree_;
    AgentRuntime agent_;
    cs::Schedule schedule_;
    std::unique_ptr<cs::TaskRunner> runner_;
    std::unique_ptr<cs::ThreadPool> pool_;
    std::vector<std::uint32_t> slots_;  // by task
    Tick tick_;
};

std::uint32_t usableCpus();

}  // namespace cortex::profiler
