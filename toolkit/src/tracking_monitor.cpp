// SPDX-License-Identifier: Apache-2.0
#include "tracking_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cortex::toolkit {

void TrackingMonitor::populate() {
    hand_ = PoseInput{input("hand")};
    tip_ = PoseInput{input("tip")};
    enable_ = Enable{input("enable"), {hand_.state, tip_.state}};
    processorState_ = input("processor").data<std::int64_t>("state");
    for (const InputSimplex& clutch : inputs("clutch")) engaged_ = clutch.data<bool>("engaged");
    rmsPosition_ = data<double>("rmsPosition");
    maxPosition_ = data<double>("maxPosition");
    rmsRotation_ = data<double>("rmsRotation");
    maxRotation_ = data<double>("maxRotation");
    lag_ = data<double>("lag");
    rmsSpeed_ = data<double>("rmsSpeed");
    time_ = data<double>("time");
    pressCount_ = data<std::int64_t>("pressCount");
}

void TrackingMonitor::stateActive(const Tick& tick) {
    const bool isLed = !engaged_.bound() || engaged_;
    const bool pressed = enable_.update(inputLost()) && isLed;
    if (pressed && !pressed_) {
        handThen_ = hand_.pose();
        tipThen_ = tip_.pose();
        pressCount_ += 1;
    }
    pressed_ = pressed;
    if (pressed_ && processorState_ == static_cast<std::int64_t>(State::Active)) {
        measure(tick.elapsedSeconds());
        publish();
    }
}

void TrackingMonitor::measure(double seconds) {
    const Pose hand = hand_.pose();
    const Pose tip = tip_.pose();
    const Pose handMotion{hand.position - handThen_.position,
                          hand.rotation * handThen_.rotation.conjugate()};
    const Pose tipMotion{tip.position - tipThen_.position,
                         tip.rotation * tipThen_.rotation.conjugate()};
    const Twist error = difference(handMotion, tipMotion);
    const Eigen::Vector3d velocity = hand_.velocity().head<3>();
    const double distance = error.head<3>().norm() * 1e3;
    const double angle = error.tail<3>().norm() * 180 / std::numbers::pi;
    squaredDistance_ += distance * distance * seconds;
    squaredAngle_ += angle * angle * seconds;
    squaredSpeed_ += velocity.squaredNorm() * seconds;
    behind_ -= error.head<3>().dot(velocity) * seconds;
    measured_ += seconds;
    maxPosition_ = std::max(maxPosition_.get(), distance);
    maxRotation_ = std::max(maxRotation_.get(), angle);
}

// The lag is the delay t that makes the sum of (error + t * velocity)^2 least.
void TrackingMonitor::publish() {
    rmsPosition_ = std::sqrt(squaredDistance_ / measured_);
    rmsRotation_ = std::sqrt(squaredAngle_ / measured_);
    rmsSpeed_ = std::sqrt(squaredSpeed_ / measured_);
    lag_ = squaredSpeed_ > 0 ? behind_ / squaredSpeed_ * 1e3 : 0;
    time_ = measured_;
}

void TrackingMonitor::keep(Archive& archive) {
    archive.version("TrackingMonitor", 1);
    archive & enable_ & pressed_;
    for (Pose* pose : {&handThen_, &tipThen_}) toolkit::keep(archive, *pose);
    archive & squaredDistance_ & squaredAngle_ & squaredSpeed_ & behind_ & measured_;
}

}  // namespace cortex::toolkit
