// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace cortex {

// "speed=0.5, mode=2" as far as it fits: the record of a command from outside. `set` has presence
// flags in front of its items.
void describeRecord(const CommandTable& table, std::uint32_t command, const std::byte* record,
                    EventText& text) CORTEX_REALTIME;

// Records are multiples of 8 octets, mostly one.
inline void copyRecord(std::byte* to, const std::byte* from, std::uint32_t size) {
    if (size == 8) {
        std::memcpy(to, from, 8);
        return;
    }
    for (std::uint32_t i = 0; i < size; i += 8) std::memcpy(to + i, from + i, 8);
}

}  // namespace cortex
