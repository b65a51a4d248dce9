// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/drives/ds402_parameters.hpp"

#include "modbus_words.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

// The registers of a CiA 402 drive with one or two axes behind Modbus/TCP: what both sides of the
// wire know of them. As a table for people: docs/ds402-simulator.md. Functions may be called by any
// thread, allocate nothing and throw nothing.
namespace cortex::modbus {

struct Ds402Map {
    static constexpr std::uint16_t layout = 2;  // version of all that stands here
    static constexpr std::size_t axes = 2;
    // Process image, for one FC 23.
    static constexpr std::uint16_t write = 0x0000, writeStep = 0x10, heartbeat = 0x20;
    static constexpr std::uint16_t read = 0x0100, readStep = 0x18, echo = 0x130;
    static constexpr std::size_t writeCount = 34, readCount = 52;
    // Parameters: two registers each.
    static constexpr std::uint16_t parameters = 0x1000, parametersStep = 0x100;
    static constexpr std::uint16_t watchdog = 0x2000;  // ms, 0: off
    static constexpr std::uint16_t trips = 0x2001;     // of the watchdog; only read
    static constexpr std::uint16_t shortestWatchdog = 10, longestWatchdog = 5000;  // ms
    static constexpr std::uint16_t identity = 0x3000;
    static constexpr std::size_t identityCount = 14;
};

// What a master writes for one axis.
struct Ds402AxisTold {
    std::uint16_t controlWord = 0;
    std::int8_t mode = 0;
    std::int32_t position = 0;        // counts
    std::int32_t velocity = 0;        // counts per s
    std::int16_t effort = 0;          // per mille of the rated effort
    std::int16_t effortOffset = 0;    // the same
    std::int32_t velocityOffset = 0;  // counts per s
    std::uint16_t outputs = 0;

    bool operator==(const Ds402AxisTold&) const = default;
};

struct Ds402Told {
    std::array<Ds402AxisTold, Ds402Map::axes> axes;
    std::uint16_t heartbeat = 0;  // another number in each exchange

    bool operator==(const Ds402Told&) const = default;
};

// What a master reads of one axis.
struct Ds402AxisSeen {
    std::uint16_t statusWord = 0;
    std::int8_t mode = 0;
    std::int32_t position = 0;  // counts
    std::int32_t velocity = 0;  // counts per s
    std::int16_t effort = 0;    // per mille of the rated effort
    std::uint16_t errorCode = 0;
    std::int32_t followingError = 0;  // counts
    std::uint32_t inputs = 0;
    std::int32_t demand = 0;       // counts: where the drive leads its servo to
    std::int16_t temperature = 0;  // 0.1 Cel
    std::uint8_t lastTransition = 0;
    std::uint8_t refused = 0;       // words that were no transition, modulo 256
    std::uint16_t flags = 0;        // bit 0: homed
    std::uint16_t transitions = 0;  // modulo 65536

    static constexpr std::uint16_t homed = 1;

    bool operator==(const Ds402AxisSeen&) const = default;
};

struct Ds402Seen {
    std::array<Ds402AxisSeen, Ds402Map::axes> axes;
    std::uint16_t heartbeat = 0;  // as it was told last
    std::uint32_t time = 0;       // us of the drive's own clock, modulo 2^32
    std::uint16_t layout = Ds402Map::layout;

    bool operator==(const Ds402Seen&) const = default;
};

using Ds402TellImage = std::array<std::uint16_t, Ds402Map::writeCount>;
using Ds402SeeImage = std::array<std::uint16_t, Ds402Map::readCount>;

Ds402TellImage encode(const Ds402Told& told, WordOrder order) noexcept;
Ds402SeeImage encode(const Ds402Seen& seen, WordOrder order) noexcept;
// Any contents mean something; what is to be 0 is not looked at.
Ds402Told decode(const Ds402TellImage& image, WordOrder order) noexcept;
Ds402Seen decode(const Ds402SeeImage& image, WordOrder order) noexcept;

// The parameters of one axis, in the order of their registers.
struct Ds402ParameterRow {
    enum class Scale : std::uint8_t { Whole, Counts, Thousandths };
    using Member =
        std::variant<std::int32_t drives::Ds402Parameters::*,
                     std::uint32_t drives::Ds402Parameters::*, double drives::Ds402Parameters::*>;

    std::uint16_t object;
    std::uint8_t sub;
    Scale scale;   // of the register: counts (per s, per s2), or thousandths of a unit
    bool isFixed;  // it can be read only
    Member member;
    std::string_view name;
};

inline constexpr std::size_t ds402ParameterCount = 22;
const std::array<Ds402ParameterRow, ds402ParameterCount>& ds402ParameterRows() noexcept;
using Ds402ParameterImage = std::array<std::int32_t, ds402ParameterCount>;

// Beyond 32 bits: the greatest or the least number that they hold.
Ds402ParameterImage encode(const drives::Ds402Parameters& parameters) noexcept;
// What the image leaves as it is keeps its bits. Fixed ones are taken from `before`.
drives::Ds402Parameters decode(const Ds402ParameterImage& image,
                               const drives::Ds402Parameters& before) noexcept;

// The first that 32 bits do not hold; null: all are held.
const Ds402ParameterRow* firstBeyond(const drives::Ds402Parameters& parameters) noexcept;
// "homing method"; empty for what is none of them.
std::string_view parameterName(std::uint16_t object) noexcept;

// Who answers.
struct Ds402Identity {
    std::array<char, 4> name{'C', 'X', '0', '2'};  // the last two: layout
    std::uint16_t axes = 1;
    std::array<double, Ds402Map::axes> countsPerUnit{};
    std::uint32_t serial = 0;

    std::string_view text() const { return {name.data(), name.size()}; }
    bool operator==(const Ds402Identity&) const = default;
};
using Ds402IdentityImage = std::array<std::uint16_t, Ds402Map::identityCount>;
Ds402IdentityImage encode(const Ds402Identity& identity, WordOrder order) noexcept;
Ds402Identity decode(const Ds402IdentityImage& image, WordOrder order) noexcept;

}  // namespace cortex::modbus
