// SPDX-License-Identifier: Apache-2.0
#include "threads/canonical_order.hpp"

#include "threads/index_lists.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>

namespace cortex::cs {
namespace {

// Every blocked node has a blocked predecessor, so walking back from any of them ends in a loop.
std::vector<Index> findLoop(const Lists& predecessors, const std::vector<bool>& blocked) {
    const auto start = std::find(blocked.begin(), blocked.end(), true);
    std::vector<Index> walk;
    std::vector<bool> visited(blocked.size());
    Index node = static_cast<Index>(start - blocked.begin());
    while (!visited[node]) {
        visited[node] = true;
        walk.push_back(node);
        const auto before = predecessors.of(node);
        node = *std::find_if(before.begin(), before.end(), [&](Index i) { return blocked[i]; });
    }
    walk.erase(walk.begin(), std::find(walk.begin(), walk.end(), node));
    std::reverse(walk.begin(), walk.end());
    return walk;
}

[[noreturn]] void throwLoop(const TaskGraph& graph, const std::vector<bool>& blocked) {
    std::vector<Index> loop = findLoop(neighbours(graph, false), blocked);
    const auto byPath = [&](Index a, Index b) { return graph.nodes[a].path < graph.nodes[b].path; };
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end(), byPath), loop.end());
    std::string text = "The order of execution has a loop: ";
    for (const Index node : loop) text += graph.nodes[node].path + " -> ";
    text += graph.nodes[loop.front()].path;
    text += ". Each runs before the next; mark one relationship of the loop delayed=\"true\", ";
    text += "and its reader takes the value of the cycle before.";
    throw LoopError(text);
}

}  // namespace

std::vector<std::uint32_t> canonicalOrder(const TaskGraph& graph) {
    const std::size_t count = graph.nodes.size();
    std::vector<Index> byPath(count), rank(count), waitsFor(count), order;
    std::iota(byPath.begin(), byPath.end(), 0U);
    std::sort(byPath.begin(), byPath.end(),
              [&](Index a, Index b) { return graph.nodes[a].path < graph.nodes[b].path; });
    for (Index i = 0; i < count; ++i) rank[byPath[i]] = i;
    const Lists successors = neighbours(graph, true);
    for (const Index after : successors.items) ++waitsFor[after];

    std::priority_queue<Index, std::vector<Index>, std::greater<>> ready;  // ranks
    for (Index node = 0; node < count; ++node) {
        if (waitsFor[node] == 0) ready.push(rank[node]);
    }
    order.reserve(count);
    while (!ready.empty()) {
        const Index node = byPath[ready.top()];
        ready.pop();
        order.push_back(node);
        for (const Index after : successors.of(node)) {
            if (--waitsFor[after] == 0) ready.push(rank[after]);
        }
    }
    if (order.size() == count) return order;
    std::vector<bool> blocked(count);
    for (Index node = 0; node < count; ++node) blocked[node] = waitsFor[node] != 0;
    throwLoop(graph, blocked);
}

}  // namespace cortex::cs
