// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"

#include <cstddef>
#include <map>
#include <string>

namespace cortex {

// The records of commands from outside. `set` has presence flags in front of its items.

// "speed=0.5, mode=2" as far as it fits.
void describeRecord(const CommandTable& table, std::uint32_t command, const std::byte* record,
                    EventText& text) CORTEX_REALTIME;

// Off the loop: throws Error for unknown parameters and values of the wrong kind or length.
// Parameters that are not given have their defaults.
void encodeRecord(const CommandTable& table, std::uint32_t command,
                  const std::map<std::string, Value>& arguments, std::byte* record);
std::map<std::string, Value> decodeRecord(const RecordLayout& layout, const std::byte* record);

}  // namespace cortex
