// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/drives/ds402_parameters.hpp"
#include "cortex/drives/ds402_signals.hpp"

#include "drive/ds402_master.hpp"
#include "ds402/drive_items.hpp"
#include "modbus_device.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cortex::modbus {

// Class of type Ds402ModbusDrive (ontology/drives.xml): docs/ds402-simulator.md.
class Ds402ModbusDrive final : public ModbusDevice<Ds402Answer, Ds402Demand> {
public:
    using ModbusDevice::ModbusDevice;

private:
    // One axis as the hooks have it.
    struct Axis {
        toolkit::Ds402DemandItems demand;
        toolkit::Ds402ObservationItems observation;
        std::string path;  // of the observation
        // Of the last answer.
        double velocity = 0;
        std::int64_t mode = 0;
        // Told once, until it is otherwise.
        std::uint16_t refused = 0;
        bool isBeyond = false, isUnknown = false;

        void keep(Archive& archive) CORTEX_REALTIME {
            archive & demand & velocity & mode & refused & isBeyond & isUnknown;
        }
    };

    void populate() override;
    drives::Ds402Parameters parametersOf(std::size_t place, const OutputSimplex& observation);
    void identify(ModbusClient& client) override { master_.identify(client); }
    void talk(ModbusClient& client, const Ds402Demand& demand, Ds402Answer& answer) override {
        master_.exchange(client, demand, answer);
    }

    bool stateStartingUp(const Tick&) CORTEX_REALTIME override {
        return link() == toolkit::Link::Open && !isLost();
    }
    void pack(Ds402Demand& demand) CORTEX_REALTIME override;
    void quiet(Ds402Demand& demand) CORTEX_REALTIME override;
    void unpack(const Ds402Answer& answer) CORTEX_REALTIME override;
    void show(Axis& axis, const Ds402AxisSeen& seen, double seconds) CORTEX_REALTIME;
    void tell(Axis& axis, const Ds402AxisSeen& seen, const Ds402Answer::Axis& answer)
        CORTEX_REALTIME;
    void keep(Archive& archive) CORTEX_REALTIME override;

    Ds402Master master_;
    std::vector<Axis> axes_;
    Ds402Demand last_;  // that was sent
    std::uint32_t time_ = 0;
};

}  // namespace cortex::modbus
