// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/structure.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace cortex {

// What an edge orders, first to second: an input before its owner, an owner before its output.
// Delayed edges and those to remote simplexes order nothing; see orders().
bool orders(const Structure& structure, const Edge& edge);
std::pair<std::uint32_t, std::uint32_t> orderOf(const Edge& edge);

// Loops of the order, each as the edges (indexes) along it, beginning at the first of its simplexes
// by path. At least one for every group of simplexes that wait for each other; at most `most`.
using Loop = std::vector<std::uint32_t>;
std::vector<Loop> findLoops(const Structure& structure, std::size_t most = 100);

}  // namespace cortex
