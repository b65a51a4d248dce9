// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

// Faults on command: registers that the simulator has and no device. Any connection may write them,
// also while another one commands the drive. As a table for people: docs/ds402-simulator.md.
namespace cortex::modbus::sim {

// From here on a register is one for faults, of whatever is simulated.
inline constexpr std::uint16_t faultsFrom = 0xF000;

// From F000 on for axis 1, from F010 on for axis 2. Efforts are thousandths of N.m or N. Those that
// happen once are 0 again at once.
struct AxisFaults {
    static constexpr std::uint16_t base = faultsFrom, step = 0x10;
    static constexpr std::size_t fault = 0x0;       // code: once, its cause is gone
    static constexpr std::size_t lasting = 0x1;     // code: no reset helps until 0 is written
    static constexpr std::size_t load = 0x2;        // two: pulls towards the negative side
    static constexpr std::size_t friction = 0x4;    // two
    static constexpr std::size_t blocked = 0x6;     // 1: the rotor does not turn
    static constexpr std::size_t stuckOn = 0x7;     // bits of the digital inputs that stay 1
    static constexpr std::size_t stuckOff = 0x8;    // that stay 0
    static constexpr std::size_t jump = 0xA;        // two, once: of the encoder, in counts
    static constexpr std::size_t powerCycle = 0xC;  // 1, once: power off and on
    static constexpr std::size_t statusWord = 0xD;  // told in place of its own; 0: none
    static constexpr std::size_t count = 0xE;
};

// What is wrong with an answer.
enum class WrongWay : std::uint16_t {
    OldImage,          // its heartbeat is not the one that was sent
    OtherTransaction,  // it has the number of another request
    OtherFunction,     // it says FC 3
    TooShort,          // it has fewer registers than were asked for
    Half,              // it breaks off
    NoModbus,          // its header is none
    Refusal            // exception 4
};

// From F100 on: what goes wrong with the connection. Answers are late and wrong to one kind of
// function code alone, FC 23 of a drive, so that whoever commands faults gets his.
struct LinkFaults {
    static constexpr std::uint16_t base = 0xF100;
    static constexpr std::size_t delay = 0;   // ms by which answers are late
    static constexpr std::size_t late = 1;    // how many of the next ones are; FFFF: all
    static constexpr std::size_t way = 2;     // WrongWay
    static constexpr std::size_t wrong = 3;   // how many of the next ones are; FFFF: all
    static constexpr std::size_t refuse = 4;  // 1: hangs up, and takes no new connection
    static constexpr std::size_t freeze = 5;  // 1: answers nothing that asks for less than F000
    static constexpr std::uint16_t all = 0xFFFF, longestDelay = 60000;

    std::array<std::uint16_t, 6> registers{};

    bool isValid() const {
        return registers[delay] <= longestDelay &&
               registers[way] <= static_cast<std::uint16_t>(WrongWay::Refusal) &&
               registers[refuse] <= 1 && registers[freeze] <= 1;
    }
    bool refuses() const { return registers[refuse] != 0; }
    bool isFrozen() const { return registers[freeze] != 0; }
    // Of the next such answer, which then counts.
    std::chrono::milliseconds takeDelay() {
        return std::chrono::milliseconds{take(late) ? registers[delay] : 0};
    }
    std::optional<WrongWay> takeWrongWay() {
        if (!take(wrong)) return std::nullopt;
        return static_cast<WrongWay>(registers[way]);
    }

private:
    bool take(std::size_t counter) {
        const bool isNext = registers[counter] != 0;
        if (isNext && registers[counter] != all) --registers[counter];
        return isNext;
    }
};

}  // namespace cortex::modbus::sim
