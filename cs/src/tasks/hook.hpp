// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/state.hpp"
#include "cortex/core/structure.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace cortex::cs {

enum class Hook : std::uint8_t {
    None,
    Commands,
    LoopStart,
    Standby,
    StartingUp,
    Active,
    ShuttingDown,
    Fault,
    LoopEnd
};

constexpr const char* name(Hook hook) {
    constexpr std::array names{"no hook",           "a command",       "loopStart",
                               "stateStandby",      "stateStartingUp", "stateActive",
                               "stateShuttingDown", "stateFault",      "loopEnd"};
    return names[static_cast<std::size_t>(hook)];
}

// The function of a state.
constexpr Hook hookOf(State state) {
    return static_cast<Hook>(static_cast<std::uint8_t>(Hook::Standby) +
                             static_cast<std::uint8_t>(state));
}
static_assert(hookOf(State::Standby) == Hook::Standby && hookOf(State::Fault) == Hook::Fault);

// What a loop thread is doing now, for the watchdog.
struct alignas(64) Position {
    std::atomic<std::uint32_t> simplex{noSimplex};
    std::atomic<Hook> hook{Hook::None};

    void setHook(Hook now) { hook.store(now, std::memory_order_relaxed); }
};

}  // namespace cortex::cs
