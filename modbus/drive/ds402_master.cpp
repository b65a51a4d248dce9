// SPDX-License-Identifier: Apache-2.0
#include "drive/ds402_master.hpp"

#include "cortex/toolkit/fieldbus_link.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace cortex::modbus {
namespace {

using toolkit::LinkError;
using toolkit::LinkRefused;

constexpr std::chrono::milliseconds timeToIdentify{400};
constexpr double sameScale = 1e-6;  // relative, as some registers hold thousandths

// What this side writes: constant here, or wished by the processor.
constexpr std::uint16_t constants[] = {0x6007, 0x6065, 0x6066, 0x607D, 0x6081, 0x6083, 0x6085};
constexpr std::uint16_t wishes[] = {0x605A, 0x605E, 0x607C, 0x6098, 0x6099};

template <std::size_t count>
bool isOneOf(const std::uint16_t (&objects)[count], const Ds402ParameterRow& row) {
    return std::ranges::find(objects, row.object) != std::end(objects);
}

std::string hexadecimal(std::uint16_t object) {
    constexpr const char* digits = "0123456789ABCDEF";
    std::string text;
    for (int shift = 12; shift >= 0; shift -= 4) text += digits[object >> shift & 0xF];
    return text;
}

std::string nameOf(const Ds402ParameterRow& row) {
    return std::string{row.name} + " (" + hexadecimal(row.object) +
           (row.sub != 0 ? ":" + std::to_string(row.sub) : "") + ")";
}

std::string shown(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", number);
    return text;
}

bool isSame(double one, double other) {
    return std::abs(one - other) <= sameScale * std::max(std::abs(one), std::abs(other));
}

// The nearest number that the registers hold; what is no number is taken as 0.
template <class Number>
Number nearest(double value, bool& isBeyond) {
    using Limits = std::numeric_limits<Number>;
    const double rounded = std::isnan(value) ? 0 : std::round(value);
    const double held = std::clamp<double>(rounded, Limits::min(), Limits::max());
    isBeyond = isBeyond || held != rounded || std::isnan(value);
    return static_cast<Number>(held);
}

}  // namespace

void Ds402Master::identify(ModbusClient& client) {
    client.allow(timeToIdentify);
    checkIdentity(client);
    readState(client);
    for (std::size_t i = 0; i < settings_.axes.size(); ++i) readParameters(client, i);
    client.writeRegisters(Ds402Map::watchdog, {&settings_.watchdog, 1});
    for (std::size_t i = 0; i < settings_.axes.size(); ++i) {
        const Ds402ParameterImage wanted = encode(settings_.axes[i].parameters);
        for (std::size_t row = 0; row < wanted.size(); ++row) {
            const Ds402ParameterRow& each = ds402ParameterRows()[row];
            if (!isOneOf(constants, each) || write(client, i, row, wanted[row])) continue;
            throw LinkRefused(client.settings().server.text() + ": axis " + std::to_string(i + 1) +
                              " refuses " + std::to_string(wanted[row]) + " as its " +
                              nameOf(each) + "; look into the manual of the drive");
        }
    }
}

void Ds402Master::checkIdentity(ModbusClient& client) {
    const std::string where = client.settings().server.text() + ": ";
    Ds402IdentityImage image{};
    client.readHoldingRegisters(Ds402Map::identity, image);
    const Ds402Identity identity = decode(image, settings_.order);
    const Ds402Identity expected;
    const bool isSwapped =
        decode(image, settings_.order == WordOrder::HighWordFirst ? WordOrder::LowWordFirst
                                                                  : WordOrder::HighWordFirst)
            .name == expected.name;
    if (isSwapped)
        throw LinkRefused(where +
                          "it has the words of its numbers in the other order; set "
                          "wordOrder accordingly");
    if (identity.name != expected.name)
        throw LinkRefused(where + "it is no drive with registers of layout " +
                          std::to_string(Ds402Map::layout) + ", as " +
                          hexadecimal(Ds402Map::identity) + " does not say \"" +
                          std::string{expected.text()} + "\"; look at its address");
    if (identity.axes < settings_.axes.size())
        throw LinkRefused(where + "it has " + std::to_string(identity.axes) + " axes, and " +
                          std::to_string(settings_.axes.size()) +
                          " are related here; relate as many as it has");
    for (std::size_t i = 0; i < settings_.axes.size(); ++i) {
        const double stated = settings_.axes[i].parameters.countsPerUnit;
        if (isSame(identity.countsPerUnit[i], stated)) continue;
        throw LinkRefused(where + "its axis " + std::to_string(i + 1) + " has " +
                          shown(identity.countsPerUnit[i]) + " counts per unit, and " +
                          settings_.axes[i].path + ".countsPerUnit is " + shown(stated) +
                          "; make them equal");
    }
}

// Nothing is written to a drive whose state cannot be read.
void Ds402Master::readState(ModbusClient& client) {
    Ds402SeeImage image{};
    client.readHoldingRegisters(Ds402Map::read, image);
    const std::uint16_t layout = decode(image, settings_.order).layout;
    if (layout == Ds402Map::layout) return;
    throw LinkRefused(client.settings().server.text() + ": its process image has layout " +
                      std::to_string(layout) + ", and this class knows " +
                      std::to_string(Ds402Map::layout) + "; take a class that knows it");
}

void Ds402Master::readParameters(ModbusClient& client, std::size_t axis) {
    std::array<std::uint16_t, 2 * ds402ParameterCount> words{};
    client.readHoldingRegisters(
        static_cast<int>(Ds402Map::parameters + axis * Ds402Map::parametersStep), words);
    Known& known = known_[axis] = {};
    for (std::size_t row = 0; row < known.values.size(); ++row)
        known.values[row] = static_cast<std::int32_t>(
            joined(std::span<const std::uint16_t, 2>{&words[2 * row], 2}, settings_.order));
    const Settings::Axis& stated = settings_.axes[axis];
    for (std::size_t row = 0; row < known.values.size(); ++row) {
        if (ds402ParameterRows()[row].object != 0x6076) continue;
        const double rated = known.values[row] / 1000.0;
        if (isSame(rated, stated.parameters.ratedEffort)) continue;
        throw LinkRefused(client.settings().server.text() + ": its axis " +
                          std::to_string(axis + 1) + " has a rated effort of " + shown(rated) +
                          ", and " + stated.path + ".ratedEffort is " +
                          shown(stated.parameters.ratedEffort) + "; make them equal");
    }
}

bool Ds402Master::write(ModbusClient& client, std::size_t axis, std::size_t row,
                        std::int32_t value) {
    Known& known = known_[axis];
    if (known.values[row] == value) {
        known.isRefused[row] = false;
        return true;
    }
    if (known.isRefused[row] && known.refused[row] == value) return false;
    std::array<std::uint16_t, 2> words{};
    split(static_cast<std::uint32_t>(value), settings_.order, words);
    try {
        client.writeRegisters(
            static_cast<int>(Ds402Map::parameters + axis * Ds402Map::parametersStep + 2 * row),
            words);
    } catch (const LinkRefused&) {
        known.isRefused[row] = true;
        known.refused[row] = value;
        return false;
    }
    known.isRefused[row] = false;
    known.values[row] = value;
    return true;
}

void Ds402Master::wish(ModbusClient& client, std::size_t axis,
                       const drives::Ds402Parameters& parameters, Ds402Answer::Axis& answer) {
    answer.isBeyond = firstBeyond(parameters) != nullptr;
    const Ds402ParameterImage wanted = encode(parameters);
    for (std::size_t row = 0; row < wanted.size(); ++row) {
        const Ds402ParameterRow& each = ds402ParameterRows()[row];
        if (isOneOf(wishes, each) && !write(client, axis, row, wanted[row]))
            answer.refused = each.object;
    }
}

Ds402AxisTold Ds402Master::told(std::size_t axis, const drives::Ds402Inputs& inputs,
                                bool& isBeyond) const {
    const drives::Ds402Parameters& p = settings_.axes[axis].parameters;
    const double counts = p.countsPerUnit, perMille = 1000 / p.ratedEffort;
    Ds402AxisTold told;
    told.controlWord = inputs.controlWord;
    told.mode = inputs.mode;
    told.position = nearest<std::int32_t>(inputs.position * counts, isBeyond);
    told.velocity = nearest<std::int32_t>(inputs.velocity * counts, isBeyond);
    told.effort = nearest<std::int16_t>(inputs.effort * perMille, isBeyond);
    told.effortOffset = nearest<std::int16_t>(inputs.effortOffset * perMille, isBeyond);
    told.velocityOffset = nearest<std::int32_t>(inputs.velocityOffset * counts, isBeyond);
    told.outputs = static_cast<std::uint16_t>(inputs.digitalOutputs);
    return told;
}

void Ds402Master::exchange(ModbusClient& client, const Ds402Demand& demand, Ds402Answer& answer) {
    Ds402Told all;
    for (std::size_t i = 0; i < settings_.axes.size(); ++i) {
        wish(client, i, demand.axes[i].parameters, answer.axes[i]);
        all.axes[i] = told(i, demand.axes[i].inputs, answer.axes[i].isBeyond);
    }
    all.heartbeat = ++heartbeat_;
    Ds402SeeImage image{};
    client.writeAndReadRegisters(Ds402Map::write, encode(all, settings_.order), Ds402Map::read,
                                 image);
    answer.seen = decode(image, settings_.order);
    if (answer.seen.heartbeat != heartbeat_)
        throw LinkError(client.settings().server.text() +
                        ": its answer is an old one, as its "
                        "heartbeat is " +
                        std::to_string(answer.seen.heartbeat) + " and not " +
                        std::to_string(heartbeat_) + "; look at the drive");
}

}  // namespace cortex::modbus
