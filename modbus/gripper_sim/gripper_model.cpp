// SPDX-License-Identifier: Apache-2.0
#include "gripper_sim/gripper_model.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::modbus::sim {
namespace {

constexpr std::uint8_t actionDelayed = 0x5, activationNeeded = 0x7, releasing = 0xB, released = 0xF;

constexpr std::uint8_t currentOfMotion = 12;      // in 10 mA, as the next
constexpr double currentPerNewton = 100.0 / 235;  // of fingers that press on something

}  // namespace

void GripperModel::powerCycle() {
    failure_ = 0;
    request({});
}

void GripperModel::step(double seconds) {
    isMoving_ = false;
    if (!request_.activate) {
        if (activation_ != RobotiqActivation::Reset) failure_ = 0;
        activation_ = RobotiqActivation::Reset;
        object_ = RobotiqObject::Moving;
        activated_ = 0;
        isReleasing_ = false;
        return;
    }
    if (activation_ != RobotiqActivation::Activated) return activate(seconds);
    if (request_.release || isReleasing_) return release(seconds);
    object_ = RobotiqObject::Moving;
    if (failure_ != 0 || !request_.goTo) return;
    const double limit = std::clamp<double>(request_.position, scale_.open, scale_.closed);
    move(scale_.width(limit), RobotiqScale::speedOf(request_.speed) * seconds);
}

// A third of the time each to open, to close and to open.
void GripperModel::activate(double seconds) {
    if (activation_ == RobotiqActivation::Reset) failure_ = 0;
    activation_ = RobotiqActivation::Activating;
    activated_ += seconds;
    const double way = scale_.stroke * 3 * seconds / activationTime_;
    const bool closes = std::floor(3 * activated_ / activationTime_) == 1;
    move(closes ? 0 : scale_.stroke, way);
    if (activated_ < activationTime_) return;
    activation_ = RobotiqActivation::Activated;
    isMoving_ = false;
}

// Once begun it goes on to its end, and only a reset helps.
void GripperModel::release(double seconds) {
    isReleasing_ = true;
    const bool isThere = move(scale_.stroke, RobotiqScale::slowest / 2 * seconds);
    failure_ = isThere ? released : releasing;
}

// True: it is there, or something is in the way.
bool GripperModel::move(double to, double way) {
    double reached = width_ + std::clamp(to - width_, -way, way);
    const bool meetsObject = object && width_ >= *object && to < *object && reached <= *object;
    const bool meetsRing = ring && width_ <= *ring && to > *ring && reached >= *ring;
    if (meetsObject) reached = *object;
    if (meetsRing) reached = *ring;
    width_ = reached;
    object_ = meetsObject    ? RobotiqObject::StoppedClosing
              : meetsRing    ? RobotiqObject::StoppedOpening
              : width_ == to ? RobotiqObject::AtDemand
                             : RobotiqObject::Moving;
    isMoving_ = object_ == RobotiqObject::Moving;
    return !isMoving_;
}

RobotiqStatus GripperModel::status() const {
    RobotiqStatus status;
    status.active = request_.activate;
    status.goesTo = request_.goTo;
    status.activation = activation_;
    const bool moves = activation_ == RobotiqActivation::Activated && request_.goTo;
    status.object = moves ? object_ : RobotiqObject::Moving;
    status.fault = failure_;
    if (failure_ == 0 && request_.goTo && activation_ != RobotiqActivation::Activated)
        status.fault = request_.activate ? actionDelayed : activationNeeded;
    status.positionEcho = request_.position;
    const double octet = scale_.closed - width_ / scale_.stroke * (scale_.closed - scale_.open);
    status.position = static_cast<std::uint8_t>(std::lround(octet));
    const bool holds = status.object == RobotiqObject::StoppedClosing ||
                       status.object == RobotiqObject::StoppedOpening;
    status.current = isMoving_ ? currentOfMotion : 0;
    if (holds)
        status.current = static_cast<std::uint8_t>(
            std::lround(RobotiqScale::forceOf(request_.force) * currentPerNewton));
    return status;
}

}  // namespace cortex::modbus::sim
