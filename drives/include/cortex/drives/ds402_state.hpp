// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

// The state machine of drives after CiA 402 (IEC 61800-7-201): states, words, transitions, as
// tables. Functions without std::string may be called in a tick; those that write sentences may
// not. All may be called by any thread and throw nothing but for lack of memory.
namespace cortex::drives {

// The numbers are those of the item driveState.
enum class Ds402State : std::uint8_t {
    Unknown,  // a status word that fits no state
    NotReadyToSwitchOn,
    SwitchOnDisabled,
    ReadyToSwitchOn,
    SwitchedOn,
    OperationEnabled,
    QuickStopActive,
    FaultReactionActive,
    Fault
};

struct Ds402StateRow {
    Ds402State state;
    std::uint16_t mask;   // of the status word
    std::uint16_t value;  // what is left of the word behind the mask
    bool power;           // the power stage is on
    bool torque;          // the motor has torque and the brake is released
    std::string_view name;
};

inline constexpr std::array<Ds402StateRow, 8> ds402States{{
    {Ds402State::NotReadyToSwitchOn, 0x004F, 0x0000, false, false, "Not ready to switch on"},
    {Ds402State::SwitchOnDisabled, 0x004F, 0x0040, false, false, "Switch on disabled"},
    {Ds402State::ReadyToSwitchOn, 0x006F, 0x0021, false, false, "Ready to switch on"},
    {Ds402State::SwitchedOn, 0x006F, 0x0023, true, false, "Switched on"},
    {Ds402State::OperationEnabled, 0x006F, 0x0027, true, true, "Operation enabled"},
    {Ds402State::QuickStopActive, 0x006F, 0x0007, true, true, "Quick stop active"},
    {Ds402State::FaultReactionActive, 0x004F, 0x000F, true, true, "Fault reaction active"},
    {Ds402State::Fault, 0x004F, 0x0008, false, false, "Fault"},
}};

// The state that a status word tells. Only bits 0 to 3, 5 and 6 take part.
constexpr Ds402State stateOf(std::uint16_t statusWord) noexcept {
    for (const Ds402StateRow& row : ds402States)
        if ((statusWord & row.mask) == row.value) return row.state;
    return Ds402State::Unknown;
}

// Null for Unknown.
constexpr const Ds402StateRow* rowOf(Ds402State state) noexcept {
    for (const Ds402StateRow& row : ds402States)
        if (row.state == state) return &row;
    return nullptr;
}

constexpr std::string_view nameOf(Ds402State state) noexcept {
    const Ds402StateRow* row = rowOf(state);
    return row ? row->name : "Unknown";
}

// What a control word asks for.
enum class Ds402Command : std::uint8_t {
    None,
    Shutdown,
    SwitchOn,  // in Operation enabled: disable operation
    EnableOperation,
    DisableVoltage,
    QuickStop,
    FaultReset  // the rising edge of bit 7
};

struct Ds402CommandRow {
    Ds402Command command;
    std::uint16_t mask;   // of the control word
    std::uint16_t value;  // what is left of the word behind the mask
    std::uint16_t word;   // what a master sends
    std::string_view name;
};

// Mask 0: no level of the word is this command.
inline constexpr std::array<Ds402CommandRow, 6> ds402Commands{{
    {Ds402Command::Shutdown, 0x0087, 0x0006, 0x0006, "shutdown"},
    {Ds402Command::SwitchOn, 0x008F, 0x0007, 0x0007, "switch on"},
    {Ds402Command::EnableOperation, 0x008F, 0x000F, 0x000F, "enable operation"},
    {Ds402Command::DisableVoltage, 0x0082, 0x0000, 0x0000, "disable voltage"},
    {Ds402Command::QuickStop, 0x0086, 0x0002, 0x0002, "quick stop"},
    {Ds402Command::FaultReset, 0x0000, 0x0000, 0x0080, "fault reset"},
}};

// The command that stands in a control word. FaultReset is an edge and never the answer: a word
// with bit 7 is None.
constexpr Ds402Command commandOf(std::uint16_t controlWord) noexcept {
    for (const Ds402CommandRow& row : ds402Commands)
        if (row.mask != 0 && (controlWord & row.mask) == row.value) return row.command;
    return Ds402Command::None;
}

constexpr bool isFaultReset(std::uint16_t before, std::uint16_t now) noexcept {
    return (now & ~before & 0x0080) != 0;
}

// The word to send; 0 for None. A fault reset needs a word without bit 7 before it.
constexpr std::uint16_t controlWordOf(Ds402Command command) noexcept {
    for (const Ds402CommandRow& row : ds402Commands)
        if (row.command == command) return row.word;
    return 0;
}

constexpr std::string_view nameOf(Ds402Command command) noexcept {
    for (const Ds402CommandRow& row : ds402Commands)
        if (row.command == command) return row.name;
    return "no command";
}

// One row for each pair of state and cause, so that numbers 3, 7, 10 and 12 have two.
struct Ds402Transition {
    int number;
    Ds402State from;  // Unknown: before power on at 0, any state at 13
    Ds402State to;
    Ds402Command command;  // None: nobody can ask for it
    std::string_view cause;
};

inline constexpr int ds402TransitionNumbers = 17;  // 0 to 16

inline constexpr std::array<Ds402Transition, 21> ds402Transitions{{
    {0, Ds402State::Unknown, Ds402State::NotReadyToSwitchOn, Ds402Command::None, "power on"},
    {1, Ds402State::NotReadyToSwitchOn, Ds402State::SwitchOnDisabled, Ds402Command::None,
     "the end of the self test"},
    {2, Ds402State::SwitchOnDisabled, Ds402State::ReadyToSwitchOn, Ds402Command::Shutdown,
     "shutdown"},
    {3, Ds402State::ReadyToSwitchOn, Ds402State::SwitchedOn, Ds402Command::SwitchOn, "switch on"},
    {3, Ds402State::ReadyToSwitchOn, Ds402State::SwitchedOn, Ds402Command::EnableOperation,
     "enable operation, and 4 follows"},
    {4, Ds402State::SwitchedOn, Ds402State::OperationEnabled, Ds402Command::EnableOperation,
     "enable operation"},
    {5, Ds402State::OperationEnabled, Ds402State::SwitchedOn, Ds402Command::SwitchOn,
     "disable operation"},
    {6, Ds402State::SwitchedOn, Ds402State::ReadyToSwitchOn, Ds402Command::Shutdown, "shutdown"},
    {7, Ds402State::ReadyToSwitchOn, Ds402State::SwitchOnDisabled, Ds402Command::DisableVoltage,
     "disable voltage"},
    {7, Ds402State::ReadyToSwitchOn, Ds402State::SwitchOnDisabled, Ds402Command::QuickStop,
     "quick stop"},
    {8, Ds402State::OperationEnabled, Ds402State::ReadyToSwitchOn, Ds402Command::Shutdown,
     "shutdown"},
    {9, Ds402State::OperationEnabled, Ds402State::SwitchOnDisabled, Ds402Command::DisableVoltage,
     "disable voltage"},
    {10, Ds402State::SwitchedOn, Ds402State::SwitchOnDisabled, Ds402Command::DisableVoltage,
     "disable voltage"},
    {10, Ds402State::SwitchedOn, Ds402State::SwitchOnDisabled, Ds402Command::QuickStop,
     "quick stop"},
    {11, Ds402State::OperationEnabled, Ds402State::QuickStopActive, Ds402Command::QuickStop,
     "quick stop"},
    {12, Ds402State::QuickStopActive, Ds402State::SwitchOnDisabled, Ds402Command::DisableVoltage,
     "disable voltage"},
    {12, Ds402State::QuickStopActive, Ds402State::SwitchOnDisabled, Ds402Command::None,
     "standstill"},
    {13, Ds402State::Unknown, Ds402State::FaultReactionActive, Ds402Command::None, "a fault"},
    {14, Ds402State::FaultReactionActive, Ds402State::Fault, Ds402Command::None,
     "the end of the fault reaction"},
    {15, Ds402State::Fault, Ds402State::SwitchOnDisabled, Ds402Command::FaultReset, "fault reset"},
    {16, Ds402State::QuickStopActive, Ds402State::OperationEnabled, Ds402Command::EnableOperation,
     "enable operation"},
}};

// The transition that a command causes, null where it causes none. Transition 16 needs one of the
// quick stop options 5 to 8 (object 605A). Whether the cause of a fault is gone, the drive alone
// knows.
constexpr const Ds402Transition* transitionOf(Ds402State from, Ds402Command command,
                                              int quickStopOption) noexcept {
    if (command == Ds402Command::None) return nullptr;
    for (const Ds402Transition& row : ds402Transitions)
        if (row.from == from && row.command == command)
            return row.number == 16 && (quickStopOption < 5 || quickStopOption > 8) ? nullptr
                                                                                    : &row;
    return nullptr;
}

// Why transition `number` cannot be asked for in this state, as a sentence with the remedy; empty
// where it can. Not in a tick.
std::string whyNot(Ds402State state, int number, int quickStopOption);

}  // namespace cortex::drives
