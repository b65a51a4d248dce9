// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

#include "modbus_words.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cortex::modbus {

// What a number is in the registers; as the item `registerFormat` says it.
enum class RegisterFormat : std::int64_t { Signed16, Unsigned16, Signed32, Unsigned32, Float32 };

constexpr std::size_t wordsOf(RegisterFormat format) {
    return format == RegisterFormat::Signed16 || format == RegisterFormat::Unsigned16 ? 1 : 2;
}

// The counts in the first registers of `words`.
double countsIn(std::span<const std::uint16_t> words, RegisterFormat format, WordOrder order)
    CORTEX_REALTIME;
// Writes the counts nearest to `counts`, which is finite, and returns what was written.
double putCounts(double counts, RegisterFormat format, WordOrder order,
                 std::span<std::uint16_t> words) CORTEX_REALTIME;
// Whether the registers hold it, but for rounding to whole counts.
bool holds(double counts, RegisterFormat format) CORTEX_REALTIME;

// Numbers in registers one behind the other, as an AnalogueIoGroup describes them: each is
// offset + scale * counts.
struct ScaledRegisters {
    int at = -1;
    RegisterFormat format = RegisterFormat::Signed16;
    WordOrder order = WordOrder::HighWordFirst;
    std::vector<double> scale{}, offset{};

    std::size_t count() const { return scale.size(); }
    std::size_t words() const { return count() * wordsOf(format); }

    // `all`: the registers of all places.
    double read(std::size_t place, std::span<const std::uint16_t> all) const CORTEX_REALTIME;
    // Returns the nearest number that the register holds, which was written.
    double write(std::size_t place, double value, std::span<std::uint16_t> all) const
        CORTEX_REALTIME;
    bool holds(std::size_t place, double value) const CORTEX_REALTIME;
};

}  // namespace cortex::modbus
