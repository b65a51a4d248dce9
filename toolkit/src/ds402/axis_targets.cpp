// SPDX-License-Identifier: Apache-2.0
#include "ds402/axis_targets.hpp"

#include "cortex/drives/ds402_words.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cortex::toolkit {
namespace {

using drives::Ds402Mode;

constexpr double joiningSpeed = 0.02;  // rad/s or m/s, by which the offset becomes less

bool isOfPosition(int mode) {
    return mode == static_cast<int>(Ds402Mode::CyclicPosition) ||
           mode == static_cast<int>(Ds402Mode::ProfilePosition);
}

bool isOfSpeed(int mode) {
    return mode == static_cast<int>(Ds402Mode::CyclicVelocity) ||
           mode == static_cast<int>(Ds402Mode::ProfileVelocity);
}

}  // namespace

void AxisTargets::standAt(double position) {
    target_ = {position, 0, 0, 0};
    wished_ = position;
    offset_ = 0;
    joined_ = raised_ = false;
}

double AxisTargets::away(const AxisTarget& demand, int mode) const {
    if (isOfPosition(mode)) return std::abs(demand.position - target_.position);
    return isOfSpeed(mode) ? std::abs(demand.velocity) : 0;
}

AxisTargets::Course AxisTargets::follow(const AxisTarget& demand, int mode, bool homed,
                                        double observed, double seconds) {
    if (!joined_ && away(demand, mode) > tolerance) return Course::Waits;
    if (!isOfPosition(mode)) {
        joined_ = true;
        target_ = {observed, isOfSpeed(mode) ? demand.velocity : 0, demand.acceleration,
                   demand.effort};
        return Course::Follows;
    }
    const bool begins = !std::exchange(joined_, true);
    if (!homed) {
        if (away(demand, mode) > tolerance) return Course::NotHomed;
        target_ = {target_.position, 0, 0, demand.effort};
    }
    if (begins || !homed) offset_ = target_.position - demand.position;
    if (!homed) return Course::Follows;
    const double step = joiningSpeed * seconds;
    offset_ -= std::clamp(offset_, -step, step);
    wished_ = demand.position + offset_;
    const bool byProfile = mode == static_cast<int>(Ds402Mode::ProfilePosition);
    target_ = {byProfile ? target_.position : wished_, demand.velocity, demand.acceleration,
               demand.effort};
    return Course::Follows;
}

// A target stands from the edge until the drive has said that it has taken it.
std::uint16_t AxisTargets::setPointBits(bool taken) {
    if (raised_) {
        raised_ = !taken;
    } else if (!taken && wished_ != target_.position) {
        target_.position = wished_;
        raised_ = true;
    }
    const int bits = drives::Ds402Control::newSetPoint | drives::Ds402Control::atOnce;
    return raised_ ? static_cast<std::uint16_t>(bits) : std::uint16_t{0};
}

}  // namespace cortex::toolkit
