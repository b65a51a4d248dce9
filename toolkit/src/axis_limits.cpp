// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/axis_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

namespace cortex::toolkit {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unstatedSpeed = 1e3;  // rad/s or m/s
constexpr double speedUpTime = 0.2;    // s, from rest to the greatest speed
constexpr double rampTime = 0.1;       // s, from no acceleration to the greatest
constexpr double used = 1 - 1e-9;

double valueOf(const std::optional<Number>& bound, double otherwise) {
    if (!bound) return otherwise;
    return std::visit([](auto number) { return static_cast<double>(number); }, *bound);
}

double greatest(const DataItem* item) { return item ? valueOf(item->max, infinity) : infinity; }

// Either way: what a type allows one way only is not planned with.
double magnitude(const DataItem* item) {
    const double most = greatest(item), least = item ? valueOf(item->min, -infinity) : -infinity;
    return least < 0 ? std::min(most, -least) : most;
}

double rate(const DataItem* item) { return item && item->rate ? *item->rate : infinity; }

}  // namespace

AxisLimits::AxisLimits(const Type& axis) {
    const DataItem* position = axis.findData("position");
    const DataItem* velocity = axis.findData("velocity");
    const DataItem* change = axis.findData("acceleration");
    min = position ? valueOf(position->min, -infinity) : -infinity;
    max = greatest(position);
    speed = std::min(magnitude(velocity), rate(position));
    acceleration = std::min(magnitude(change), rate(velocity));
    jerk = rate(change);
    effort = magnitude(axis.findData("effort"));
}

mechanics::MotionLimits AxisLimits::motion(double speedShare) const {
    const double v = std::isfinite(speed) ? speed : unstatedSpeed;
    const double a = std::isfinite(acceleration) ? acceleration : v / speedUpTime;
    const double j = std::isfinite(jerk) ? jerk : a / rampTime;
    return {v * speedShare * used, a * used, j * used};
}

}  // namespace cortex::toolkit
