// SPDX-License-Identifier: Apache-2.0
#include "drive/ds402_modbus_drive.hpp"

#include "cortex/core/error.hpp"
#include "cortex/drives/ds402_state.hpp"

#include <chrono>
#include <cmath>
#include <utility>

namespace cortex::modbus {
namespace {

std::uint16_t watchdogOf(Simplex& device) {
    const double time = device.data<const double>("watchdogTime") * 1000;
    if (time != 0 && time < Ds402Map::shortestWatchdog)
        throw Error(device.path() + ": watchdogTime is " + toText(time / 1000) +
                    " s, and the drive takes 0.01 to 5; write one of them, or 0 for none");
    return static_cast<std::uint16_t>(std::lround(time));
}

drives::Ds402Outputs outputsOf(const Ds402AxisSeen& seen, const drives::Ds402Scale& scale) {
    drives::Ds402Outputs out;
    out.statusWord = seen.statusWord;
    out.modeDisplay = seen.mode;
    out.errorCode = seen.errorCode;
    out.digitalInputs = seen.inputs;
    out.position = scale.value(seen.position);
    out.velocity = scale.value(seen.velocity);
    out.effort = scale.effort(seen.effort);
    out.demand = scale.value(seen.demand);
    out.followingError = scale.value(seen.followingError);
    out.temperature = seen.temperature / 10.0;
    out.homed = (seen.flags & Ds402AxisSeen::homed) != 0;
    return out;
}

}  // namespace

void Ds402ModbusDrive::populate() {
    populateModbus();
    Ds402Master::Settings settings;
    settings.order = wordOrder();
    settings.watchdog = watchdogOf(*this);
    const auto demands = inputs("demands");
    const auto observations = outputs("observations");
    for (std::size_t i = 0; i < demands.size(); ++i) {
        const OutputSimplex& observation = observations[i];
        const drives::Ds402Parameters parameters = parametersOf(i, observation);
        axes_.push_back({toolkit::Ds402DemandItems{demands[i]},
                         toolkit::Ds402ObservationItems{observation}, observation.path()});
        settings.axes.push_back({observation.path(), parameters});
        last_.axes[i].parameters = parameters;
        last_.axes[i].inputs.controlWord = toolkit::ds402QuickStop;
    }
    master_.populate(std::move(settings));
}

// What is constant here; the rest is wished by the processor, or the drive's own.
drives::Ds402Parameters Ds402ModbusDrive::parametersOf(std::size_t place,
                                                       const OutputSimplex& observation) {
    const auto number = [&](std::string_view item) { return array<const double>(item)[place]; };
    drives::Ds402Parameters parameters;
    parameters.abortOption =
        static_cast<std::int32_t>(array<const std::int64_t>("abortOption")[place]);
    parameters.followingErrorWindow = number("followingErrorWindow");
    parameters.followingErrorTime = number("followingErrorTime");
    parameters.profileVelocity = number("profileVelocity");
    parameters.profileAcceleration = number("profileAcceleration");
    parameters.quickStopDeceleration = number("quickStopDeceleration");
    parameters.softMin = array<const double>("softLimits")[2 * place];
    parameters.softMax = array<const double>("softLimits")[2 * place + 1];
    parameters.countsPerUnit = observation.data<const double>("countsPerUnit");
    parameters.ratedEffort = observation.data<const double>("ratedEffort");
    std::string why = drives::whyNot(parameters);
    if (const Ds402ParameterRow* row = firstBeyond(parameters); row != nullptr && why.empty())
        why = "the " + std::string{row->name} + " has more counts than 32 bits hold; make it less";
    if (!why.empty()) throw Error(path() + ", axis " + std::to_string(place + 1) + ": " + why);
    return parameters;
}

void Ds402ModbusDrive::pack(Ds402Demand& demand) {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        last_.axes[i].inputs = axes_[i].demand.inputs(axes_[i].mode);
        axes_[i].demand.wish(last_.axes[i].parameters);
    }
    demand = last_;
}

// It comes before pack(), and in each cycle.
void Ds402ModbusDrive::quiet(Ds402Demand& demand) {
    const double seconds = std::chrono::duration<double>(period()).count();
    for (Axis& axis : axes_)
        axis.demand.see(inputLost(), axis.observation.position(), axis.mode, seconds);
    demand = last_;
    for (Ds402Demand::Axis& axis : demand.axes) axis.inputs.controlWord = toolkit::ds402QuickStop;
}

void Ds402ModbusDrive::unpack(const Ds402Answer& answer) {
    const std::uint32_t passed = answer.seen.time - std::exchange(time_, answer.seen.time);
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        show(axes_[i], answer.seen.axes[i], passed * 1e-6);
        tell(axes_[i], answer.seen.axes[i], answer.axes[i]);
    }
}

void Ds402ModbusDrive::show(Axis& axis, const Ds402AxisSeen& seen, double seconds) {
    const drives::Ds402Scale scale{axis.observation.countsPerUnit(),
                                   axis.observation.ratedEffort()};
    const drives::Ds402Outputs out = outputsOf(seen, scale);
    const double change = out.velocity - std::exchange(axis.velocity, out.velocity);
    axis.mode = out.modeDisplay;
    axis.observation.write(out, seconds > 0 ? change / seconds : 0, axis.demand.waits());
}

void Ds402ModbusDrive::tell(Axis& axis, const Ds402AxisSeen& seen,
                            const Ds402Answer::Axis& answer) {
    const bool isUnknown = drives::stateOf(seen.statusWord) == drives::Ds402State::Unknown;
    if (isUnknown && !axis.isUnknown)
        event(Severity::Warning, EventText{axis.path} << ": status word " << seen.statusWord
                                                      << " means no state; the last one stays");
    if (answer.isBeyond && !axis.isBeyond)
        event(Severity::Warning, EventText{axis.path}
                                     << ": a target is beyond what the drive's registers hold; "
                                        "the nearest that they hold was sent");
    if (answer.refused != 0 && answer.refused != axis.refused)
        event(Severity::Warning, EventText{axis.path} << ": the drive refuses the "
                                                      << parameterName(answer.refused)
                                                      << " that is wished; the last one stays");
    axis.isUnknown = isUnknown;
    axis.isBeyond = answer.isBeyond;
    axis.refused = answer.refused;
}

void Ds402ModbusDrive::keep(Archive& archive) {
    archive.version("Ds402ModbusDrive", 2);
    for (Axis& axis : axes_) archive & axis;
    for (Ds402Demand::Axis& axis : last_.axes) archive & axis.inputs & axis.parameters;
    archive & time_;
}

}  // namespace cortex::modbus
