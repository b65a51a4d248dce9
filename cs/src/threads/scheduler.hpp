// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "threads/canonical_order.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace cortex::cs {

// A run of tasks that one thread executes without interruption once its predecessors are done.
struct Chunk {
    std::uint32_t first = 0;             // into Schedule::tasks
    std::uint32_t count = 0;             // 0: a mere join, it only waits for its predecessors
    std::uint32_t firstPredecessor = 0;  // into Schedule::predecessors
    std::uint32_t predecessorCount = 0;
    float place = 0;  // in its level, from 0 to below 1 by cost: how threads share the level
};

// The thread that runs the chunk unless another one helps it.
inline std::uint32_t homeOf(const Chunk& chunk, std::uint32_t threads) {
    const auto home = static_cast<std::uint32_t>(chunk.place * static_cast<float>(threads));
    return std::min(home, threads - 1);
}

// The execution order, computed once at start() and never changed. Chunks stand in topological
// order: each names only earlier ones as predecessors.
struct Schedule {
    std::vector<std::uint32_t> order;  // canonical, all nodes
    std::vector<std::uint32_t> tasks;  // execution order, the nodes that have a task
    std::vector<Chunk> chunks;
    std::vector<std::uint32_t> predecessors;
    std::uint32_t threads = 1;
};

inline constexpr double assumedTaskMicroseconds = 0.05;  // where no cost is known yet
inline constexpr double leastTaskMicroseconds = 0.01;    // of a task, also of one not measured
inline constexpr double wakeMicroseconds = 20.0;  // what a sleeping worker costs before it helps

struct ScheduleOptions {
    std::uint32_t threads = 1;    // at most
    std::uint32_t chunkSize = 0;  // tasks in a chunk; 0: by cost
    // Measured, one per node, 0: not yet. Empty: none is, and then one thread runs all.
    std::span<const double> costMicroseconds{};
    bool force = false;  // use all threads even where one is faster
};

// Linear in nodes and edges (but for sorting the paths). Throws LoopError.
Schedule makeSchedule(const TaskGraph& graph, const ScheduleOptions& options);

}  // namespace cortex::cs
