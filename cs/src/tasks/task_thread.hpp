// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"

#include <cstdint>

namespace cortex::cs {

// The task that took longest, of those that were timed.
struct LongestTask {
    std::uint32_t simplex = noSimplex;
    std::int64_t time = 0;  // ns
};

// What a loop thread keeps for the task that it runs: what a hook says holds until that task ends.
struct alignas(64) TaskThread {
    LoopThread* loop = nullptr;
    std::uint64_t limits = 0, conflicts = 0, startups = 0;  // counted since the start
    std::int64_t measuredAt = 0;                            // setQuality()
    std::int64_t faultCode = 0;                             // fault()
    std::int64_t nextDeadline = 0;                          // of the loop, 0: not known
    std::int64_t stoodUntil = 0;  // end of the last standstill, ns of the monotonic clock; 0: none
    LongestTask longest;          // of this cycle
    EventText text;               // of the fault, or why a command was refused
    EventText brief;              // of the fault, for the item faultText
};

}  // namespace cortex::cs
