// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io_places.hpp"
#include "modbus_device.hpp"
#include "register_format.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace cortex::modbus {

inline constexpr std::size_t mostPlaces = 32;  // of a kind

struct IoAnswer {
    std::array<std::uint8_t, mostPlaces> bits;
    std::array<std::uint16_t, 2 * mostPlaces> words;
};
struct IoDemand {
    std::array<std::uint8_t, mostPlaces> bits;
    std::array<std::uint16_t, 2 * mostPlaces> words;
};

// Class of type ModbusIoDevice (ontology/devices.xml): docs/modbus.md.
class ModbusIoDevice final : public ModbusDevice<IoAnswer, IoDemand> {
public:
    using ModbusDevice::ModbusDevice;

private:
    void populate() override;
    void populateDigital();
    void populateOutputNumbers();
    void populateInputNumbers();
    IoRules rules(std::string_view group, std::string_view singles) const;
    int startOf(std::string_view item, const IoRules& rules, std::size_t size);
    bool hasWriter(const InputSimplex& output) const;

    void identify(ModbusClient&) override { hasRead_ = false; }
    void talk(ModbusClient& client, const IoDemand& demand, IoAnswer& answer) override;
    void pack(IoDemand& demand) CORTEX_REALTIME override;
    void quiet(IoDemand& demand) CORTEX_REALTIME override { demand = safe_; }
    void unpack(const IoAnswer& answer) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override { archive & beyond_; }
    void put(std::size_t place, IoDemand& demand) CORTEX_REALTIME;
    template <class T>
    bool goesOut(const IoPlace<const T>& output) const CORTEX_REALTIME {
        return output.hasWriter || state() == State::Active;
    }

    std::vector<IoPlace<const bool>> outputSignals_;
    std::vector<IoPlace<const double>> outputNumbers_;
    std::vector<IoPlace<bool>> inputSignals_;
    std::vector<IoPlace<double>> inputNumbers_;

    int coilsAt_ = -1, discreteInputsAt_ = -1;
    ScaledRegisters outputRegisters_, inputRegisters_;
    bool areInputsHolding_ = false;  // the inputs stand in holding registers
    bool hasRead_ = false;           // the thread's: since it has connected
    IoDemand safe_{};
    std::array<bool, mostPlaces> beyond_{};  // told that the register cannot hold it
};

}  // namespace cortex::modbus
