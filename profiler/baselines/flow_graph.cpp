// SPDX-License-Identifier: Apache-2.0
// https://oneapi-spec.uxlfoundation.org/specifications/oneapi/latest/elements/onetbb/source/flow_graph
#include "flow_graph.hpp"

#include <optional>
#include <vector>

#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

namespace cortex::profiler {

using namespace oneapi::tbb::flow;
struct FlowGraph::Implementation {
    template <class Node>
    void build(const TaskEdges& edges, TaskFunction task) {
        start.emplace(graph.emplace());
        std::vector<bool> first(edges.count, true);
        std::vector<std::shared_ptr<Node>> made;
        for (std::uint32_t i = 0; i < edges.count; ++i)
            made.push_back(std::make_shared<Node>(
                *graph, [task, i](const continue_msg&) noexcept { task.run(task.context, i); }));
        for (const auto& [before, after] : edges.edges) {
            make_edge(*made[before], *made[after]);
            first[after] = false;
        }
        for (std::uint32_t i = 0; i < edges.count; ++i)
            if (first[i]) make_edge(*start, *made[i]);
        nodes.assign(made.begin(), made.end());
    }
    int threads;
    oneapi::tbb::global_control limit{oneapi::tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(threads)};
    oneapi::tbb::task_arena arena{threads};
    std::optional<oneapi::tbb::flow::graph> graph{};  // of the arena in which it is made
    std::optional<broadcast_node<continue_msg>> start{};
    std::vector<std::shared_ptr<void>> nodes{};
};

FlowGraph::FlowGraph(const TaskEdges& edges, int threads, TaskFunction task, bool light)
    : implementation_{new Implementation{threads}} {
    implementation_->arena.execute([&] {
        if (light) implementation_->build<continue_node<continue_msg, lightweight>>(edges, task);
        if (!light) implementation_->build<continue_node<continue_msg>>(edges, task);
    });
}

FlowGraph::~FlowGraph() = default;

void FlowGraph::run(const std::function<void()>& inItsArena) {
    implementation_->arena.execute(inItsArena);
}

void FlowGraph::cycle() {
    implementation_->start->try_put(continue_msg{});
    implementation_->graph->wait_for_all();
}

}  // namespace cortex::profiler
