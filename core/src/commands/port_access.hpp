// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/loop_thread.hpp"
#include "cortex/core/tables.hpp"

#include <atomic>
#include <cstdint>

namespace cortex {

// What the port of one simplex uses of its agent.
struct PortAccess {
    const Structure& structure;
    Tables& tables;
    const PresentCycle& present;
    LoopThread& loop;                  // the loop's own
    std::atomic<std::uint8_t>& calls;  // of the simplex; the port sets and clears `commandWork`
};

}  // namespace cortex
