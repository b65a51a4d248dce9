// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/simplex_tree.hpp"

#include <cstdint>
#include <span>

namespace cortex::profiler {

// What cortex-hot-paths counts: a cluster, and how many commands it is to execute in each cycle.
struct Scenario {
    const char* name;
    SimplexTree (*make)();
    std::int64_t commands;
};

std::span<const Scenario> scenarios();

}  // namespace cortex::profiler
