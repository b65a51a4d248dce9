// SPDX-License-Identifier: Apache-2.0
// Targets, reference, servo, motor and brake of the drive model. The servo is a cascade: P for the
// position, PI for the velocity, with the offsets and the ramps' accelerations as feed-forward,
// around a current loop of 1 ms.
#include "cortex/drives/ds402_drive.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::drives {
namespace {

constexpr double positionGain = 75;                   // 1/s, 12 Hz
constexpr double speedGain = 300;                     // 1/s, 48 Hz
constexpr double integralGain = 40;                   // 1/s
constexpr double currentShare = 0.09516258196404048;  // 1 - exp(-timeStep / 1 ms)
constexpr double brakeShare = 1.5;                    // of the greatest effort
constexpr double greatest = 1e12;                     // of any place, velocity and effort

double finite(double value, double otherwise) {
    return std::isfinite(value) ? std::clamp(value, -greatest, greatest) : otherwise;
}

}  // namespace

void Ds402Drive::takeTargets(const Ds402Inputs& in) noexcept {
    const Ds402Inputs before = in_;
    in_ = in;
    for (const auto target : {&Ds402Inputs::position, &Ds402Inputs::velocity, &Ds402Inputs::effort,
                              &Ds402Inputs::velocityOffset, &Ds402Inputs::effortOffset}) {
        if (!std::isfinite(in.*target)) limited_ = true;
        in_.*target = finite(in.*target, before.*target);
    }
    if (mode() == Ds402Mode::ProfilePosition) newSetPoint(before.controlWord);
    if (mode() != Ds402Mode::Homing) return;
    const bool starts = (in_.controlWord & Ds402Control::startHoming) != 0;
    const bool started = (before.controlWord & Ds402Control::startHoming) != 0;
    if (!starts && homing_.runs()) homing_.phase = Homing::Phase::Idle;
    if (starts && !started && state_ == Ds402State::OperationEnabled) beginHoming();
}

// The handshake of control bit 4 and status bit 12: one set-point may wait for the end of another.
void Ds402Drive::newSetPoint(std::uint16_t before) noexcept {
    const auto isSet = [](std::uint16_t word, std::uint16_t bit) { return (word & bit) != 0; };
    const std::uint16_t word = in_.controlWord;
    const bool rises =
        isSet(word, Ds402Control::newSetPoint) && !isSet(before, Ds402Control::newSetPoint);
    if (!isSet(word, Ds402Control::newSetPoint) && !profile_.waiting) profile_.taken = false;
    if (!rises || profile_.taken || state_ != Ds402State::OperationEnabled) return;
    const double target = isSet(word, Ds402Control::relative) ? profile_.target + in_.position
                                                              : in_.position - offset_;
    const bool moves = profile_.target != reference_.position || reference_.velocity != 0;
    profile_.taken = true;
    profile_.waiting = moves && !isSet(word, Ds402Control::atOnce);
    (profile_.waiting ? profile_.next : profile_.target) = target;
}

double Ds402Drive::wishedEffort() noexcept {
    if (!torque_) return 0;
    if (!isObeying()) return brake(deceleration());
    switch (mode()) {
        case Ds402Mode::CyclicPosition:
            return followPosition();
        case Ds402Mode::ProfilePosition:
            return followProfile();
        case Ds402Mode::CyclicVelocity:
            return holdSpeed(withinLimits(in_.velocity + in_.velocityOffset), in_.effortOffset);
        case Ds402Mode::ProfileVelocity:
            return holdSpeed(withinLimits(ramp(in_.velocity, parameters_.profileAcceleration)), 0);
        case Ds402Mode::CyclicTorque:
            return torque();
        case Ds402Mode::Homing:
            return home();
        default:
            return brake(deceleration());
    }
}

// The place of a target, within the software limits.
double Ds402Drive::withinReach(double place) noexcept {
    const Ds402Parameters& p = parameters_;
    if (p.softMin == 0 && p.softMax == 0) return place;
    const double allowed = std::clamp(place, p.softMin - offset_, p.softMax - offset_);
    if (allowed != place) limited_ = true;
    return allowed;
}

double Ds402Drive::followPosition() noexcept {
    reference_ = {withinReach(in_.position - offset_), in_.velocityOffset, 0, false};
    return holdPosition(in_.effortOffset);
}

// A trapezoid of velocity. The speed from which an axis still lands on its target in whole time
// steps t with acceleration a: the solution of d = v (v / a + t) / 2 for v, d being what is left.
double Ds402Drive::followProfile() noexcept {
    const double a = parameters_.profileAcceleration, t = timeStep;
    if (reference_.stopping) reference_.stopping = false;
    if (profile_.waiting && reference_.velocity == 0 &&
        reference_.position == withinReach(profile_.target)) {
        profile_.target = profile_.next;
        profile_.waiting = false;
    }
    const double target = withinReach(profile_.target);
    const double left = target - reference_.position;
    const double landing = a * t * (std::sqrt(0.25 + 2 * std::abs(left) / (a * t * t)) - 0.5);
    const double speed = std::min({parameters_.profileVelocity, parameters_.maxVelocity, landing});
    const double before = reference_.velocity;
    const double effort = (ramp(std::copysign(speed, left), a) - before) / t * axis_.inertia;
    reference_.position += reference_.velocity * t;
    if (std::abs(target - reference_.position) <= a * t * t &&
        std::abs(reference_.velocity) <= 2 * a * t)
        reference_ = {target, 0, 0, false};
    return holdPosition(effort);
}

// Moves the velocity of the reference towards this one, and returns it.
double Ds402Drive::ramp(double velocity, double acceleration) noexcept {
    const double change = acceleration * timeStep;
    reference_.velocity =
        std::clamp(velocity, reference_.velocity - change, reference_.velocity + change);
    return reference_.velocity;
}

// From the motion that there is to rest, and stays there.
double Ds402Drive::brake(double deceleration) noexcept {
    if (!reference_.stopping) {
        reference_ = {motor_.position, motor_.velocity, 0, true};
        motor_.integral = motor_.effort;
    }
    const double before = reference_.velocity;
    const double change = ramp(0, deceleration) - before;
    if (reference_.velocity == 0) reference_.settling += timeStep;
    reference_.position += reference_.velocity * timeStep;
    return holdPosition(change / timeStep * axis_.inertia);
}

double Ds402Drive::torque() noexcept {
    const double gain = axis_.inertia * speedGain;
    const double bound = greatestEffort();
    const double wished = in_.effort + in_.effortOffset;
    const double most = gain * (withinLimits(parameters_.maxVelocity) - motor_.velocity);
    const double least = gain * (withinLimits(-parameters_.maxVelocity) - motor_.velocity);
    const double effort = std::clamp(std::clamp(wished, least, most), -bound, bound);
    limited_ = effort != wished;
    reference_ = {motor_.position, 0, 0, false};
    return effort;
}

// What is less than half a count away is there: a servo sees no more of it.
double Ds402Drive::holdPosition(double effortOffset) noexcept {
    const double half = 0.5 / parameters_.countsPerUnit;
    const double away = reference_.position - motor_.position;
    const double seen = std::abs(away) <= half ? 0 : away - std::copysign(half, away);
    const double wished = positionGain * seen + reference_.velocity;
    const double speed = std::clamp(wished, -parameters_.maxVelocity, parameters_.maxVelocity);
    if (speed != wished) limited_ = true;
    return servo(speed, effortOffset);
}

double Ds402Drive::holdSpeed(double velocity, double effortOffset) noexcept {
    reference_.position = motor_.position;
    reference_.stopping = false;
    return servo(velocity, effortOffset);
}

// The integral stands while the effort is at its limit and would only wind up.
double Ds402Drive::servo(double velocity, double effortOffset) noexcept {
    const double error = velocity - motor_.velocity;
    const double gain = axis_.inertia * speedGain;
    const double bound = greatestEffort();
    const double wished = gain * error + motor_.integral + effortOffset;
    const double effort = std::clamp(wished, -bound, bound);
    if (effort != wished) limited_ = true;
    if (effort == wished || (wished > 0) != (error > 0))
        motor_.integral =
            std::clamp(motor_.integral + gain * integralGain * error * timeStep, -bound, bound);
    return effort;
}

// The speed from which it still stops before a software limit.
double Ds402Drive::withinLimits(double velocity) noexcept {
    const Ds402Parameters& p = parameters_;
    double most = p.maxVelocity, least = -p.maxVelocity;
    if (p.softMin != 0 || p.softMax != 0) {
        const double position = motor_.position + offset_;
        const auto speed = [&](double way) {
            return std::sqrt(2 * p.quickStopDeceleration * std::max(0.0, way));
        };
        most = std::min(most, speed(p.softMax - position));
        least = std::max(least, -speed(position - p.softMin));
    }
    const double allowed = std::clamp(velocity, least, most);
    if (allowed != velocity) limited_ = true;
    return allowed;
}

double Ds402Drive::greatestEffort() const noexcept {
    return parameters_.ratedEffort * axis_.effortShare;
}

void Ds402Drive::moveBrake() noexcept {
    brake_.timer = brake_.wanted == brake_.holds ? 0 : brake_.timer + timeStep;
    if (brake_.wanted == brake_.holds || brake_.timer < axis_.brakeTime) return;
    brake_.holds = brake_.wanted;
    brake_.timer = 0;
}

// Dry friction takes its impulse from the motion and never turns it round, so that an axis comes to
// rest for good.
void Ds402Drive::move(double effort) noexcept {
    const double t = timeStep;
    motor_.effort = torque_ ? motor_.effort + (effort - motor_.effort) * currentShare : 0;
    const double load = finite(disturbance.load, 0);
    const double dry = std::max(0.0, finite(disturbance.friction, 0)) +
                       (brake_.holds ? brakeShare * greatestEffort() : 0);
    const double pushed = (motor_.velocity + t * (motor_.effort - load) / axis_.inertia) /
                          (1 + t * axis_.damping / axis_.inertia);
    const double lost = t * dry / axis_.inertia;
    const double velocity = std::abs(pushed) <= lost ? 0 : pushed - std::copysign(lost, pushed);
    motor_.velocity = disturbance.blockedRotor ? 0 : finite(velocity, 0);
    const double place = motor_.position + motor_.velocity * t;
    motor_.position = finite(betweenStops(place), motor_.position);
    if (motor_.position != place) motor_.velocity = 0;
}

// The place that the ends of the axis leave of this one, and what is in its way.
double Ds402Drive::betweenStops(double place) const noexcept {
    const double min = disturbance.stopMin, max = disturbance.stopMax;
    if (min <= max && (min != 0 || max != 0)) {
        if (place < motor_.position) place = std::max(place, std::min(min, motor_.position));
        if (place > motor_.position) place = std::min(place, std::max(max, motor_.position));
    }
    return std::clamp(place, axis_.negativeSwitch - axis_.overtravel,
                      axis_.positiveSwitch + axis_.overtravel);
}

}  // namespace cortex::drives
