// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>

namespace cortex {

// A record is the request or the response of one command as bytes: its parameters at the offsets of
// the type's RecordLayout. The request of `set` begins with one byte for each settable item, which
// is 1 if the item is given. The functions with values run off the loop. The record is aligned to 8
// bytes and as large as its layout. Throws Error for unknown parameters and values of the wrong
// kind or length; parameters that are not given have their defaults.
void encodeRecord(const CommandTable& table, std::uint32_t command,
                  const std::map<std::string, Value>& arguments, std::byte* record);
// Which of those without a default are not given, in words; "" if none.
std::string missingArguments(const CommandTable::Entry& entry,
                             const std::map<std::string, Value>& arguments);
std::map<std::string, Value> decodeRecord(const RecordLayout& layout, const std::byte* record);
// The other way round for a response, of what fits; the rest of the record stays as it is.
void encodeResponse(const RecordLayout& layout, const std::map<std::string, Value>& values,
                    std::byte* record);
// Of `set` only the items that are given.
std::map<std::string, Value> argumentsOf(const CommandTable& table, std::uint32_t command,
                                         const std::byte* request);

// "speed=0.5, mode=2" as far as it fits: the record of a command from outside. `set` has presence
// flags in front of its items.
void describeRecord(const CommandTable& table, std::uint32_t command, const std::byte* record,
                    EventText& text) CORTEX_REALTIME;

// A record is a multiple of 8 bytes, usually just 8.
inline void copyRecord(std::byte* to, const std::byte* from, std::uint32_t size) {
    if (size == 8) {
        std::memcpy(to, from, 8);
        return;
    }
    for (std::uint32_t i = 0; i < size; i += 8) std::memcpy(to + i, from + i, 8);
}

}  // namespace cortex
