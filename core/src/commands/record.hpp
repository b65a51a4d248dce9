// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"

#include <cstddef>

namespace cortex {

// "speed=0.5, mode=2" as far as it fits: the record of a command from outside. `set` has presence
// flags in front of its items.
void describeRecord(const CommandTable& table, std::uint32_t command, const std::byte* record,
                    EventText& text) CORTEX_REALTIME;

}  // namespace cortex
