// SPDX-License-Identifier: Apache-2.0
#include "sim/simulated_drive.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace cortex::modbus::sim {
namespace {

using drives::Ds402State;
using Words = std::span<const std::uint16_t>;

constexpr std::chrono::nanoseconds timeStep{100'000};
static_assert(timeStep.count() * 1e-9 == drives::Ds402Drive::timeStep);

// Bit n: register n of a block is the second half of a number. Nobody may write a half of one.
constexpr std::uint64_t halvesOfTold = 0x0228'0228, halvesOfFaults = 0x0828,
                        halvesOfParameters = 0xAAAA'AAAA'AAAA'AAAA;

bool cutsANumber(std::uint64_t halves, std::size_t at, std::size_t count) {
    return (halves >> at & 1) != 0 || (halves >> (at + count) & 1) != 0;
}

template <class Number>
Number clamped(double value) {
    using Limits = std::numeric_limits<Number>;
    return static_cast<Number>(std::clamp<double>(std::round(value), Limits::min(), Limits::max()));
}

std::uint32_t two(const std::uint16_t* words, WordOrder order) {
    return joined(std::span<const std::uint16_t, 2>{words, 2}, order);
}

drives::Ds402Inputs inputsOf(const Ds402AxisTold& told, const drives::Ds402Scale& scale) {
    return {told.controlWord,
            told.mode,
            scale.value(told.position),
            scale.value(told.velocity),
            scale.effort(told.effort),
            scale.value(told.velocityOffset),
            scale.effort(told.effortOffset),
            told.outputs};
}

drives::Ds402Drive newAxis(const DriveSettings& settings) {
    drives::Ds402Axis axis;
    axis.negativeSwitch = -settings.travel;
    axis.positiveSwitch = settings.travel;
    axis.indexDistance = 0.1;
    axis.absoluteEncoder = settings.isAbsolute;
    axis.selfTestTime = static_cast<double>(settings.selfTest.count()) * 1e-3;
    drives::Ds402Parameters parameters;
    parameters.countsPerUnit = settings.countsPerUnit;
    parameters.ratedEffort = settings.ratedEffort;
    return {axis, parameters};
}

}  // namespace

// Registers that stand one behind the other.
struct SimulatedDrive::Block {
    std::uint16_t base;
    std::vector<std::uint16_t> words;

    template <class Image>
    Block(int first, const Image& image)
        : base{static_cast<std::uint16_t>(first)}, words(image.begin(), image.end()) {}
    bool holds(std::size_t first, std::size_t count) const {
        return first >= base && first + count <= base + words.size();
    }
};

SimulatedDrive::SimulatedDrive(const DriveSettings& settings, Log log)
    : settings_{settings}, log_{std::move(log)} {
    axes_.assign(static_cast<std::size_t>(settings.axes), Axis{newAxis(settings)});
    for (const Axis& axis : axes_) tellLog(axis, "transition 0, power on");
}

drives::Ds402Scale SimulatedDrive::scaleOf(const Axis& axis) const {
    return {axis.model.parameters().countsPerUnit, axis.model.parameters().ratedEffort};
}

Ds402AxisSeen SimulatedDrive::seen(const Axis& axis) const {
    const drives::Ds402Outputs& out = axis.model.outputs();
    const auto [counts, rated] = scaleOf(axis);
    Ds402AxisSeen seen;
    const std::uint16_t told = axis.faults[AxisFaults::statusWord];
    seen.statusWord = told != 0 ? told : out.statusWord;
    seen.mode = out.modeDisplay;
    seen.position = clamped<std::int32_t>(out.position * counts);
    seen.velocity = clamped<std::int32_t>(out.velocity * counts);
    seen.effort = clamped<std::int16_t>(out.effort / rated * 1000);
    seen.errorCode = out.errorCode;
    seen.followingError = clamped<std::int32_t>(out.followingError * counts);
    seen.inputs = out.digitalInputs;
    seen.demand = clamped<std::int32_t>(out.demand * counts);
    seen.temperature = clamped<std::int16_t>(out.temperature * 10);
    seen.lastTransition = static_cast<std::uint8_t>(out.lastTransition);
    seen.refused = static_cast<std::uint8_t>(out.refused);
    seen.flags = out.homed ? Ds402AxisSeen::homed : std::uint16_t{0};
    seen.transitions = static_cast<std::uint16_t>(out.transitions);
    return seen;
}

std::vector<SimulatedDrive::Block> SimulatedDrive::blocks() const {
    const WordOrder order = settings_.wordOrder;
    Ds402Seen all;
    Ds402Identity identity;
    identity.axes = static_cast<std::uint16_t>(axes_.size());
    identity.serial = 1;
    std::vector<Block> blocks;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const Axis& axis = axes_[i];
        all.axes[i] = seen(axis);
        identity.countsPerUnit[i] = axis.model.parameters().countsPerUnit;
        const Ds402ParameterImage numbers = encode(axis.model.parameters());
        std::vector<std::uint16_t> words(2 * numbers.size());
        for (std::size_t k = 0; k < numbers.size(); ++k)
            split(static_cast<std::uint32_t>(numbers[k]), order,
                  std::span<std::uint16_t, 2>{&words[2 * k], 2});
        const int n = static_cast<int>(i);
        blocks.emplace_back(Ds402Map::parameters + n * Ds402Map::parametersStep, words);
        blocks.emplace_back(AxisFaults::base + n * AxisFaults::step, axis.faults);
    }
    all.heartbeat = told_[Ds402Map::heartbeat];
    all.time = static_cast<std::uint32_t>(time_.count() / 1000);
    blocks.emplace_back(Ds402Map::write, told_);
    blocks.emplace_back(Ds402Map::read, encode(all, order));
    blocks.emplace_back(Ds402Map::watchdog, std::array{watchdog_, trips_});
    blocks.emplace_back(Ds402Map::identity, encode(identity, order));
    blocks.emplace_back(LinkFaults::base, link.registers);
    return blocks;
}

Exception SimulatedDrive::read(std::uint16_t first, std::span<std::uint16_t> to) const {
    for (const Block& block : blocks()) {
        if (!block.holds(first, to.size())) continue;
        std::copy_n(&block.words[first - block.base], to.size(), to.begin());
        return Exception::None;
    }
    return Exception::Address;
}

Exception SimulatedDrive::write(std::uint16_t first, Words values) {
    const auto within = [&](std::size_t base, std::size_t count) {
        return first >= base && first + values.size() <= base + count;
    };
    if (within(Ds402Map::write, told_.size())) return tell(first - Ds402Map::write, values);
    if (within(Ds402Map::watchdog, 1)) return setWatchdog(values);
    if (within(LinkFaults::base, link.registers.size()))
        return setLink(first - LinkFaults::base, values);
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const std::size_t parameters = Ds402Map::parameters + i * Ds402Map::parametersStep;
        const std::size_t faults = AxisFaults::base + i * AxisFaults::step;
        if (within(parameters, 2 * ds402ParameterCount))
            return setParameters(axes_[i], first - parameters, values);
        if (within(faults, AxisFaults::count)) return setFaults(axes_[i], first - faults, values);
    }
    return Exception::Address;
}

Exception SimulatedDrive::tell(std::size_t at, Words values) {
    if (cutsANumber(halvesOfTold, at, values.size())) return Exception::Value;
    std::ranges::copy(values, told_.begin() + static_cast<std::ptrdiff_t>(at));
    const Ds402Told told = decode(told_, settings_.wordOrder);
    for (std::size_t i = 0; i < axes_.size(); ++i)
        axes_[i].inputs = inputsOf(told.axes[i], scaleOf(axes_[i]));
    return Exception::None;
}

Exception SimulatedDrive::setParameters(Axis& axis, std::size_t at, Words values) {
    if (cutsANumber(halvesOfParameters, at, values.size())) return Exception::Value;
    const drives::Ds402Parameters& before = axis.model.parameters();
    const Ds402ParameterImage there = encode(before);
    Ds402ParameterImage image = there;
    for (std::size_t i = 0; i < values.size(); i += 2) {
        const std::size_t row = (at + i) / 2;
        image[row] = static_cast<std::int32_t>(two(&values[i], settings_.wordOrder));
        if (ds402ParameterRows()[row].isFixed && image[row] != there[row]) return Exception::Value;
    }
    const drives::Ds402Parameters wished = decode(image, before);
    const bool isMethod = wished.homingMethod >= -128 && wished.homingMethod <= 127;
    return isMethod && axis.model.set(wished) ? Exception::None : Exception::Value;
}

Exception SimulatedDrive::setFaults(Axis& axis, std::size_t at, Words values) {
    using F = AxisFaults;
    if (cutsANumber(halvesOfFaults, at, values.size())) return Exception::Value;
    auto image = axis.faults;
    std::ranges::copy(values, image.begin() + static_cast<std::ptrdiff_t>(at));
    if (image[F::blocked] > 1 || image[F::powerCycle] > 1 || image[F::stuckOn] > 7 ||
        image[F::stuckOff] > 7)
        return Exception::Value;
    const auto number = [&](std::size_t place) {
        return static_cast<std::int32_t>(two(&image[place], settings_.wordOrder));
    };
    if (number(F::friction) < 0) return Exception::Value;
    drives::Ds402Drive& model = axis.model;
    model.disturbance = {number(F::load) / 1000.0, number(F::friction) / 1000.0, image[F::stuckOn],
                         image[F::stuckOff], image[F::blocked] != 0};
    const bool staysAsItIs = image[F::lasting] == axis.faults[F::lasting];
    if (!staysAsItIs) model.clearCause();
    if (!staysAsItIs && image[F::lasting] != 0) model.fail(image[F::lasting], true);
    if (image[F::fault] != 0) model.fail(image[F::fault], false);
    if (number(F::jump) != 0) model.jumpEncoder(number(F::jump) / scaleOf(axis).countsPerUnit);
    if (image[F::powerCycle] != 0) model.powerCycle();
    image[F::fault] = image[F::jump] = image[F::jump + 1] = image[F::powerCycle] = 0;
    axis.faults = image;
    return Exception::None;
}

Exception SimulatedDrive::setLink(std::size_t at, Words values) {
    LinkFaults wished = link;
    std::ranges::copy(values, wished.registers.begin() + static_cast<std::ptrdiff_t>(at));
    if (!wished.isValid()) return Exception::Value;
    link = wished;
    return Exception::None;
}

Exception SimulatedDrive::setWatchdog(Words values) {
    const std::uint16_t time = values[0];
    if (time != 0 && (time < Ds402Map::shortestWatchdog || time > Ds402Map::longestWatchdog))
        return Exception::Value;
    watchdog_ = time;
    return Exception::None;
}

bool SimulatedDrive::isEnabled() const {
    return std::ranges::any_of(
        axes_, [](const Axis& axis) { return axis.model.state() == Ds402State::OperationEnabled; });
}

void SimulatedDrive::exchanged() {
    silent_ = {};
    hasTripped_ = false;
}

void SimulatedDrive::disconnected() { trip("whoever commanded it has left"); }

void SimulatedDrive::stoodStill(std::chrono::nanoseconds time) {
    trip("the simulator stood still for " + std::to_string(time.count() / 1'000'000) + " ms");
}

void SimulatedDrive::trip(const std::string& why) {
    if (!isEnabled()) return;
    ++trips_;
    tellLog("watchdog: " + why);
    for (Axis& axis : axes_) axis.model.communicationLost();
}

void SimulatedDrive::step(std::chrono::nanoseconds time) {
    rest_ += time;
    for (; rest_ >= timeStep; rest_ -= timeStep) {
        time_ += timeStep;
        silent_ += timeStep;
        if (watchdog_ != 0 && !hasTripped_ && silent_ > std::chrono::milliseconds{watchdog_} &&
            isEnabled()) {
            hasTripped_ = true;
            trip("no FC 23 for " + std::to_string(watchdog_) + " ms");
        }
        for (Axis& axis : axes_) stepOnce(axis);
    }
}

void SimulatedDrive::stepOnce(Axis& axis) {
    axis.model.step(axis.inputs, drives::Ds402Drive::timeStep);
    const drives::Ds402Outputs& now = axis.model.outputs();
    char words[160];
    if (now.transitions != axis.transitions) {
        std::snprintf(words, sizeof words, "transition %d, %s -> %s", now.lastTransition,
                      nameOf(axis.state).data(), nameOf(axis.model.state()).data());
        tellLog(axis, words);
    }
    if (now.refused != axis.refused) {
        std::snprintf(words, sizeof words, "refused word %04X, mode %d in %s",
                      axis.inputs.controlWord, axis.inputs.mode, nameOf(axis.state).data());
        tellLog(axis, words);
    }
    axis.transitions = now.transitions;
    axis.refused = now.refused;
    axis.state = axis.model.state();
}

void SimulatedDrive::tellLog(const Axis& axis, const std::string& what) const {
    tellLog(("axis " + std::to_string(&axis - axes_.data() + 1) + ": ") + what);
}

void SimulatedDrive::tellLog(const std::string& what) const {
    char time[32];
    std::snprintf(time, sizeof time, "%.4f s ", static_cast<double>(time_.count()) * 1e-9);
    log_(time + what);
}

}  // namespace cortex::modbus::sim
