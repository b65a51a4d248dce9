// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

#include <atomic>
#include <concepts>
#include <cstdint>

namespace cortex {

// Where an end of a lane is, modulo 2^32; that end alone moves it.
using LanePosition = std::atomic<std::uint32_t>;

// Where an end was at the start of a cycle: the position, and above it that cycle modulo 2^32. An
// end that rested for just as many cycles is seen where it was before it moved last, never beyond.
using LaneStart = std::atomic<std::uint64_t>;

template <std::integral T>
constexpr std::uint32_t lowHalf(T number) CORTEX_REALTIME {
    return static_cast<std::uint32_t>(number);
}

inline std::uint32_t now(const LanePosition& position) CORTEX_REALTIME {
    return position.load(std::memory_order_acquire);
}

inline void advance(LanePosition& position) CORTEX_REALTIME {
    position.store(position.load(std::memory_order_relaxed) + 1U, std::memory_order_release);
}

inline std::int32_t distance(std::uint32_t from, std::uint32_t to) CORTEX_REALTIME {
    return static_cast<std::int32_t>(to - from);
}

inline bool isOf(std::int64_t cycle, std::uint64_t start) CORTEX_REALTIME {
    return lowHalf(start >> 32U) == lowHalf(cycle);
}

// By the end itself, before it moves in a cycle; again does no harm.
inline void noteStart(std::int64_t cycle, const LanePosition& position, LaneStart& start)
    CORTEX_REALTIME {
    if (isOf(cycle, start.load(std::memory_order_relaxed))) return;
    start.store(std::uint64_t{lowHalf(cycle)} << 32U | now(position), std::memory_order_relaxed);
}

// By the other end of a delayed lane: where it was at the start of the cycle. If a position has
// moved in this cycle, its start was noted before.
inline std::uint32_t seenDelayed(std::int64_t cycle, const LanePosition& position,
                                 const LaneStart& start) CORTEX_REALTIME {
    const std::uint32_t at = now(position);
    const std::uint64_t noted = start.load(std::memory_order_relaxed);
    return isOf(cycle, noted) ? lowHalf(noted) : at;
}

}  // namespace cortex
