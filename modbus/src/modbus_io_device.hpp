// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modbus_device.hpp"
#include "register_format.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace cortex::modbus {

inline constexpr std::size_t mostPlaces = 32;  // of a group

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
    struct Bits {
        int at = -1;
        std::size_t count = 0;
    };

    void populate() override;
    void populateDigital();
    void populateAnalogue();
    int startOf(std::string_view item, std::string_view rule, std::size_t size);

    void talk(ModbusClient& client, const IoDemand& demand, IoAnswer& answer) override;
    void pack(IoDemand& demand) CORTEX_REALTIME override;
    void quiet(IoDemand& demand) CORTEX_REALTIME override { demand = safe_; }
    void unpack(const IoAnswer& answer) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override { archive & beyond_; }
    void put(std::size_t place, IoDemand& demand) CORTEX_REALTIME;

    Bits coils_, discreteInputs_;
    ScaledRegisters holdingRegisters_, inputRegisters_;
    IoDemand safe_{};
    std::array<bool, mostPlaces> beyond_{};  // told that the register cannot hold it

    ArrayOf<const bool>::type digitalOutputs_;
    ArrayOf<const double>::type analogueOutputs_;
    ArrayOf<bool>::type digitalInputs_;
    ArrayOf<double>::type analogueInputs_;
};

}  // namespace cortex::modbus
