// SPDX-License-Identifier: Apache-2.0
#include "gripper_sim/simulated_gripper.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace cortex::modbus::sim {
namespace {

constexpr std::chrono::nanoseconds timeStep{1'000'000};
constexpr double widthUnit = 1e-4;  // m, of the registers for faults
constexpr std::uint16_t greatestFault = 0xF;

// A block of registers with all of a range in it; `at`: where in the block.
bool holds(std::uint16_t base, std::size_t size, std::uint16_t first, std::size_t count) {
    return first >= base && first - base + count <= size;
}

std::optional<double> widthOf(std::uint16_t word) {
    return word == 0 ? std::nullopt : std::optional{word * widthUnit};
}

}  // namespace

SimulatedGripper::SimulatedGripper(const GripperSettings& settings, Log log)
    : model_{settings.activationTime}, log_{std::move(log)} {
    if (!settings.object) return;
    faults_[GripperFaults::object] =
        static_cast<std::uint16_t>(std::lround(*settings.object / widthUnit));
    model_.object = settings.object;
}

void SimulatedGripper::step(std::chrono::nanoseconds time) {
    rest_ += time;
    for (; rest_ >= timeStep; rest_ -= timeStep) {
        time_ += timeStep;
        model_.step(static_cast<double>(timeStep.count()) * 1e-9);
        tellChange();
    }
}

void SimulatedGripper::tellChange() {
    const RobotiqStatus now = model_.status();
    const bool isSame = now.activation == told_.activation && now.object == told_.object &&
                        now.fault == told_.fault;
    told_ = now;
    if (isSame) return;
    char words[96];
    std::snprintf(words, sizeof words, "%.4f s gSTA %d, gOBJ %d, gFLT %X, width %.1f mm",
                  static_cast<double>(time_.count()) * 1e-9, static_cast<int>(now.activation),
                  static_cast<int>(now.object), now.fault, model_.width() * 1000);
    log_(words);
}

Exception SimulatedGripper::read(std::uint16_t first, std::span<std::uint16_t> to) const {
    const auto from = [&](std::uint16_t base, const auto& image) {
        if (!holds(base, image.size(), first, to.size())) return false;
        std::copy_n(image.begin() + (first - base), to.size(), to.begin());
        return true;
    };
    const bool isThere = from(RobotiqMap::status, encode(model_.status())) ||
                         from(RobotiqMap::request, encode(model_.request())) ||
                         from(faultsFrom, faults_) || from(LinkFaults::base, link.registers);
    return isThere ? Exception::None : Exception::Address;
}

Exception SimulatedGripper::write(std::uint16_t first, std::span<const std::uint16_t> values) {
    const auto with = [&](std::uint16_t base, auto image) {
        std::ranges::copy(values, image.begin() + (first - base));
        return image;
    };
    const auto within = [&](std::uint16_t base, std::size_t size) {
        return holds(base, size, first, values.size());
    };
    if (within(RobotiqMap::request, RobotiqImage{}.size())) {
        model_.request(decodeRequest(with(RobotiqMap::request, encode(model_.request()))));
        return Exception::None;
    }
    if (within(faultsFrom, faults_.size())) return setFaults(with(faultsFrom, faults_));
    if (!within(LinkFaults::base, link.registers.size())) return Exception::Address;
    LinkFaults wished = link;
    wished.registers = with(LinkFaults::base, link.registers);
    if (!wished.isValid()) return Exception::Value;
    link = wished;
    return Exception::None;
}

Exception SimulatedGripper::setFaults(const Faults& wished) {
    using F = GripperFaults;
    if (wished[F::fault] > greatestFault || wished[F::powerCycle] > 1) return Exception::Value;
    if (wished[F::fault] != 0) model_.fail(static_cast<std::uint8_t>(wished[F::fault]));
    model_.object = widthOf(wished[F::object]);
    model_.ring = widthOf(wished[F::ring]);
    if (wished[F::powerCycle] != 0) model_.powerCycle();
    faults_ = wished;
    faults_[F::fault] = faults_[F::powerCycle] = 0;
    return Exception::None;
}

}  // namespace cortex::modbus::sim
