// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace cortex::modbus {

// A register has 16 bits, big-endian on the wire. A number of 32 bits takes two, and makers differ
// in which comes first; as the item `wordOrder` says it.
enum class WordOrder : std::int64_t { HighWordFirst, LowWordFirst };

// Two registers as one number.
constexpr std::uint32_t joined(std::span<const std::uint16_t, 2> words, WordOrder order) {
    const bool highFirst = order == WordOrder::HighWordFirst;
    const std::uint32_t high = words[highFirst ? 0 : 1], low = words[highFirst ? 1 : 0];
    return high << 16U | low;
}

// One number as two registers. A signed one is cast to its two's complement, a float by bit_cast.
constexpr void split(std::uint32_t number, WordOrder order, std::span<std::uint16_t, 2> words) {
    const bool highFirst = order == WordOrder::HighWordFirst;
    words[highFirst ? 0 : 1] = static_cast<std::uint16_t>(number >> 16U);
    words[highFirst ? 1 : 0] = static_cast<std::uint16_t>(number & 0xFFFFU);
}

}  // namespace cortex::modbus
