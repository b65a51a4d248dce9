// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event.hpp"
#include "cortex/core/mailbox.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace cortex {

// Of one loop thread: where a task posts events, when its chunk started, and what it counted.
struct alignas(64) LoopThread {
    EventRing* events = nullptr;
    ChunkClock clock;
    std::int64_t nominalTime = 0;  // of the present cycle, ns
    std::uint32_t sequence = 0;    // of events in this cycle; beginCycle() starts it anew
    std::uint64_t commands = 0;    // executed, since start
    std::uint64_t rejected = 0;
    std::int64_t lastLatency = 0;              // ns, of the last executed command
    std::vector<std::uint64_t> latencyCounts;  // histogram, ns, see latencyBucket()
};
inline constexpr std::uint32_t latencyBuckets = 16 * 36;
inline std::uint32_t latencyBucket(std::int64_t nanoseconds) CORTEX_REALTIME {  // 16 per octave
    if (nanoseconds < 16) return nanoseconds < 0 ? 0U : static_cast<std::uint32_t>(nanoseconds);
    const auto value = static_cast<std::uint64_t>(nanoseconds);
    const auto octave = static_cast<std::uint32_t>(std::bit_width(value)) - 5U;
    const auto step = static_cast<std::uint32_t>(value >> octave) & 15U;
    return std::min((octave + 1U) * 16U + step, latencyBuckets - 1U);
}
double latencyOfBucket(std::uint32_t bucket);  // us, upper edge

// What every part of an agent needs to post an event of the present cycle.
struct PresentCycle {
    std::int64_t cycle = 0, nominalTime = 0;
    std::int64_t clock = 0;  // monotonicNow() that belongs to nominalTime
    bool over = false;       // its events are handed out, and what comes belongs to the next
    std::vector<std::uint32_t> ranks;  // of the simplexes in canonical order

    void post(LoopThread& thread, Severity severity, EventKind kind, std::uint32_t simplex,
              const EventText& text) const CORTEX_REALTIME;
};

// The bit of a simplex's calls that says that its port has work; the others are life-cycle
// commands.
inline constexpr std::uint8_t commandWork = 1U << 7U;

}  // namespace cortex
