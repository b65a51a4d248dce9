// SPDX-License-Identifier: Apache-2.0
#include "modbus_io_device.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"

#include <span>
#include <string>
#include <utility>

namespace cortex::modbus {
namespace {

void addScale(ScaledRegisters& registers, Scale scale) {
    registers.scale.push_back(scale.scale);
    registers.offset.push_back(scale.offset);
}

}  // namespace

IoRules ModbusIoDevice::rules(std::string_view group, std::string_view singles) const {
    return {path(), group, singles};
}

// Throws Error for places without an address, or the reverse.
int ModbusIoDevice::startOf(std::string_view item, const IoRules& rules, std::size_t size) {
    const auto at = static_cast<std::size_t>(data<const std::int64_t>(item) + 1);  // 0: none
    const std::string where = path() + ": " + std::string{item};
    const std::string by = std::string{rules.group} + " or " + std::string{rules.singles};
    if (size == 0 && at != 0) {
        throw Error(where + " is " + std::to_string(at - 1) + ", but nothing is related by " + by +
                    "; relate what begins there, or leave the item out");
    }
    if (size != 0 && at == 0) {
        throw Error(where + " is -1, but something is related by " + by +
                    "; set the address at which it begins in the device");
    }
    if (at + size > ModbusClient::addresses + 1) {
        throw Error(where + " is " + std::to_string(at - 1) + ", and the " + std::to_string(size) +
                    " addresses of " + by + " would end beyond 65535");
    }
    return static_cast<int>(at) - 1;
}

// What belongs to another agent, that one speaks for.
bool ModbusIoDevice::hasWriter(const InputSimplex& output) const {
    if (output.isRemote()) return true;
    return !runtime().structure().simplexes[output.simplex().index()].writers.empty();
}

void ModbusIoDevice::populate() {
    populateModbus();
    const auto format =
        static_cast<RegisterFormat>(data<const std::int64_t>("registerFormat").get());
    for (ScaledRegisters* each : {&outputRegisters_, &inputRegisters_}) {
        each->format = format;
        each->order = wordOrder();
    }
    populateDigital();
    populateOutputNumbers();
    populateInputNumbers();
    if (outputSignals_.empty() && inputSignals_.empty() && outputNumbers_.empty() &&
        inputNumbers_.empty()) {
        throw Error(path() +
                    " has neither inputs nor outputs, so there is nothing to exchange; relate "
                    "single concepts by inputSignals, outputSignals, inputNumbers or "
                    "outputNumbers, or a group by digitalInputs, digitalOutputs, analogueInputs or "
                    "analogueOutputs");
    }
}

void ModbusIoDevice::populateDigital() {
    const IoRules output = rules("digitalOutputs", "outputSignals");
    outputSignals_ = ioPlaces<const bool>(inputs(output.group), inputs(output.singles), output);
    for (std::size_t i = 0; i < outputSignals_.size(); ++i) {
        outputSignals_[i].hasWriter = hasWriter(outputSignals_[i].simplex);
        safe_.bits[i] = safeValueOf(outputSignals_[i]) ? 1 : 0;
    }
    coilsAt_ = startOf("coilsAt", output, outputSignals_.size());
    const IoRules input = rules("digitalInputs", "inputSignals");
    inputSignals_ = ioPlaces<bool>(outputs(input.group), outputs(input.singles), input);
    discreteInputsAt_ = startOf("discreteInputsAt", input, inputSignals_.size());
}

void ModbusIoDevice::populateOutputNumbers() {
    const IoRules output = rules("analogueOutputs", "outputNumbers");
    outputNumbers_ = ioPlaces<const double>(inputs(output.group), inputs(output.singles), output);
    for (std::size_t i = 0; i < outputNumbers_.size(); ++i) {
        IoPlace<const double>& place = outputNumbers_[i];
        place.hasWriter = hasWriter(place.simplex);
        addScale(outputRegisters_, scaleOf(place));
        const double safe = safeValueOf(place);
        if (!outputRegisters_.holds(i, safe)) {
            refuse(place.simplex, "has the safe value " + toText(safe) + atPlace(place) +
                                      ", which the register cannot hold; correct scale, offset or "
                                      "registerFormat");
        }
        outputRegisters_.write(i, safe, safe_.words);
    }
    outputRegisters_.at = startOf("holdingRegistersAt", output, outputRegisters_.words());
}

void ModbusIoDevice::populateInputNumbers() {
    const IoRules input = rules("analogueInputs", "inputNumbers");
    inputNumbers_ = ioPlaces<double>(outputs(input.group), outputs(input.singles), input);
    for (const IoPlace<double>& place : inputNumbers_) addScale(inputRegisters_, scaleOf(place));
    areInputsHolding_ = data<const std::int64_t>("holdingInputsAt") >= 0;
    if (areInputsHolding_ && data<const std::int64_t>("inputRegistersAt") >= 0) {
        throw Error(path() +
                    ": inputRegistersAt and holdingInputsAt are both set, but its numbers are read "
                    "from one kind of register; leave one of the two out");
    }
    inputRegisters_.at = startOf(areInputsHolding_ ? "holdingInputsAt" : "inputRegistersAt", input,
                                 inputRegisters_.words());
}

// It reads before it writes: a device with other addresses refuses before anything moves. Where it
// has connected anew, the demand knows nothing of its inputs yet, so the first exchange only reads.
void ModbusIoDevice::talk(ModbusClient& client, const IoDemand& demand, IoAnswer& answer) {
    if (!inputSignals_.empty()) {
        client.readDiscreteInputs(discreteInputsAt_,
                                  std::span{answer.bits}.first(inputSignals_.size()));
    }
    if (!inputNumbers_.empty()) {
        const auto words = std::span{answer.words}.first(inputRegisters_.words());
        if (areInputsHolding_)
            client.readHoldingRegisters(inputRegisters_.at, words);
        else
            client.readInputRegisters(inputRegisters_.at, words);
    }
    const bool hasInputs = !inputSignals_.empty() || !inputNumbers_.empty();
    if (!std::exchange(hasRead_, true) && hasInputs && !isEnding()) return;
    if (!outputSignals_.empty())
        client.writeCoils(coilsAt_, std::span{demand.bits}.first(outputSignals_.size()));
    if (!outputNumbers_.empty()) {
        client.writeRegisters(outputRegisters_.at,
                              std::span{demand.words}.first(outputRegisters_.words()));
    }
}

// What no simplex writes, a person has set, and nobody stops it: unless the device is Active that
// stays safe.
void ModbusIoDevice::pack(IoDemand& demand) {
    demand = safe_;
    for (std::size_t i = 0; i < outputSignals_.size(); ++i) {
        const IoPlace<const bool>& each = outputSignals_[i];
        if (goesOut(each)) demand.bits[i] = each.value ? 1 : 0;
    }
    for (std::size_t i = 0; i < outputNumbers_.size(); ++i) {
        if (goesOut(outputNumbers_[i])) put(i, demand);
    }
}

// Beyond what the register holds, the nearest that it does hold: it never wraps around.
void ModbusIoDevice::put(std::size_t place, IoDemand& demand) {
    const double wanted = outputNumbers_[place].value;
    const double given = outputRegisters_.write(place, wanted, demand.words);
    const bool beyond = !outputRegisters_.holds(place, wanted);
    if (beyond && !beyond_[place]) {
        event(Severity::Warning,
              EventText{outputNumbers_[place].isInGroup ? "analogueOutputs" : "outputNumbers"}
                  << ": place " << place << " is " << wanted
                  << ", which its register cannot hold; it gets " << given);
    }
    beyond_[place] = beyond;
}

void ModbusIoDevice::unpack(const IoAnswer& answer) {
    for (std::size_t i = 0; i < inputSignals_.size(); ++i)
        inputSignals_[i].value = answer.bits[i] != 0;
    for (std::size_t i = 0; i < inputNumbers_.size(); ++i)
        inputNumbers_[i].value = inputRegisters_.read(i, answer.words);
}

}  // namespace cortex::modbus
