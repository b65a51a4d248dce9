// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/drives/ds402_drive.hpp"
#include "cortex/drives/ds402_pdo.hpp"

#include "drive/ds402_registers.hpp"
#include "sim/fault_registers.hpp"
#include "sim/modbus_frames.hpp"
#include "sim/simulated_device.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cortex::modbus::sim {

struct DriveSettings {
    int axes = 1;
    bool isAbsolute = false;        // its encoders need no homing
    double countsPerUnit = 100000;  // of the axis: rad or m
    double ratedEffort = 10;        // N.m or N
    double travel = 3.2;            // limit switches stand at -travel and travel
    std::chrono::milliseconds selfTest{500};
    WordOrder wordOrder = WordOrder::HighWordFirst;
};

// The drive as its registers show it: models of its axes, parameters, watchdog.
class SimulatedDrive final : public SimulatedDevice {
public:
    // `log` gets a line for each transition, refused word and trip of the watchdog.
    SimulatedDrive(const DriveSettings& settings, Log log);

    void step(std::chrono::nanoseconds time) override;
    void stoodStill(std::chrono::nanoseconds time) override;

    Exception read(std::uint16_t first, std::span<std::uint16_t> to) const override;
    Exception write(std::uint16_t first, std::span<const std::uint16_t> values) override;
    bool isExchange(std::uint8_t function) const override {
        return function == FunctionCode::readAndWrite;
    }
    void exchanged() override;
    void disconnected() override;

private:
    struct Axis {
        drives::Ds402Drive model;
        drives::Ds402Inputs inputs{};
        std::array<std::uint16_t, AxisFaults::count> faults{};
        // As of the last time step, for the log.
        std::uint32_t transitions = 0, refused = 0;
        drives::Ds402State state = drives::Ds402State::NotReadyToSwitchOn;
    };
    struct Block;
    std::vector<Block> blocks() const;
    drives::Ds402Scale scaleOf(const Axis& axis) const;
    Ds402AxisSeen seen(const Axis& axis) const;
    Exception tell(std::size_t at, std::span<const std::uint16_t> values);
    Exception setParameters(Axis& axis, std::size_t at, std::span<const std::uint16_t> values);
    Exception setFaults(Axis& axis, std::size_t at, std::span<const std::uint16_t> values);
    Exception setLink(std::size_t at, std::span<const std::uint16_t> values);
    Exception setWatchdog(std::span<const std::uint16_t> values);
    bool isEnabled() const;
    void trip(const std::string& why);
    void stepOnce(Axis& axis);
    void tellLog(const Axis& axis, const std::string& what) const;
    void tellLog(const std::string& what) const;

    DriveSettings settings_;
    Log log_;
    std::vector<Axis> axes_;
    Ds402TellImage told_{};
    std::chrono::nanoseconds time_{}, rest_{}, silent_{};  // silent_: since the last FC 23
    std::uint16_t watchdog_ = 100, trips_ = 0;
    bool hasTripped_ = false;
};

}  // namespace cortex::modbus::sim
