// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "threads/canonical_order.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cortex::cs {

// Who starts before whom, as the relationships say: all simplexes in levels. An active simplex
// relies only on levels before its own. Made once, on the program's thread.
struct StartOrder {
    struct Node {
        SimplexCS* active = nullptr;  // null: it has no state, and passes on whom it relies on
        std::vector<std::uint32_t> before;  // nodes that it relies on
    };
    struct Level {
        std::uint32_t first = 0;    // its active simplexes in canonical order, and behind them the
        std::uint32_t passive = 0;  // others that are settled when those are
        std::uint32_t end = 0;
    };
    std::vector<Node> nodes;  // level by level
    std::vector<Level> levels;
};

// `canonical`: all nodes of the graph; `actives`: by node, null where there is none.
StartOrder startOrder(const TaskGraph& graph, std::span<const std::uint32_t> canonical,
                      std::span<SimplexCS* const> actives);

}  // namespace cortex::cs
