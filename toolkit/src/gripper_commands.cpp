// SPDX-License-Identifier: Apache-2.0
// The commands of a GripperController.
#include "cortex/toolkit/gripper_controller.hpp"

#include <algorithm>

namespace cortex::toolkit {

namespace {

constexpr double speedOfItsAxis = 1000;  // m/s; that of the axis counts

}  // namespace

void GripperController::bindCommands() {
    openSpeed_ = argument<double>("open", "speed");
    closeForce_ = argument<double>("close", "force");
    moveWidth_ = argument<double>("moveTo", "width");
    moveSpeed_ = argument<double>("moveTo", "speed");
    moveForce_ = argument<double>("moveTo", "force");
    gripForce_ = argument<double>("grip", "force");
    gripped_ = result<double>("grip", "width");
    on<&GripperController::open>("open");
    on<&GripperController::close>("close");
    on<&GripperController::moveTo>("moveTo");
    on<&GripperController::grip>("grip");
}

bool GripperController::isWithin(Call& call, std::string_view item, double value, double min,
                                 double max) const {
    if (value >= min && value <= max) return true;
    const double limit = value < min ? min : max;
    EventText why{item};
    why << " is ";
    why.apart(value, limit) << (value < min ? ", below " : ", above ");
    why.apart(limit, value) << ", the limit of " << demandPath(0);
    call.reject(Reason::Range, why.view());
    return false;
}

bool GripperController::accepts(Call& call, const Wish& wish) const {
    return allFollow(call) && isWithin(call, "width", wish.width, closed_, opened_) &&
           isWithin(call, "force", wish.force, 0, mostForce_);
}

// The least force is that of the axis where the controller limits it, else that of the gripper.
Outcome GripperController::run(Call& call, Wish wish) {
    if (call.first()) {
        if (inputLost()) {
            call.reject(Reason::State, "the gripper is lost: command it when it is back");
            return Outcome::Rejected;
        }
        if (!accepts(call, wish)) return Outcome::Rejected;
        if (!status_.bound()) wish.force = std::max(wish.force, leastForce_);
        if (!begin(wish)) return call.fail("no motion leads to this opening");
    }
    return proceed(call);
}

// A cancelled motion ends; what is held stays held.
Outcome GripperController::proceed(Call& call) {
    if (call.cancelling()) {
        if (phase_ == Phase::Moves) stop();
        return Outcome::Cancelled;
    }
    if (!follows(0)) return call.fail(doesNotFollow(0).view());
    progress_ = hasArrived() || object_ != Moving ? 1.0 : time_ / profile_.duration();
    return object_ == Moving ? Outcome::Running : Outcome::Done;
}

// What a gripper with a status holds is pressed no more than before while its demand comes back.
Outcome GripperController::open(Call& call) {
    const double force = status_.bound() ? force_.get() : mostForce_;
    return run(call, {opened_, call[openSpeed_], force});
}

Outcome GripperController::close(Call& call) {
    return run(call, {closed_, speedOfItsAxis, call[closeForce_]});
}

Outcome GripperController::moveTo(Call& call) {
    return run(call, {call[moveWidth_], call[moveSpeed_], call[moveForce_]});
}

Outcome GripperController::grip(Call& call) {
    const Outcome outcome = run(call, {closed_, speedOfItsAxis, call[gripForce_]});
    if (outcome != Outcome::Done) return outcome;
    if (object_ != StoppedClosing)
        return call.fail("the jaws have closed, and nothing is between them");
    if (!status_.bound() && !hasForce()) {
        EventText why{"the jaws stand, and their force is "};
        why << pushed() << " N, not " << wish_.force << " N";
        return call.fail(why.view());
    }
    call[gripped_] = position_.get();
    return Outcome::Done;
}

}  // namespace cortex::toolkit
