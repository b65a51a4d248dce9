// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "wire/messages.hpp"

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

// Who was not heard for so long is lost. `crowd`: how many we hear, whose every presence may delay
// the next; who joined before them has not said yet that he will take longer.
inline std::int64_t patienceWith(const Presence& presence, std::uint32_t crowd = 0) {
    const std::int64_t said = std::clamp(presence.interval, shortestInterval, longestInterval);
    return std::max(4 * std::max(said, intervalAmong(crowd)), shortestPatience);
}

}  // namespace cortex::comms
