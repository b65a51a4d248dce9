// SPDX-License-Identifier: Apache-2.0
#include "simulated_axis.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/value.hpp"
#include "cortex/drives/ds402_words.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cortex::toolkit {
namespace {

constexpr double brakeTime = 0.02;   // s, time constant
constexpr double standstill = 1e-4;  // rad/s or m/s
constexpr double patience = 1;       // s
constexpr int byPosition = static_cast<int>(drives::Ds402Mode::CyclicPosition);

}  // namespace

void SimulatedAxis::populate() {
    const OutputSimplex observation = output("observation");
    demand_.emplace(input("demand"));
    observation_.emplace(observation);
    observedStatus_ = observation.data<std::int64_t>("status");
    limits_.emplace(observation.type());
    naturalFrequency_ = data<const double>("naturalFrequency");
    dampingRatio_ = data<const double>("dampingRatio");
    followingError_ = data<double>("followingError");
    limitCount_ = data<std::int64_t>("limitCount");
    position_ = std::clamp(startOf(observation), limits_->min, limits_->max);
    observation_->write(position_, 0);
    observedStatus_ = Braked;
}

// As a world with physics has it: a position that is given for the observation counts, too.
double SimulatedAxis::startOf(const OutputSimplex& observation) {
    const double stated = data<const double>("startPosition");
    if (!observation.hasValue("position")) return stated;
    const double given = observation.data<const double>("position");
    if (!hasValue("startPosition") || stated == given) return given;
    throw Error(path() + ": startPosition is " + toText(stated) + ", and position of " +
                observation.path() + " is given as " + toText(given) + ": give one of the two");
}

AxisTarget SimulatedAxis::demand() const { return {demand_->position, demand_->velocity, 0, 0}; }

void SimulatedAxis::loopStart(const Tick& tick) { targets_.see(demand(), tick.elapsedSeconds()); }

// As drives do: it does not switch on while the demand is elsewhere.
bool SimulatedAxis::stateStartingUp(const Tick& tick) {
    targets_.standAt(position_);
    return !waitsForDemand(tick.elapsedSeconds());
}

// Nor does it go on with a demand that was lost, or began anew, and is back elsewhere: it stops by
// the limits of its axis, brakes, and waits.
void SimulatedAxis::chooseTarget(double seconds) {
    const bool isActive = state() == State::Active;
    const bool stands = std::abs(velocity_) < standstill;
    if (isActive && inputLost() && targets_.follows()) stop_ = {position_, velocity_, 0};
    stops_ = isActive && ((inputLost() && targets_.follows()) || (stops_ && !stands));
    if (stops_) {
        const auto way = mechanics::planVelocity(stop_, 0, limits_->motion());
        stop_ = way ? way->at(seconds) : mechanics::MotionState{stop_.position, 0, 0};
    }
    if (!isActive || inputLost() || (!targets_.follows() && !stands)) targets_.standAt(position_);
    if (!isActive || inputLost()) return;
    if (!targets_.follows() && waitsForDemand(seconds)) return;
    targets_.follow(demand(), byPosition, true, position_, seconds);
}

bool SimulatedAxis::waitsForDemand(double seconds) {
    const double away = targets_.away(demand(), byPosition);
    const bool mayJoin = targets_.mayJoin(demand(), byPosition);
    if (mayJoin && std::abs(velocity_) < standstill) return false;
    const bool tells = waited_ < patience;
    waited_ += seconds;
    if (!tells || waited_ < patience) return true;
    EventText text{"it waits for its demand, which "};
    if (away > AxisTargets::tolerance)
        text << "is " << away << " away; the controller brings it here";
    else
        text << "moves; let it rest";
    event(Severity::Warning, text);
    return true;
}

// Distance to a demand that moves on at its velocity: e'' + 2 d w e' + w^2 e = 0, solved exactly
// for the time since the last cycle.
void SimulatedAxis::servo(double seconds) {
    const double w = 2 * std::numbers::pi * naturalFrequency_;
    const double damping = dampingRatio_ * w;
    const double turn = w * std::sqrt(std::max(0.0, 1 - dampingRatio_ * dampingRatio_));
    const double decay = std::exp(-damping * seconds);
    const double cosine = std::cos(turn * seconds);
    const double sine = turn * seconds < 1e-6 ? seconds : std::sin(turn * seconds) / turn;
    const AxisTarget& followed = targets_.target();
    const double target = stops_ ? stop_.position : followed.position;
    const double targetSpeed = stops_ ? stop_.velocity : followed.velocity;
    const double error = position_ - target;
    const double errorSpeed = velocity_ - targetSpeed;
    const double newError = decay * (error * cosine + (errorSpeed + damping * error) * sine);
    const double newSpeed =
        decay * (errorSpeed * cosine - (damping * errorSpeed + w * w * error) * sine);
    position_ = target + targetSpeed * seconds + newError;
    velocity_ = targetSpeed + newSpeed;
}

void SimulatedAxis::brake(double seconds) {
    const double decay = std::exp(-seconds / brakeTime);
    position_ += velocity_ * brakeTime * (1 - decay);
    velocity_ *= decay;
}

void SimulatedAxis::limit(double before, double seconds) {
    const double reach = limits_->speed * seconds;
    const double position = std::clamp(std::clamp(position_, before - reach, before + reach),
                                       limits_->min, limits_->max);
    const double velocity = position <= limits_->min || position >= limits_->max
                                ? 0
                                : std::clamp(velocity_, -limits_->speed, limits_->speed);
    const bool limited = position != position_ || velocity != velocity_;
    if (limited && !atLimit_) limitCount_ += 1;
    atLimit_ = limited;
    position_ = position;
    velocity_ = velocity;
}

std::int64_t SimulatedAxis::status() const {
    if (state() == State::Fault) return Faulty;
    if (!obeys()) return Braked;
    if (atLimit_) return AtLimit;
    return std::abs(velocity_) < standstill ? Ready : Moving;
}

bool SimulatedAxis::obeys() const { return state() == State::Active && targets_.follows(); }

void SimulatedAxis::loopEnd(const Tick& tick) {
    const double before = position_, velocityBefore = velocity_;
    const double seconds = tick.elapsedSeconds();
    chooseTarget(seconds);
    if (obeys() || stops_)
        servo(seconds);
    else
        brake(seconds);
    limit(before, seconds);
    observation_->write(position_, velocity_, (velocity_ - velocityBefore) / seconds);
    observedStatus_ = status();
    if (state() != State::StartingUp && (state() != State::Active || obeys())) waited_ = 0;
    followingError_ = demand_->position - position_;
}

void SimulatedAxis::keep(Archive& archive) {
    archive.version("SimulatedAxis", 3);
    archive & position_ & velocity_ & waited_ & atLimit_ & targets_ & stop_ & stops_;
}

}  // namespace cortex::toolkit
