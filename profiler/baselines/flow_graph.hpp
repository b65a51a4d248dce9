// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "subject/graphs.hpp"

#include <cstdint>
#include <functional>
#include <memory>

namespace cortex::profiler {

// What is done for a task, by whatever runs them.
struct TaskFunction {
    void (*run)(void* context, std::uint32_t task);
    void* context;
};

// The peer: the same tasks in a flow graph of oneTBB that is built once. Light: nodes with the
// policy `lightweight`, which run within the thread that triggers them.
class FlowGraph {
public:
    FlowGraph(const TaskEdges& edges, int threads, TaskFunction task, bool light);
    ~FlowGraph();
    FlowGraph(const FlowGraph&) = delete;
    FlowGraph& operator=(const FlowGraph&) = delete;

    void cycle();  // called from within run()
    void run(const std::function<void()>& inItsArena);

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace cortex::profiler
