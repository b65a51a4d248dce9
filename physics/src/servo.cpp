// SPDX-License-Identifier: Apache-2.0
#include "servo.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::physics {

double within(double value, double limit) {
    if (value > limit) return limit;
    return value < -limit ? -limit : value;
}

Loop loop(double rate, double dampingRatio, double step) {
    const double fastest = 0.5 / step;
    const double possible = std::min(rate, fastest);
    return {possible, std::min(2 * dampingRatio * possible, 2 * fastest)};
}

double servoAcceleration(const DriveInput& drive, const JointDemand& demand, const Loop& loop) {
    return within(loop.rate * loop.rate * (demand.position - drive.position) +
                      loop.damping * (demand.velocity - drive.velocity),
                  drive.limit / drive.inertia);
}

double gripForce(double demanded, double least, double limit) {
    return std::min(demanded < least ? least : demanded, limit);
}

double gripEffort(const DriveInput& drive, const JointDemand& demand, double force, double step) {
    const Loop grip = loop(std::sqrt(force / gripWay / drive.inertia), 0.9, step);
    return within(drive.inertia * servoAcceleration(drive, demand, grip), force);
}

}  // namespace cortex::physics
