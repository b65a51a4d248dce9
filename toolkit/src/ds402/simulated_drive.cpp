// SPDX-License-Identifier: Apache-2.0
#include "ds402/simulated_drive.hpp"

#include "cortex/toolkit/axis_limits.hpp"

#include <cmath>

namespace cortex::toolkit {
namespace {

constexpr double ratedAcceleration = 100;  // per s2, of an axis that states no armature
constexpr double countsPerIndex = 10000;
constexpr double spareSpeed = 1.5;     // of the axis' greatest, so that it can catch up
constexpr double anySpeed = 1000;      // where the axis states none
constexpr double selfTestTime = 0.05;  // s

// The axis as its observation states it: limit switches where its range ends.
drives::Ds402Axis mechanismOf(const OutputSimplex& observation, const Ds402ObservationItems& items,
                              double start) {
    const AxisLimits limits{observation.type()};
    const double armature = observation.data<const double>("armature");
    drives::Ds402Axis axis;
    axis.inertia = armature > 0 ? armature : items.ratedEffort() / ratedAcceleration;
    axis.damping = observation.data<const double>("damping");
    axis.startPosition = start;
    axis.negativeSwitch = limits.min;
    axis.positiveSwitch = limits.max;
    axis.indexDistance = countsPerIndex / items.countsPerUnit();
    axis.absoluteEncoder = !items.homingNeeded();
    axis.selfTestTime = selfTestTime;
    return axis;
}

}  // namespace

drives::Ds402Parameters Ds402SimulatedDrive::parametersOf(std::size_t place,
                                                          const OutputSimplex& observation) {
    const auto number = [&](std::string_view item) { return array<const double>(item)[place]; };
    const AxisLimits limits{observation.type()};
    drives::Ds402Parameters parameters;
    parameters.abortOption =
        static_cast<std::int32_t>(array<const std::int64_t>("abortOption")[place]);
    parameters.followingErrorWindow = number("followingErrorWindow");
    parameters.followingErrorTime = number("followingErrorTime");
    parameters.profileVelocity = number("profileVelocity");
    parameters.profileAcceleration = number("profileAcceleration");
    parameters.homingAcceleration = parameters.profileAcceleration;
    parameters.quickStopDeceleration = number("quickStopDeceleration");
    parameters.softMin = array<const double>("softLimits")[2 * place];
    parameters.softMax = array<const double>("softLimits")[2 * place + 1];
    parameters.maxVelocity = std::isfinite(limits.speed) ? spareSpeed * limits.speed : anySpeed;
    parameters.countsPerUnit = observation.data<const double>("countsPerUnit");
    parameters.ratedEffort = observation.data<const double>("ratedEffort");
    return parameters;
}

void Ds402SimulatedDrive::populate() {
    const auto demands = inputs("demands");
    const auto observations = outputs("observations");
    const auto start = array<const double>("startPosition");
    for (std::size_t i = 0; i < demands.size(); ++i) {
        const Ds402ObservationItems items{observations[i]};
        const drives::Ds402Parameters parameters = parametersOf(i, observations[i]);
        if (const std::string why = drives::whyNot(parameters); !why.empty())
            throw Error(path() + ", axis " + std::to_string(i + 1) + ": " + why);
        const drives::Ds402Axis axis = mechanismOf(observations[i], items, start[i]);
        axes_.push_back({Ds402DemandItems{demands[i]}, items, {axis, parameters}});
        axes_.back().observation.write(axes_.back().drive.outputs(), 0, false);
    }
    load_ = array<const double>("load");
    friction_ = array<const double>("friction");
    stops_ = array<const double>("stops");
    faultAxis_ = argument<std::int64_t>("injectFault", "axis");
    faultCode_ = argument<std::int64_t>("injectFault", "code");
    jumpAxis_ = argument<std::int64_t>("jumpEncoder", "axis");
    jumpBy_ = argument<double>("jumpEncoder", "by");
    on<&Ds402SimulatedDrive::injectFault>("injectFault");
    on<&Ds402SimulatedDrive::jumpEncoder>("jumpEncoder");
    on<&Ds402SimulatedDrive::reconnect>("reconnect");
    items_.populate(*this);
    report_.link = Link::Open;
}

bool Ds402SimulatedDrive::stateStartingUp(const Tick&) {
    for (const Axis& axis : axes_)
        if (axis.drive.state() == drives::Ds402State::NotReadyToSwitchOn) return false;
    return true;
}

void Ds402SimulatedDrive::settingsProposed(ProposedSettings& proposed) {
    const auto stops = proposed[stops_];
    for (std::size_t i = 0; i < stops.size(); i += 2) {
        if (stops[i] > stops[i + 1])
            proposed.refuse("stops: the least place of an axis is above its greatest");
    }
}

// What its processor wishes, and what is disturbed.
void Ds402SimulatedDrive::set(std::size_t place) {
    Axis& axis = axes_[place];
    drives::Ds402Parameters parameters = axis.drive.parameters();
    axis.demand.wish(parameters);
    const bool refuses = !axis.drive.set(parameters);
    if (refuses && !axis.refuses) {
        event(Severity::Warning, EventText{"axis "} << static_cast<std::int64_t>(place + 1)
                                                    << " is not set anew: an option is unknown, or "
                                                       "a homing speed is not above 0");
    }
    axis.refuses = refuses;
    const double share = parameters.ratedEffort / 100;
    axis.drive.disturbance.load = load_[place] * share;
    axis.drive.disturbance.friction = friction_[place] * share;
    axis.drive.disturbance.stopMin = stops_[2 * place];
    axis.drive.disturbance.stopMax = stops_[2 * place + 1];
}

void Ds402SimulatedDrive::loopEnd(const Tick& tick) {
    const double seconds = tick.elapsedSeconds();
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        Axis& axis = axes_[i];
        set(i);
        const drives::Ds402Outputs& outputs = axis.drive.outputs();
        const double before = outputs.velocity;
        axis.demand.see(inputLost(), outputs.position, outputs.modeDisplay, seconds);
        drives::Ds402Inputs inputs = axis.demand.inputs(outputs.modeDisplay);
        if (inputLost() || state() == State::Fault) inputs.controlWord = ds402QuickStop;
        axis.drive.step(inputs, seconds);
        axis.observation.write(outputs, seconds > 0 ? (outputs.velocity - before) / seconds : 0,
                               axis.demand.waits());
    }
    ++report_.exchanges;
    items_.write(report_, 0);
}

Ds402SimulatedDrive::Axis* Ds402SimulatedDrive::named(Call& call, Argument<std::int64_t> axis) {
    const std::int64_t number = call[axis];
    if (number <= static_cast<std::int64_t>(axes_.size()))
        return &axes_[static_cast<std::size_t>(number - 1)];
    call.reject(Reason::Range, (EventText{"there is no axis "} << number << ", there is 1").view());
    return nullptr;
}

Outcome Ds402SimulatedDrive::injectFault(Call& call) {
    Axis* axis = named(call, faultAxis_);
    if (axis == nullptr) return Outcome::Rejected;
    axis->drive.fail(static_cast<std::uint16_t>(call[faultCode_]), false);
    return Outcome::Done;
}

Outcome Ds402SimulatedDrive::jumpEncoder(Call& call) {
    Axis* axis = named(call, jumpAxis_);
    if (axis == nullptr) return Outcome::Rejected;
    axis->drive.jumpEncoder(call[jumpBy_]);
    return Outcome::Done;
}

// There is no link that could be cut: it is open again at once.
Outcome Ds402SimulatedDrive::reconnect(Call&) {
    ++report_.reconnects;
    return Outcome::Done;
}

void Ds402SimulatedDrive::keep(Archive& archive) {
    archive.version("Ds402SimulatedDrive", 3);
    for (Axis& axis : axes_) archive & axis.drive & axis.demand & axis.refuses;
    archive & report_.exchanges & report_.reconnects;
}

}  // namespace cortex::toolkit
