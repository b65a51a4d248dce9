// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gripper/robotiq_registers.hpp"

#include <cstdint>
#include <optional>

namespace cortex::modbus::sim {

// A Robotiq 2F-85 without a wire: what it makes of its requests, in the time that step() is told.
// Widths are openings in m. Nothing here was measured at a real one.
class GripperModel {
public:
    // Seconds from rACT to activated; the fingers open, close and open meanwhile.
    explicit GripperModel(double activationTime = 1) : activationTime_{activationTime} {}

    // A work piece that fingers which close meet at this width, and one around them that they meet
    // when they open. Nothing is met that they are beyond already.
    std::optional<double> object, ring;

    void request(const RobotiqRequest& request) {
        request_ = request;
        step(0);  // a reset between two steps is one, too
    }
    const RobotiqRequest& request() const { return request_; }
    void fail(std::uint8_t code) { failure_ = code; }  // until the next activation
    void powerCycle();  // all is reset; the fingers stay where they are
    void step(double seconds);

    RobotiqStatus status() const;
    double width() const { return width_; }

private:
    void activate(double seconds);
    void release(double seconds);
    bool move(double to, double way);

    static constexpr RobotiqScale scale_{};
    double activationTime_;
    RobotiqRequest request_;
    RobotiqActivation activation_ = RobotiqActivation::Reset;
    RobotiqObject object_ = RobotiqObject::Moving;
    double width_ = scale_.stroke, activated_ = 0;  // activated_: s since rACT
    bool isMoving_ = false, isReleasing_ = false;
    std::uint8_t failure_ = 0;
};

}  // namespace cortex::modbus::sim
