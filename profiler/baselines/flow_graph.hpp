// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "baselines/plain_loop.hpp"
#include "subject/graphs.hpp"

#include <cstdint>
#include <functional>
#include <memory>

namespace cortex::profiler {

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
