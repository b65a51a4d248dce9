// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "wire/messages.hpp"

#include <charconv>
#include <cstdint>
#include <string_view>

// What an agent adds to its presence, as decimal numbers.
namespace cortex::comms {

inline constexpr const char* agentsHeard = "agents";    // itself included
inline constexpr const char* eventsWritten = "events";  // the number of the last one
inline constexpr const char* uptimeOfAgent = "uptime";  // on the network, in ns

// 0: the presence does not say so.
inline std::uint64_t numberIn(const Presence& presence, std::string_view name) {
    std::uint64_t number = 0;
    for (const Extra& extra : presence.extras) {
        if (extra.name != name) continue;
        std::from_chars(extra.value.data(), extra.value.data() + extra.value.size(), number);
    }
    return number;
}

}  // namespace cortex::comms
