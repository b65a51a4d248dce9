// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/fault_registers.hpp"
#include "sim/modbus_frames.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace cortex::modbus::sim {

// What a Server shows: a model with registers. It knows no socket and no clock: its time is what
// step() is told. One thread.
class SimulatedDevice {
public:
    // Gets a line for each thing that is worth one.
    using Log = std::function<void(const std::string& line)>;

    virtual ~SimulatedDevice() = default;

    virtual void step(std::chrono::nanoseconds time) = 0;
    // The process stood still; what would have happened in that time does not.
    virtual void stoodStill(std::chrono::nanoseconds time) = 0;

    virtual Exception read(std::uint16_t first, std::span<std::uint16_t> to) const = 0;
    virtual Exception write(std::uint16_t first, std::span<const std::uint16_t> values) = 0;
    // Whether the answers to this function code are those that `link` makes late and wrong.
    virtual bool isExchange(std::uint8_t function) const = 0;
    // Whoever commands it has exchanged by such a function code, or has left.
    virtual void exchanged() {}
    virtual void disconnected() {}

    LinkFaults link;
};

}  // namespace cortex::modbus::sim
