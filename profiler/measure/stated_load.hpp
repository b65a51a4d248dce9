// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "measure/measurement.hpp"

#include <cstdint>
#include <string>

namespace cortex::profiler {

// A load that is to be carried without overflow.
struct StatedLoad {
    std::string id;  // of its quantities: "duty/20000"
    std::string what;
    std::int64_t simplexes = 0;
    std::uint32_t commands = 0;  // of each simplex and cycle
};

// The loop with that load, a bare sleeper and threads that work in registers in turn, a second
// each: what the cycles take, what ticks are missed beyond the sleeper's, whether every command was
// executed; what the machine alone does to work of that length. Together 180 s, 15 s with --quick.
void judgeLoad(const StatedLoad& load, const RunOptions& options, Progress& progress,
               Results& results);
double statedLoadSeconds(const RunOptions& options);

}  // namespace cortex::profiler
