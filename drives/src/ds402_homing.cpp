// SPDX-License-Identifier: Apache-2.0
// Homing of the drive model (CiA 402 mode 6): limit switch, its edge, index, or where it stands.
#include "cortex/drives/ds402_drive.hpp"

#include <cmath>

namespace cortex::drives {
namespace {

constexpr double stallPatience = 0.5;  // s, for an axis that hardly moves

struct MethodRow {
    int method;
    std::int8_t side;  // of the limit switch; 0: none
    std::int8_t way;   // towards the edge or the index; 0: where it stands
    bool index;
};

constexpr MethodRow methods[] = {
    {1, -1, 1, true},  {2, 1, -1, true}, {17, -1, 1, false}, {18, 1, -1, false},
    {33, 0, -1, true}, {34, 0, 1, true}, {35, 0, 0, false},  {37, 0, 0, false},
};

const MethodRow* rowOf(int method) {
    for (const MethodRow& row : methods)
        if (row.method == method) return &row;
    return nullptr;
}

}  // namespace

bool isHomingMethod(int method) noexcept { return rowOf(method) != nullptr; }

void Ds402Drive::beginHoming() noexcept {
    using Phase = Homing::Phase;
    out_.homed = false;
    const MethodRow* row = rowOf(parameters_.homingMethod);
    if (!row || (row->index && !(axis_.indexDistance > 0))) {
        homing_ = {Phase::Error};
        return;
    }
    homing_ = {Phase::Index, row->side, row->way, row->index, motor_.position};
    if (row->side != 0) homing_.phase = isOn(row->side) ? Phase::Leave : Phase::Seek;
    if (row->way == 0) found(motor_.position);
}

double Ds402Drive::home() noexcept {
    using Phase = Homing::Phase;
    if (homing_.runs()) search();
    if (!homing_.runs()) return brake(parameters_.homingAcceleration);
    const double speed = homing_.phase == Phase::Seek ? homing_.side * parameters_.homingSpeed
                                                      : homing_.way * parameters_.homingCreep;
    const double wished = ramp(speed, parameters_.homingAcceleration);
    const bool stalls = std::abs(motor_.velocity) < 0.1 * std::abs(wished);
    homing_.stalled = stalls ? homing_.stalled + timeStep : 0;
    if (homing_.stalled > stallPatience) homing_.phase = Phase::Error;
    return holdSpeed(withinLimits(wished), 0);
}

// From one phase to the next.
void Ds402Drive::search() noexcept {
    using Phase = Homing::Phase;
    const double before = homing_.last;
    homing_.last = motor_.position;
    if (homing_.phase == Phase::Seek) {
        if (isOn(homing_.side)) homing_.phase = Phase::Leave;
    } else if (isOn(homing_.way)) {
        homing_.phase = Phase::Error;
    } else if (homing_.phase == Phase::Index) {
        const double from = std::floor(before / axis_.indexDistance);
        const double to = std::floor(motor_.position / axis_.indexDistance);
        if (from != to) found(std::max(from, to) * axis_.indexDistance);
    } else if (!isOn(homing_.side)) {
        if (homing_.index)
            homing_.phase = Phase::Index;
        else
            found(motor_.position);
    }
}

void Ds402Drive::found(double place) noexcept {
    offset_ = parameters_.homeOffset - place;
    out_.homed = true;
    homing_.phase = Homing::Phase::Attained;
}

std::uint32_t Ds402Drive::switches() const noexcept {
    const std::uint32_t on = (motor_.position <= axis_.negativeSwitch ? 1u : 0u) |
                             (motor_.position >= axis_.positiveSwitch ? 2u : 0u) |
                             (motor_.position >= axis_.homeSwitch ? 4u : 0u);
    return ((on | disturbance.stuckOn) & ~disturbance.stuckOff) & 7u;
}

bool Ds402Drive::isOn(int side) const noexcept {
    return side != 0 && (switches() & (side < 0 ? 1u : 2u)) != 0;
}

}  // namespace cortex::drives
