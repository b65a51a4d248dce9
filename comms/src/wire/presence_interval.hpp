// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "wire/messages.hpp"

#include <algorithm>
#include <cstdint>

namespace cortex::comms {

// How often a participant sends its presence, and how long it counts as present. All times are in
// ns.

inline constexpr std::int64_t shortestInterval = 100'000'000;
inline constexpr std::int64_t longestInterval = 5'000'000'000;
inline constexpr std::int64_t shortestPatience = 1'000'000'000;

// The interval of a participant with so many listeners: each of up to 250 hears at most 50
// presences a second.
constexpr std::int64_t intervalAmong(std::uint32_t listeners) {
    return std::clamp(std::int64_t{listeners} * 20'000'000, shortestInterval, longestInterval);
}

// A participant that is silent for so long is lost. `crowd` is the number of participants that we
// hear: their presences may delay the next one, and one that joined before them has not yet
// announced a longer interval.
inline std::int64_t patienceWith(const Presence& presence, std::uint32_t crowd = 0) {
    const std::int64_t said = std::clamp(presence.interval, shortestInterval, longestInterval);
    return std::max(4 * std::max(said, intervalAmong(crowd)), shortestPatience);
}

// After so long a silence DDS forgets a participant, and learns of it anew. Presences tell earlier
// that it is lost. So a process that stood still, or was cut off, is found again at once.
inline constexpr std::int64_t leaseOfParticipant = 60'000'000'000;

// What is heard within this time after a start was there before.
inline constexpr std::int64_t timeToMeet = 2'000'000'000;

// While another start of its name is heard, a participant that is silent for so long has ended and
// left its name to that start.
inline std::int64_t patienceWithRival(const Presence& presence) {
    return std::min(3 * std::clamp(presence.interval, shortestInterval, longestInterval),
                    patienceWith(presence));
}

// Without security anybody may say that somebody ends. So a participant that is said to end is gone
// when it says nothing more for so long.
inline std::int64_t patienceAfterGoodbye(const Presence& presence) {
    return std::clamp(presence.interval, shortestInterval, longestInterval) + 200'000'000;
}

}  // namespace cortex::comms
