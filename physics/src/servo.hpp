// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics.hpp"

#include <numbers>

// What the drives do, as functions of numbers: m or rad, N or N.m, kg or kg.m2, s.
namespace cortex::physics {

// A joint as its drive sees it at the begin of a step.
struct DriveInput {
    double position = 0, velocity = 0;
    double load = 0;     // what weight, Coriolis forces and damping take of its effort
    double inertia = 1;  // that it moves
    double limit = 0;    // of its effort
};

// A position loop: a spring of `rate`^2 and a damper of `damping`, each times an inertia.
struct Loop {
    double rate = 0;     // rad/s
    double damping = 0;  // 1/s
};

inline constexpr double brakeRate = 2 * std::numbers::pi * 30;
// What a gripper's spring gives way before it has its whole force.
inline constexpr double gripWay = 0.002;

// The loop that was asked for, but not faster than steps of this length can follow.
Loop loop(double rate, double dampingRatio, double step) CORTEX_REALTIME;

// Acceleration towards position and velocity of the demand; never more than what the limit of the
// effort could give to the inertia.
double servoAcceleration(const DriveInput& drive, const JointDemand& demand, const Loop& loop)
    CORTEX_REALTIME;

// Not std::clamp: what is no number stays none, and is seen.
double within(double value, double limit) CORTEX_REALTIME;

// Force that a gripper may use of the one that is demanded.
double gripForce(double demanded, double least, double limit) CORTEX_REALTIME;

// Force of each jaw towards the demand, never more than `force`.
double gripEffort(const DriveInput& drive, const JointDemand& demand, double force, double step)
    CORTEX_REALTIME;

}  // namespace cortex::physics
