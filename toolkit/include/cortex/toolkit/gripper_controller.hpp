// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/toolkit/axis_controller.hpp"

#include <cstdint>
#include <string_view>

namespace cortex::toolkit {

// Opens and closes a gripper, and grips with a force. Positions are openings in m, forces are in N.
//   With a `status` the gripper limits the force itself: the demand goes to where it is told and
//   stays there, beyond a work piece too; its effort is the force. `object` is what the gripper
//   says once its demand has stood for 0.1 s.
//   Without one the controller watches position and effort of the axis. Jaws that stand and push
//   with the force have met something. From then on the demand is led: it is ahead of the jaws by
//   lead / (greatest effort) x (force - effort), smoothed over 0.05 s. The integral part of the
//   drive's own speed loop brings the effort to the force.
class GripperController : public AxisController {
public:
    using AxisController::AxisController;

protected:
    enum Object : std::int64_t { Moving, StoppedOpening, StoppedClosing, AtDemand, Lost };

    void populate() override;
    bool stateStartingUp(const Tick& tick) CORTEX_REALTIME override;
    void takeOver(const Tick& tick) CORTEX_REALTIME override;
    void move(const Tick& tick) CORTEX_REALTIME override;
    void loopEnd(const Tick& tick) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

private:
    // Presses: the jaws have met something, and the effort is brought to the force. Holds: the
    // effort is there, or as near as it comes.
    enum class Phase : std::uint8_t { Moves, Presses, Holds };

    // How something stays: for how long it has been within some distance of where it was.
    struct Steadiness {
        double reference = 0, seconds = 0;
        void update(double value, double distance, double elapsed) CORTEX_REALTIME;
        void keep(Archive& archive) { archive & reference & seconds; }
    };
    struct Wish {
        double width, speed, force;
        void keep(Archive& archive) { archive & width & speed & force; }
    };

    // gripper_commands.cpp
    void bindCommands();
    Outcome open(Call& call) CORTEX_REALTIME;
    Outcome close(Call& call) CORTEX_REALTIME;
    Outcome moveTo(Call& call) CORTEX_REALTIME;
    Outcome grip(Call& call) CORTEX_REALTIME;
    Outcome run(Call& call, Wish wish) CORTEX_REALTIME;
    Outcome proceed(Call& call) CORTEX_REALTIME;
    bool accepts(Call& call, const Wish& wish) const CORTEX_REALTIME;
    bool isWithin(Call& call, std::string_view item, double value, double min, double max) const
        CORTEX_REALTIME;

    // False where that cannot be planned.
    bool begin(const Wish& wish) CORTEX_REALTIME;
    bool plan() CORTEX_REALTIME;
    void stop() CORTEX_REALTIME;
    double approachSpeed(double force) const CORTEX_REALTIME;
    void tell(std::int64_t object) CORTEX_REALTIME;
    EventText whyNotHeld() const CORTEX_REALTIME;  // empty: it is held
    bool hasArrived() const { return time_ >= profile_.duration(); }
    bool isNear() const CORTEX_REALTIME;
    bool hasForce() const CORTEX_REALTIME;
    double pushed() const CORTEX_REALTIME { return direction_ * effort_; }
    void tellAsStatus(double seconds) CORTEX_REALTIME;
    void watch(double seconds) CORTEX_REALTIME;
    bool meetsSomething() CORTEX_REALTIME;
    void beginToPress() CORTEX_REALTIME;
    void press(double seconds) CORTEX_REALTIME;
    void watchPressing(double seconds) CORTEX_REALTIME;

    Data<const double> position_, effort_, lead_;
    Data<const std::int64_t> status_;
    Data<double> demandEffort_, width_, force_, progress_;
    Data<std::int64_t> object_;
    Argument<double> openSpeed_, closeForce_, moveWidth_, moveSpeed_, moveForce_, gripForce_;
    Result<double> gripped_;
    double closed_ = 0, opened_ = 0;  // ends of the range
    double leastForce_ = 0, mostForce_ = 0;

    mechanics::Profile profile_;
    Wish wish_{};
    double time_ = 0;       // s, since the profile began
    double direction_ = 0;  // of the motion: 1 opens, -1 closes; 0: none was commanded
    Phase phase_ = Phase::Moves;
    bool aims_ = false;
    bool wasLost_ = false;        // an input, since move() was called last
    double rested_ = 0;           // s, for which the status says that the jaws stand
    Steadiness jaws_, pressure_;  // of the position, and of the effort
    double ahead_ = 0;            // m, of the demand while pressing
    double metAt_ = 0;            // opening at which the jaws met something, or hold it
    bool holds_ = false;          // a work piece, until it is lost or somebody commands anew
};

}  // namespace cortex::toolkit
