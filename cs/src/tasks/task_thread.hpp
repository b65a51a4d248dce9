// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"

#include <cstdint>

namespace cortex::cs {

// What a loop thread keeps for the task that it runs: what a hook says holds until that task ends.
struct alignas(64) TaskThread {
    LoopThread* loop = nullptr;
    std::uint64_t limits = 0, conflicts = 0, startups = 0;  // counted since the start
    std::int64_t measuredAt = 0;                            // setQuality()
    std::int64_t faultCode = 0;                             // fault()
    EventText text;  // of the fault, or why a command was refused
};

}  // namespace cortex::cs
