// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/drives/ds402_pdo.hpp"
#include "cortex/drives/ds402_signals.hpp"

#include "drive/ds402_registers.hpp"
#include "modbus_client.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cortex::modbus {

// What goes to the drive in each exchange.
struct Ds402Demand {
    struct Axis {
        drives::Ds402Inputs inputs;
        drives::Ds402Parameters parameters;
    };
    std::array<Axis, Ds402Map::axes> axes;
};

// What comes back.
struct Ds402Answer {
    struct Axis {
        std::uint16_t refused = 0;  // object whose value the drive refuses; 0: none
        bool isBeyond = false;      // a value was sent as the nearest that its registers hold
    };
    Ds402Seen seen;
    std::array<Axis, Ds402Map::axes> axes;
};

// The side of the master on the wire. For one thread, which it may block; it throws what
// ModbusClient throws.
class Ds402Master {
public:
    struct Settings {
        struct Axis {
            std::string path;                    // of what its scale is stated in
            drives::Ds402Parameters parameters;  // with the scale that the drive is to have
        };
        std::vector<Axis> axes;
        WordOrder order = WordOrder::HighWordFirst;
        std::uint16_t watchdog = 100;  // ms
    };
    void populate(Settings settings) { settings_ = std::move(settings); }

    // Asks who is there, reads the state and the parameters of the drive, and only then writes the
    // parameters that are constant here. Throws LinkRefused where it is another drive.
    void identify(ModbusClient& client);
    // What is wished otherwise than the drive has it goes first, then the one exchange.
    void exchange(ModbusClient& client, const Ds402Demand& demand, Ds402Answer& answer);

private:
    // The parameters of one axis in the drive, and what it refused.
    struct Known {
        Ds402ParameterImage values{};
        Ds402ParameterImage refused{};  // values, where `object` says that there is one
        std::array<bool, ds402ParameterCount> isRefused{};
    };
    void checkIdentity(ModbusClient& client);
    void readState(ModbusClient& client);
    void readParameters(ModbusClient& client, std::size_t axis);
    // False: the drive refuses the value.
    bool write(ModbusClient& client, std::size_t axis, std::size_t row, std::int32_t value);
    void wish(ModbusClient& client, std::size_t axis, const drives::Ds402Parameters& parameters,
              Ds402Answer::Axis& answer);
    Ds402AxisTold told(std::size_t axis, const drives::Ds402Inputs& inputs, bool& isBeyond) const;

    Settings settings_;
    std::array<Known, Ds402Map::axes> known_;
    std::uint16_t heartbeat_ = 0;
};

}  // namespace cortex::modbus
