// SPDX-License-Identifier: Apache-2.0
// https://oneapi-spec.uxlfoundation.org/specifications/oneapi/latest/elements/onetbb/source/flow_graph
#include "flow_graph.hpp"

#include <optional>
#include <vector>

#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

namespace cortex::profiler {

namespace flow = oneapi::tbb::flow;
using flow::continue_msg;

struct FlowGraph::Implementation {
    explicit Implementation(int threads)
        : limit{oneapi::tbb::global_control::max_allowed_parallelism,
                static_cast<std::size_t>(threads)},
          arena{threads} {}

    template <class Node>
    void build(const TaskEdges& edges, TaskFunction task) {
        start.emplace(graph.emplace());
        std::vector<Node*> made;
        for (std::uint32_t i = 0; i < edges.count; ++i) {
            auto node = std::make_shared<Node>(
                *graph, [task, i](const continue_msg&) noexcept { task.run(task.context, i); });
            made.push_back(node.get());
            nodes.push_back(std::move(node));
        }
        std::vector<bool> waits(edges.count);
        for (const auto& [before, after] : edges.edges) {
            flow::make_edge(*made[before], *made[after]);
            waits[after] = true;
        }
        for (std::uint32_t i = 0; i < edges.count; ++i) {
            if (!waits[i]) flow::make_edge(*start, *made[i]);
        }
    }

    oneapi::tbb::global_control limit;
    oneapi::tbb::task_arena arena;
    std::optional<flow::graph> graph;  // made in the arena, to which it then belongs
    std::optional<flow::broadcast_node<continue_msg>> start;
    std::vector<std::shared_ptr<void>> nodes;
};

FlowGraph::FlowGraph(const TaskEdges& edges, int threads, TaskFunction task, bool light)
    : implementation_{std::make_unique<Implementation>(threads)} {
    implementation_->arena.execute([&] {
        using Plain = flow::continue_node<continue_msg>;
        using Light = flow::continue_node<continue_msg, flow::lightweight>;
        if (light) {
            implementation_->build<Light>(edges, task);
        } else {
            implementation_->build<Plain>(edges, task);
        }
    });
}

FlowGraph::~FlowGraph() = default;

void FlowGraph::run(const std::function<void()>& inItsArena) {
    implementation_->arena.execute([&] { inItsArena(); });
}

void FlowGraph::cycle() {
    implementation_->start->try_put(continue_msg{});
    implementation_->graph->wait_for_all();
}

std::uint32_t arenaThread() {
    return static_cast<std::uint32_t>(oneapi::tbb::this_task_arena::current_thread_index());
}

}  // namespace cortex::profiler
