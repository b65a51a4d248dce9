// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "messages.hpp"

#include <algorithm>
#include <cstdint>

namespace cortex::comms {

// How often a participant says that it is there; how long it is believed to be. All in ns.

inline constexpr std::int64_t shortestInterval = 100'000'000;
inline constexpr std::int64_t longestInterval = 5'000'000'000;
inline constexpr std::int64_t shortestPatience = 1'000'000'000;

// Of who is heard by so many: up to 250 of them, each hears at most 50 a second.
constexpr std::int64_t intervalAmong(std::uint32_t listeners) {
    return std::clamp(std::int64_t{listeners} * 20'000'000, shortestInterval, longestInterval);
}

// Who was not heard for so long is lost.
inline std::int64_t patienceWith(const Presence& presence) {
    return std::max(4 * std::clamp(presence.interval, shortestInterval, longestInterval),
                    shortestPatience);
}

}  // namespace cortex::comms
