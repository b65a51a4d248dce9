// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace cortex::cs {

/// What runs before what. Nodes are all simplexes, descriptive ones (without a task) included:
/// they carry order from their writers to their readers.
struct TaskGraph {
    struct Node {
        std::string path;
        bool hasTask = false;
        std::uint32_t every = 1;  // runs in every n-th cycle; here it only weighs the cost
        std::uint32_t phase = 0;
    };
    std::vector<Node> nodes;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  // (before, after)
};

/// The graph has a loop that no delayed relationship opens; what() prints all of it by path.
class LoopError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A run of tasks that one thread executes without interruption once its predecessors are done.
struct Chunk {
    std::uint32_t first = 0;             // into Schedule::tasks
    std::uint32_t count = 0;             // 0: a mere join, it only waits for its predecessors
    std::uint32_t firstPredecessor = 0;  // into Schedule::predecessors
    std::uint32_t predecessorCount = 0;
    float place = 0;  // in its level, from 0 to below 1 by cost: how threads share the level
};

/// The thread that runs the chunk unless another one helps it.
inline std::uint32_t homeOf(const Chunk& chunk, std::uint32_t threads) {
    const auto home = static_cast<std::uint32_t>(chunk.place * static_cast<float>(threads));
    return std::min(home, threads - 1);
}

/// The execution order, computed once at start() and never changed. Chunks stand in topological
/// order: each names only earlier ones as predecessors.
struct Schedule {
    std::vector<std::uint32_t> order;  // canonical, all nodes
    std::vector<std::uint32_t> tasks;  // execution order, the nodes that have a task
    std::vector<Chunk> chunks;
    std::vector<std::uint32_t> predecessors;
    std::uint32_t threads = 1;
};

inline constexpr double AssumedTaskMicroseconds = 0.05;  // of a task whose cost is not known
inline constexpr double WakeMicroseconds = 20.0;  // what a sleeping worker costs before it helps

struct ScheduleOptions {
    std::uint32_t threads = 1;                   // at most
    std::uint32_t chunkSize = 0;                 // tasks in a chunk; 0: by cost
    std::span<const double> costMicroseconds{};  // one per node, 0: unknown; empty: all are
    bool force = false;                          // use all threads even where one is faster
};

/// Topological, ties by path. Throws LoopError.
std::vector<std::uint32_t> canonicalOrder(const TaskGraph& graph);

/// Linear in nodes and edges (but for sorting the paths). Throws LoopError.
Schedule makeSchedule(const TaskGraph& graph, const ScheduleOptions& options);

}  // namespace cortex::cs
