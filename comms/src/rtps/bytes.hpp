// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

// How RTPS 2.3 (OMG formal/2019-04-03, 9.4) writes numbers: in the byte order that a flag of each
// submessage states. Every function takes bytes that are there; who calls has looked.
namespace cortex::comms::rtps {

using Bytes = std::span<std::uint8_t>;

inline std::uint16_t readU16(Bytes at, bool little) {
    return static_cast<std::uint16_t>(little ? at[0] | at[1] << 8 : at[0] << 8 | at[1]);
}

inline std::uint32_t readU32(Bytes at, bool little) {
    const std::uint32_t first = readU16(at, little);
    const std::uint32_t second = readU16(at.subspan(2), little);
    return little ? first | second << 16 : first << 16 | second;
}

// A sequence number: its upper half, then its lower half.
inline std::int64_t readNumber(Bytes at, bool little) {
    const std::uint64_t upper = readU32(at, little);
    return static_cast<std::int64_t>(upper << 32 | readU32(at.subspan(4), little));
}

inline void writeU32(Bytes at, bool little, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) {
        at[little ? i : 3 - i] = static_cast<std::uint8_t>(value >> (8 * i));
    }
}

inline void writeNumber(Bytes at, bool little, std::int64_t value) {
    const auto bits = static_cast<std::uint64_t>(value);
    writeU32(at, little, static_cast<std::uint32_t>(bits >> 32));
    writeU32(at.subspan(4), little, static_cast<std::uint32_t>(bits));
}

}  // namespace cortex::comms::rtps
