// SPDX-License-Identifier: Apache-2.0
#include "ds402/axis_targets.hpp"

#include "cortex/drives/ds402_words.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cortex::toolkit {
namespace {

using drives::Ds402Mode;

constexpr double joiningSpeed = 0.02;        // rad/s or m/s, by which the offset becomes less
constexpr double joiningAcceleration = 0.2;  // per s2, of this speed

bool isOfSpeed(int mode) {
    return mode == static_cast<int>(Ds402Mode::CyclicVelocity) ||
           mode == static_cast<int>(Ds402Mode::ProfileVelocity);
}

}  // namespace

bool AxisTargets::isOfPosition(int mode) {
    return mode == static_cast<int>(Ds402Mode::CyclicPosition) ||
           mode == static_cast<int>(Ds402Mode::ProfilePosition);
}

void AxisTargets::standAt(double position) {
    target_ = {position, 0, 0, 0};
    wished_ = position;
    offset_ = offsetSpeed_ = 0;
    joined_ = raised_ = false;
}

// A demand may move without stating a velocity.
void AxisTargets::see(const AxisTarget& demand, double seconds) {
    const double way = std::abs(demand.position - std::exchange(seen_, demand.position));
    demandSpeed_ = std::max(std::abs(demand.velocity), seconds > 0 ? way / seconds : 0);
}

double AxisTargets::away(const AxisTarget& demand, int mode) const {
    if (isOfPosition(mode)) return std::abs(demand.position - target_.position);
    return isOfSpeed(mode) ? std::abs(demand.velocity) : 0;
}

bool AxisTargets::mayJoin(const AxisTarget& demand, int mode) const {
    return away(demand, mode) <= tolerance && (!isOfPosition(mode) || demandSpeed_ <= tolerance);
}

// It begins and ends without a step of speed.
void AxisTargets::reduceOffset(double seconds) {
    const double landing = std::sqrt(2 * joiningAcceleration * std::abs(offset_));
    offsetSpeed_ = std::min({joiningSpeed, offsetSpeed_ + joiningAcceleration * seconds, landing});
    const double step = offsetSpeed_ * seconds;
    offset_ -= std::clamp(offset_, -step, step);
}

AxisTargets::Course AxisTargets::follow(const AxisTarget& demand, int mode, bool homed,
                                        double observed, double seconds) {
    if (!joined_ && !mayJoin(demand, mode)) return Course::Waits;
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
    reduceOffset(seconds);
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
