// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "threads/canonical_order.hpp"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace cortex::cs {

using Index = std::uint32_t;

// Lists of indices, one per owner, in one flat array.
struct Lists {
    std::vector<Index> first;  // owners + 1
    std::vector<Index> items;

    std::span<const Index> of(Index owner) const {
        return {items.data() + first[owner], items.data() + first[owner + 1]};
    }
};

// The values 0..n-1 grouped by their owner; each group ascends.
inline Lists groupBy(std::span<const Index> ownerOf, std::size_t owners) {
    Lists lists{std::vector<Index>(owners + 1), std::vector<Index>(ownerOf.size())};
    for (const Index owner : ownerOf) ++lists.first[owner + 1];
    std::partial_sum(lists.first.begin(), lists.first.end(), lists.first.begin());
    std::vector<Index> next(lists.first.begin(), lists.first.end() - 1);
    for (Index value = 0; value < ownerOf.size(); ++value) {
        lists.items[next[ownerOf[value]]++] = value;
    }
    return lists;
}

// For each node the other ends of its edges: by `from` the successors, by `to` the predecessors.
inline Lists neighbours(const TaskGraph& graph, bool successors) {
    std::vector<Index> owners;
    owners.reserve(graph.edges.size());
    for (const auto& [before, after] : graph.edges) {
        assert(before < graph.nodes.size() && after < graph.nodes.size());
        owners.push_back(successors ? before : after);
    }
    Lists lists = groupBy(owners, graph.nodes.size());
    for (Index& item : lists.items) {
        const auto& [before, after] = graph.edges[item];
        item = successors ? after : before;
    }
    return lists;
}

}  // namespace cortex::cs
