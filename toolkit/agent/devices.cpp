// SPDX-License-Identifier: Apache-2.0
#include "devices.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/printable.hpp"
#include "cortex/cs/io_exchange.hpp"

#include "modbus_address.hpp"
#include "stored_values.hpp"

namespace cortex::toolkit {
namespace {

std::string textOf(const Simplex& simplex, const char* item) {
    const DataItem* found = simplex.type().findData(item);
    return found == nullptr ? std::string{} : toText(startValue(simplex, *found));
}

// One that is wrong is refused by its class.
std::string modbusAddress(const std::string& text) {
    try {
        return modbus::ModbusAddress::parse(text).numericText();
    } catch (const Error&) {
        return text;
    }
}

}  // namespace

std::vector<TalkedTo> devicesOf(const SimplexTree& tree) {
    std::vector<TalkedTo> devices;
    for (const auto& [path, simplex] : tree.simplexes()) {
        const Type& type = simplex->type();
        const bool isBeside = dynamic_cast<const cs::ThreadedSimplex*>(simplex.get()) != nullptr;
        if (!isBeside || !type.isA("FieldbusDevice")) continue;
        std::string address = textOf(*simplex, "address");
        const bool isModbus = type.isA("ModbusDevice");
        if (isModbus) address = modbusAddress(address) + ", unit " + textOf(*simplex, "unit");
        devices.push_back({path, printable(address)});
    }
    return devices;
}

std::string devicesLine(const std::vector<TalkedTo>& devices, bool talks) {
    std::string text;
    for (const TalkedTo& each : devices)
        text += (text.empty() ? "" : "; ") + each.path + " at " + each.name;
    if (text.empty()) return text;
    return (talks ? "devices: " : "no device is talked to, and nothing is kept (--no-devices): ") +
           text + "\n";
}

}  // namespace cortex::toolkit
