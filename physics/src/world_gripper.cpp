// SPDX-License-Identifier: Apache-2.0
#include "world_gripper.hpp"

#include "servo.hpp"

#include <cmath>

namespace cortex::physics {
namespace {

// Jaws that go this far within this time move: at 1 mm/s. A work piece that rocks between them
// makes them faster for a moment, but they stay where they are.
constexpr double jawWay = 5e-5;       // m
constexpr double jawRestTime = 0.05;  // s
constexpr double jawNearness = 1e-3;  // m, between jaws and demand
constexpr double letGoWay = 2e-4;     // m, of a demand away from the jaws

}  // namespace

WorldGripper::WorldGripper(const OutputSimplex& status, double opening)
    : object_{status.data<std::int64_t>("object")} {
    reset(opening);
}

void WorldGripper::reset(double opening) {
    aim_ = place_ = opening;
    speed_ = force_ = 0;
    isLed_ = false;
    rested_ = jawRestTime;
    object_ = AtDemand;
}

bool WorldGripper::presses(const JointState& jaws) const {
    return (object_ == StoppedClosing && aim_ < jaws.position - jawNearness) ||
           (object_ == StoppedOpening && aim_ > jaws.position + jawNearness);
}

// What is led comes nearer to the jaws; what is to let go moves away from there. A demand for a
// firmer grip counts from where it means the whole force, so that the grip does not fade meanwhile.
bool WorldGripper::isLedBack(double wish, const JointState& jaws) {
    const double distance = std::abs(wish - jaws.position);
    if (presses(jaws) && distance <= jawNearness) {
        if (!isLed_ || distance < std::abs(ledTo_ - jaws.position)) ledTo_ = wish;
        isLed_ = true;
    }
    const double away = aim_ < ledTo_ ? wish - ledTo_ : ledTo_ - wish;
    isLed_ = isLed_ && away <= letGoWay && away >= -gripWay;
    return isLed_;
}

void WorldGripper::follow(const JointDemand& wish, bool isGood, const JointState& jaws) {
    speed_ = 0;
    if (!isGood || isLedBack(wish.position, jaws)) return;
    aim_ = wish.position;
    speed_ = wish.velocity;
    force_ = wish.effort;
}

JointDemand WorldGripper::demand(bool braked) const {
    return {aim_, braked ? 0 : speed_, force_, braked};
}

void WorldGripper::show(const JointState& jaws, double seconds) {
    rested_ += seconds;
    if (std::abs(jaws.position - place_) > jawWay) {
        place_ = jaws.position;
        rested_ = 0;
    }
    if (rested_ < jawRestTime)
        object_ = Moving;
    else if (std::abs(aim_ - jaws.position) <= jawNearness)
        object_ = AtDemand;
    else
        object_ = aim_ < jaws.position ? StoppedClosing : StoppedOpening;
}

}  // namespace cortex::physics
