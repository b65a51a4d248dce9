// SPDX-License-Identifier: Apache-2.0
#include "modbus_io_device.hpp"

#include "cortex/core/error.hpp"

#include <algorithm>
#include <string>

namespace cortex::modbus {
namespace {

[[noreturn]] void refuse(const RelatedSimplex& group, const std::string& why) {
    throw Error(group.path() + " (" + group.type().name + ") " + why);
}

// Constants of a group; those of another agent are not known here.
template <class Group>
std::size_t countOf(const Group& group) {
    if (group.isRemote()) {
        refuse(group,
               "belongs to another agent, so that its count and scale are not known here; relate "
               "a group of this agent, and let a controller of it follow the other one");
    }
    return static_cast<std::size_t>(group.template data<const std::int64_t>("count").get());
}

template <class Group>
void takeScale(const Group& group, ScaledRegisters& registers) {
    const std::size_t count = countOf(group);
    const auto scale = group.template array<const double>("scale");
    const auto offset = group.template array<const double>("offset");
    for (std::size_t i = 0; i < count; ++i) {
        if (scale[i] == 0) {
            refuse(group, "has the scale 0 at place " + std::to_string(i) +
                              " (from 0), and no number would reach it; set what one count of "
                              "the device stands for");
        }
        registers.scale.push_back(scale[i]);
        registers.offset.push_back(offset[i]);
    }
}

// The values that its type gives as safe.
template <class T>
const std::vector<T>& safeValues(const InputSimplex& group) {
    const DataItem* item = group.type().findData("value");
    if (item->safe.kind != Safe::Kind::Given) {
        refuse(group,
               "has no safe values that its type gives as such, and the device would not know what "
               "to give while nobody speaks for them; write safe=\"…\" at its item value");
    }
    return std::get<std::vector<T>>(item->safe.value);
}

}  // namespace

// Throws Error for a group without an address, or the reverse.
int ModbusIoDevice::startOf(std::string_view item, std::string_view rule, std::size_t size) {
    const auto at = static_cast<std::size_t>(data<const std::int64_t>(item) + 1);  // 0: none
    const std::string where = path() + ": " + std::string{item};
    if (size == 0 && at != 0) {
        throw Error(where + " is " + std::to_string(at - 1) + ", but nothing is related by rule " +
                    std::string{rule} + "; relate a group, or leave the item out");
    }
    if (size != 0 && at == 0) {
        throw Error(where + " is -1, but rule " + std::string{rule} +
                    " relates a group; set the address at which it begins in the device");
    }
    if (at + size > ModbusClient::addresses + 1) {
        throw Error(where + " is " + std::to_string(at - 1) + ", and the " + std::to_string(size) +
                    " addresses of rule " + std::string{rule} + " would end beyond 65535");
    }
    return static_cast<int>(at) - 1;
}

void ModbusIoDevice::populate() {
    populateModbus();
    const auto format =
        static_cast<RegisterFormat>(data<const std::int64_t>("registerFormat").get());
    for (ScaledRegisters* each : {&holdingRegisters_, &inputRegisters_}) {
        each->format = format;
        each->order = wordOrder();
    }
    populateDigital();
    populateAnalogue();
    if (coils_.count + discreteInputs_.count + holdingRegisters_.count() +
            inputRegisters_.count() ==
        0) {
        throw Error(path() +
                    " has neither inputs nor outputs, so there is nothing to exchange; relate a "
                    "group by digitalInputs, digitalOutputs, analogueInputs or analogueOutputs");
    }
}

void ModbusIoDevice::populateDigital() {
    for (const InputSimplex& group : inputs("digitalOutputs")) {
        coils_.count = countOf(group);
        digitalOutputs_ = group.array<bool>("value");
        const std::vector<bool>& safe = safeValues<bool>(group);
        for (std::size_t i = 0; i < coils_.count; ++i) safe_.bits[i] = safe[i] ? 1 : 0;
    }
    for (const OutputSimplex& group : outputs("digitalInputs")) {
        discreteInputs_.count = countOf(group);
        digitalInputs_ = group.array<bool>("value");
    }
    coils_.at = startOf("coilsAt", "digitalOutputs", coils_.count);
    discreteInputs_.at = startOf("discreteInputsAt", "digitalInputs", discreteInputs_.count);
}

void ModbusIoDevice::populateAnalogue() {
    for (const InputSimplex& group : inputs("analogueOutputs")) {
        takeScale(group, holdingRegisters_);
        analogueOutputs_ = group.array<double>("value");
        const std::vector<double>& safe = safeValues<double>(group);
        for (std::size_t i = 0; i < holdingRegisters_.count(); ++i) {
            if (!holdingRegisters_.holds(i, safe[i])) {
                refuse(group, "has the safe value " + toText(safe[i]) + " at place " +
                                  std::to_string(i) +
                                  " (from 0), which the register cannot hold; correct scale, "
                                  "offset or registerFormat");
            }
            holdingRegisters_.write(i, safe[i], safe_.words);
        }
    }
    for (const OutputSimplex& group : outputs("analogueInputs")) {
        takeScale(group, inputRegisters_);
        analogueInputs_ = group.array<double>("value");
    }
    holdingRegisters_.at =
        startOf("holdingRegistersAt", "analogueOutputs", holdingRegisters_.words());
    inputRegisters_.at = startOf("inputRegistersAt", "analogueInputs", inputRegisters_.words());
}

// It reads before it writes: a device with other addresses refuses before anything moves.
void ModbusIoDevice::talk(ModbusClient& client, const IoDemand& demand, IoAnswer& answer) {
    if (discreteInputs_.count != 0) {
        client.readDiscreteInputs(discreteInputs_.at,
                                  std::span{answer.bits}.first(discreteInputs_.count));
    }
    if (inputRegisters_.count() != 0) {
        client.readInputRegisters(inputRegisters_.at,
                                  std::span{answer.words}.first(inputRegisters_.words()));
    }
    if (coils_.count != 0) client.writeCoils(coils_.at, std::span{demand.bits}.first(coils_.count));
    if (holdingRegisters_.count() != 0) {
        client.writeRegisters(holdingRegisters_.at,
                              std::span{demand.words}.first(holdingRegisters_.words()));
    }
}

void ModbusIoDevice::pack(IoDemand& demand) {
    for (std::size_t i = 0; i < coils_.count; ++i) demand.bits[i] = digitalOutputs_[i] ? 1 : 0;
    for (std::size_t i = 0; i < holdingRegisters_.count(); ++i) put(i, demand);
}

// Beyond what the register holds, the nearest that it does hold: it never wraps around.
void ModbusIoDevice::put(std::size_t place, IoDemand& demand) {
    const double wanted = analogueOutputs_[place];
    const double given = holdingRegisters_.write(place, wanted, demand.words);
    const bool beyond = !holdingRegisters_.holds(place, wanted);
    if (beyond && !beyond_[place]) {
        event(Severity::Warning, EventText{"analogueOutputs: place "}
                                     << place << " is " << wanted
                                     << ", which its register cannot hold; it gets " << given);
    }
    beyond_[place] = beyond;
}

void ModbusIoDevice::unpack(const IoAnswer& answer) {
    for (std::size_t i = 0; i < discreteInputs_.count; ++i) digitalInputs_[i] = answer.bits[i] != 0;
    for (std::size_t i = 0; i < inputRegisters_.count(); ++i)
        analogueInputs_[i] = inputRegisters_.read(i, answer.words);
}

}  // namespace cortex::modbus
