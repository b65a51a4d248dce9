// SPDX-License-Identifier: Apache-2.0
// What cortex-agent loads. The types are listed in cortex-modbus.types, too.
#include "cortex/core/registry.hpp"

#include "drive/ds402_modbus_drive.hpp"
#include "gripper/robotiq_modbus_gripper.hpp"
#include "modbus_io_device.hpp"

namespace {

void addClasses(cortex::ClassRegistry& registry) {
    registry.add<cortex::modbus::Ds402ModbusDrive>("Ds402ModbusDrive");
    registry.add<cortex::modbus::ModbusIoDevice>("ModbusIoDevice");
    registry.add<cortex::modbus::RobotiqModbusGripper>("RobotiqModbusGripper");
}

}  // namespace

CORTEX_PLUGIN(addClasses, {"Ds402ModbusDrive", ""}, {"ModbusIoDevice", ""},
              {"RobotiqModbusGripper", ""})
