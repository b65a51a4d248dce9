// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

// Bits of the status and the control word, modes of operation and codes of errors after CiA 402,
// with names. Functions without std::string may be called in a tick; by any thread.
namespace cortex::drives {

// Bits of the status word (6041) that are no state.
struct Ds402Status {
    static constexpr std::uint16_t voltageEnabled = 0x0010;
    static constexpr std::uint16_t warning = 0x0080;
    static constexpr std::uint16_t remote = 0x0200;  // control words are obeyed
    static constexpr std::uint16_t targetReached = 0x0400;
    static constexpr std::uint16_t internalLimit = 0x0800;
    static constexpr std::uint16_t setPointTaken = 0x1000;   // ProfilePosition: acknowledged
    static constexpr std::uint16_t follows = 0x1000;         // cyclic modes: targets are obeyed
    static constexpr std::uint16_t standing = 0x1000;        // ProfileVelocity: speed is 0
    static constexpr std::uint16_t homingAttained = 0x1000;  // Homing
    static constexpr std::uint16_t followingError = 0x2000;  // position modes
    static constexpr std::uint16_t homingError = 0x2000;     // Homing
};

// Bits of the control word (6040) that are no command.
struct Ds402Control {
    static constexpr std::uint16_t newSetPoint = 0x0010;  // ProfilePosition: rising edge
    static constexpr std::uint16_t startHoming = 0x0010;  // Homing: rising edge; 0 interrupts
    static constexpr std::uint16_t atOnce = 0x0020;      // ProfilePosition: do not wait for the end
    static constexpr std::uint16_t relative = 0x0040;    // ProfilePosition
    static constexpr std::uint16_t faultReset = 0x0080;  // rising edge
    static constexpr std::uint16_t halt = 0x0100;
};

// What bits 13, 12 and 10 say in mode Homing.
enum class Ds402Homing : std::uint8_t {
    Runs,
    NotStarted,  // or interrupted; the axis stands
    AttainedButMoving,
    Done,
    ErrorMoving,
    Error  // and the axis stands
};

constexpr Ds402Homing homingOf(std::uint16_t statusWord) noexcept {
    const bool stands = (statusWord & Ds402Status::targetReached) != 0;
    if (statusWord & Ds402Status::homingError)
        return stands ? Ds402Homing::Error : Ds402Homing::ErrorMoving;
    if (statusWord & Ds402Status::homingAttained)
        return stands ? Ds402Homing::Done : Ds402Homing::AttainedButMoving;
    return stands ? Ds402Homing::NotStarted : Ds402Homing::Runs;
}

// Modes of operation (6060, 6061). The numbers are those of the item modeDisplay.
enum class Ds402Mode : std::int8_t {
    None = 0,
    ProfilePosition = 1,
    Velocity = 2,
    ProfileVelocity = 3,
    ProfileTorque = 4,
    Homing = 6,
    Interpolated = 7,
    CyclicPosition = 8,
    CyclicVelocity = 9,
    CyclicTorque = 10
};

struct Ds402ModeRow {
    Ds402Mode mode;
    bool built;  // CorteX' processor and drive model know it
    std::string_view name;
    std::string_view letters;
};

inline constexpr std::array<Ds402ModeRow, 9> ds402Modes{{
    {Ds402Mode::ProfilePosition, true, "profile position", "PP"},
    {Ds402Mode::Velocity, false, "velocity", "VL"},
    {Ds402Mode::ProfileVelocity, true, "profile velocity", "PV"},
    {Ds402Mode::ProfileTorque, false, "profile torque", "PT"},
    {Ds402Mode::Homing, true, "homing", "HM"},
    {Ds402Mode::Interpolated, false, "interpolated position", "IP"},
    {Ds402Mode::CyclicPosition, true, "cyclic synchronous position", "CSP"},
    {Ds402Mode::CyclicVelocity, true, "cyclic synchronous velocity", "CSV"},
    {Ds402Mode::CyclicTorque, true, "cyclic synchronous torque", "CST"},
}};

// Null for 0 and for numbers that are no mode of CiA 402. Makers' own modes are negative.
constexpr const Ds402ModeRow* modeRow(int mode) noexcept {
    for (const Ds402ModeRow& row : ds402Modes)
        if (static_cast<int>(row.mode) == mode) return &row;
    return nullptr;
}

constexpr bool isBuilt(int mode) noexcept {
    const Ds402ModeRow* row = modeRow(mode);
    return row && row->built;
}

// The bit of a mode in the object "supported drive modes" (6502); 0 where it has none.
constexpr std::uint32_t supportedBit(int mode) noexcept {
    return modeRow(mode) ? std::uint32_t{1} << (mode - 1) : 0;
}

inline constexpr std::uint32_t ds402BuiltModes = [] {
    std::uint32_t bits = 0;
    for (const Ds402ModeRow& row : ds402Modes)
        if (row.built) bits |= supportedBit(static_cast<int>(row.mode));
    return bits;
}();

// "cyclic synchronous position (CSP)", "none", "mode -3". Not in a tick.
std::string modeName(int mode);

// Why a drive with these supported modes (6502) cannot be set to a mode, as a sentence that names
// the modes that it can; empty where it can. Not in a tick.
std::string whyNotMode(int mode, std::uint32_t supported = ds402BuiltModes);

struct Ds402ErrorRow {
    std::uint16_t code;
    std::string_view name;
};

// Codes (603F) that the drive model reports and the processor names.
inline constexpr std::array<Ds402ErrorRow, 8> ds402Errors{{
    {0x2310, "over-current"},
    {0x3210, "link voltage too high"},
    {0x3220, "link voltage too low"},
    {0x4310, "drive too hot"},
    {0x7305, "encoder"},
    {0x7500, "communication lost"},
    {0x8611, "following error"},
    {0x8612, "reference limit"},
}};

// "following error (0x8611)", "error of the maker (0xFF01)", "error 0x1234", "no error". Not in a
// tick.
std::string errorName(int code);

}  // namespace cortex::drives
