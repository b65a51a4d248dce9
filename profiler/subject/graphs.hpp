// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/simplex_tree.hpp"

#include "subject.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cortex::profiler {

enum class Shape { Independent, Chained, Layered, Random };
inline constexpr Shape allShapes[]{Shape::Independent, Shape::Chained, Shape::Layered,
                                   Shape::Random};
const char* name(Shape shape);

// What runs before what: pairs (before, after) of tasks 0 to count - 1. Each runs after some of
// smaller number only, so that the numbers are a topological order.
struct TaskEdges {
    std::uint32_t count = 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
};

// Chains of 4; 16 layers, each task after 2 of the layer before; or each after up to 3 earlier ones
// at random, the same in every run.
TaskEdges makeEdges(Shape shape, std::uint32_t count);

// The simplexes of these tasks, with empty hooks.
std::string taskPath(std::uint32_t task);  // by path they stand in the order of their numbers
SimplexTree simplexesOf(const TaskEdges& edges);

}  // namespace cortex::profiler
