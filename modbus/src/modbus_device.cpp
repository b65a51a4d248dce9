// SPDX-License-Identifier: Apache-2.0
#include "modbus_device.hpp"

#include "cortex/core/error.hpp"

#include <chrono>

namespace cortex::modbus {

ModbusClient::Settings clientSettings(Simplex& device, const toolkit::LinkSettings& link) {
    using namespace std::chrono_literals;
    if (link.responseTimeout > 700ms) {
        throw Error(device.path() +
                    ": responseTimeout is longer than 0.7 s, and the program could not end while "
                    "it waits; write 0.7 or less");
    }
    try {
        ModbusClient::Settings settings{ModbusAddress::parse(link.address),
                                        static_cast<int>(device.data<const std::int64_t>("unit")),
                                        link.responseTimeout};
        const ModbusClient tried{settings};
        return settings;
    } catch (const Error& error) {
        throw Error(device.path() + ": " + error.what());
    }
}

WordOrder wordOrderOf(Simplex& device) {
    return static_cast<WordOrder>(device.data<const std::int64_t>("wordOrder").get());
}

}  // namespace cortex::modbus
