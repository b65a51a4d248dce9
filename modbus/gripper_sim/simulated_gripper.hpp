// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gripper_sim/gripper_model.hpp"
#include "sim/simulated_device.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace cortex::modbus::sim {

// Faults on command: registers that no gripper has. As a table for people:
// docs/gripper-simulator.md.
struct GripperFaults {
    static constexpr std::size_t fault = 0;       // gFLT, told until the next activation; once
    static constexpr std::size_t object = 1;      // width of a work piece in 0.1 mm; 0: none
    static constexpr std::size_t ring = 2;        // inner width of one around the fingers
    static constexpr std::size_t powerCycle = 3;  // 1, once
    static constexpr std::size_t count = 4;
};

struct GripperSettings {
    std::optional<double> object;  // m
    double activationTime = 2;     // s
};

// The gripper as its registers show it.
class SimulatedGripper final : public SimulatedDevice {
public:
    // `log` gets a line for each change of activation, fault and object.
    SimulatedGripper(const GripperSettings& settings, Log log);

    void step(std::chrono::nanoseconds time) override;
    void stoodStill(std::chrono::nanoseconds) override {}

    Exception read(std::uint16_t first, std::span<std::uint16_t> to) const override;
    Exception write(std::uint16_t first, std::span<const std::uint16_t> values) override;
    bool isExchange(std::uint8_t function) const override {
        return function == FunctionCode::readInput || function == FunctionCode::readAndWrite;
    }

private:
    using Faults = std::array<std::uint16_t, GripperFaults::count>;
    Exception setFaults(const Faults& wished);
    void tellChange();

    GripperModel model_;
    Log log_;
    Faults faults_{};
    RobotiqStatus told_;
    std::chrono::nanoseconds time_{}, rest_{};
};

}  // namespace cortex::modbus::sim
