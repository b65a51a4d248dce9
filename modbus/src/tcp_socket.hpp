// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modbus_address.hpp"

#include <chrono>

namespace cortex::modbus {

// A socket that is connected to the server, within `time`. It does not block, and select() can
// wait for it. Throws toolkit::LinkError.
int connectTo(const ModbusAddress& server, std::chrono::milliseconds time);

}  // namespace cortex::modbus
