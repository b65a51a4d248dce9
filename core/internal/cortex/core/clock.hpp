// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

#include <chrono>
#include <cstdint>

namespace cortex {

inline constexpr std::int64_t nsPerSecond = 1'000'000'000;

// Nanoseconds of the monotonic clock, which is the same for all processes of a host.
inline std::int64_t monotonicNow() CORTEX_REALTIME {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

}  // namespace cortex
