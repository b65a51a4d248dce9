// SPDX-License-Identifier: Apache-2.0
#include "loop/start_order.hpp"

#include <algorithm>
#include <tuple>

namespace cortex::cs {

StartOrder startOrder(const TaskGraph& graph, std::span<const std::uint32_t> canonical,
                      std::span<SimplexCS* const> actives) {
    std::vector<std::vector<std::uint32_t>> before(graph.nodes.size());
    for (const auto& [from, to] : graph.edges) before[to].push_back(from);
    // How many levels have to be settled before the node is.
    std::vector<std::uint32_t> after(graph.nodes.size());
    std::uint32_t count = 1;
    for (const std::uint32_t node : canonical) {
        for (const std::uint32_t each : before[node]) {
            after[node] = std::max(after[node], after[each]);
        }
        if (actives[node] != nullptr) ++after[node];
        count = std::max(count, after[node]);
    }
    const auto levelOf = [&](std::uint32_t node) { return std::max(after[node], 1U) - 1; };

    std::vector<std::uint32_t> rank(graph.nodes.size());
    for (std::uint32_t at = 0; at < canonical.size(); ++at) rank[canonical[at]] = at;
    std::vector<std::uint32_t> order{canonical.begin(), canonical.end()};
    std::ranges::sort(order, {}, [&](std::uint32_t node) {
        return std::tuple{levelOf(node), actives[node] == nullptr, rank[node]};
    });
    std::vector<std::uint32_t> places(graph.nodes.size());
    StartOrder made;
    made.levels.resize(count);
    for (std::uint32_t at = 0; at < order.size(); ++at) {
        const std::uint32_t node = order[at];
        places[node] = at;
        StartOrder::Level& level = made.levels[levelOf(node)];
        if (level.end == 0) level.first = level.passive = at;
        if (actives[node] != nullptr) level.passive = at + 1;
        level.end = at + 1;
        made.nodes.push_back({actives[node], {}});
    }
    for (std::uint32_t at = 0; at < order.size(); ++at) {
        for (const std::uint32_t each : before[order[at]]) {
            made.nodes[at].before.push_back(places[each]);
        }
    }
    return made;
}

}  // namespace cortex::cs
