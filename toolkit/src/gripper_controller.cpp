// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/gripper_controller.hpp"

#include "cortex/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::toolkit {

using mechanics::MotionLimits;
using mechanics::MotionState;

namespace {

constexpr double unstatedEffort = 100;     // N, of an axis that states no greatest effort
constexpr double leastShare = 0.05;        // of the greatest effort: the least force
constexpr double overFriction = 2;         // the least force, as a multiple of the axis' friction
constexpr double jawStandstill = 5e-5;     // m, within which jaws stand
constexpr double contactTime = 0.005;      // s for which they stand where they push enough
constexpr double jawPatience = 0.1;        // s for which they stand elsewhere than they should
constexpr double nearness = 5e-4;          // m between jaws and target: nothing is in the way
constexpr double giveWay = 2e-3;           // m by which a work piece may give way
constexpr double statusTime = 0.1;         // s that a gripper has to notice its demand
constexpr double restTime = 0.05;          // s
constexpr double leadTime = 0.05;          // s, of the smoothing
constexpr double leadCycles = 10;          // at least, of the smoothing
constexpr double mostLead = 2;             // of `lead`, that the demand is ahead
constexpr double leastApproach = 1.0 / 8;  // of `lead`: way in which the demand stops
constexpr double forceBand = 0.1;          // of the force: it is there
constexpr double steadyBand = 0.02;        // of the force: it changes no more
constexpr double steadyTime = 0.5;         // s without a change, though the force is not there

}  // namespace

void GripperController::Steadiness::update(double value, double distance, double elapsed) {
    seconds += elapsed;
    if (std::abs(value - reference) <= distance) return;
    reference = value;
    seconds = 0;
}

void GripperController::populate() {
    AxisController::populate();
    if (!std::isfinite(limits(0).max))
        throw Error(path() + ": how far " + demandPath(0) +
                    " opens is not known: state position.max in its type");
    const InputSimplex axis = input("axes");
    position_ = axis.data<double>("position");
    effort_ = axis.data<double>("effort");
    for (const InputSimplex& status : inputs("status"))
        status_ = status.data<std::int64_t>("object");
    demandEffort_ = output("demands").data<double>("effort");
    lead_ = data<const double>("lead");
    width_ = data<double>("width");
    force_ = data<double>("force");
    object_ = data<std::int64_t>("object");
    progress_ = data<double>("progress");
    opened_ = limits(0).max;
    closed_ = std::isfinite(limits(0).min) ? limits(0).min : std::min(0.0, opened_);
    mostForce_ = std::isfinite(limits(0).effort) ? limits(0).effort : unstatedEffort;
    const double friction = axis.data<double>("friction");
    leastForce_ = std::min(std::max(leastShare * mostForce_, overFriction * friction), mostForce_);
    bindCommands();
}

bool GripperController::stateStartingUp(const Tick& tick) {
    aims_ = false;
    return AxisController::stateStartingUp(tick);
}

// --- motion -----------------------------------------------------------------------------------

// The speed from which the demand stops within the way by which it leads for this force. From v to
// rest it takes v^1.5 / sqrt(J) without reaching A, else v^2 / (2 A) + v A / (2 J).
double GripperController::approachSpeed(double force) const {
    const MotionLimits most = limits(0).motion();
    const double way = lead_ * std::max(leastApproach, force / mostForce_);
    const double ramp = most.acceleration * most.acceleration / most.jerk;
    const double gently = std::cbrt(way * way * most.jerk);
    if (gently <= ramp) return gently;
    return (std::sqrt(ramp * ramp + 8 * most.acceleration * way) - ramp) / 2;
}

bool GripperController::plan() {
    MotionLimits most = limits(0).motion();
    most.velocity = std::min(most.velocity, wish_.speed);
    if (!status_.bound()) most.velocity = std::min(most.velocity, approachSpeed(wish_.force));
    const auto way = mechanics::planPosition(demands()[0], wish_.width, most);
    if (!way) return false;
    profile_ = *way;
    time_ = rested_ = 0;
    phase_ = Phase::Moves;
    return true;
}

bool GripperController::begin(const Wish& wish) {
    wish_ = wish;
    direction_ = wish.width > position_ ? 1 : -1;
    force_ = wish.force;
    object_ = Moving;
    holds_ = false;
    aims_ = true;
    return plan();
}

void GripperController::stop() {
    const MotionState& now = demands()[0];
    profile_ = mechanics::planVelocity(now, 0, limits(0).motion())
                   .value_or(mechanics::Profile::standing({now.position, 0, 0}));
    wish_.width = profile_.end().position;
    time_ = 0;
    phase_ = Phase::Moves;
    if (status_.bound() && !follows(0)) return;  // the demand is led back to it, cycle by cycle
    rested_ = 0;
    if (object_ != Lost) tell(Moving);
}

// What limits took away is made up for; after a loss somebody has to command anew.
void GripperController::takeOver(const Tick&) {
    if (aims_ && (phase_ != Phase::Moves || plan())) return;
    stop();
    direction_ = 0;
}

void GripperController::move(const Tick& tick) {
    const double seconds = tick.elapsedSeconds();
    if (phase_ == Phase::Moves && wasLost_) {  // somebody has to command anew
        stop();
        direction_ = 0;
    }
    if (phase_ == Phase::Holds && wasLost_) {  // it presses on, and looks anew at what is there
        phase_ = Phase::Presses;
        pressure_ = {pushed(), 0};
    }
    wasLost_ = false;
    if (phase_ == Phase::Moves) {
        if (!hasArrived()) time_ += seconds;
        demands()[0] = profile_.at(time_);
    } else {
        press(seconds);
    }
    if (status_.bound())
        tellAsStatus(seconds);
    else
        watch(seconds);
}

// Also where it is not Active, or the axis is lost.
void GripperController::loopEnd(const Tick&) {
    width_ = position_.get();
    wasLost_ = wasLost_ || inputLost();
    if (inputLost() || !follows(0)) aims_ = false;
    if (!holds_) return;
    const EventText why = whyNotHeld();
    if (why.view().empty()) return;
    holds_ = false;
    object_ = Lost;
    event(Severity::Error, why);
}

// --- what is between the jaws -----------------------------------------------------------------

// A work piece that rocks between the jaws moves them a little, and is not lost.
void GripperController::tell(std::int64_t object) {
    object_ = object;
    if (object == StoppedOpening || object == StoppedClosing) {
        if (!holds_) metAt_ = position_;
        holds_ = true;
    }
    if (!holds_ || (object != AtDemand && std::abs(position_ - metAt_) <= giveWay)) return;
    holds_ = false;
    event(Severity::Error,
          EventText{"the work piece was lost at an opening of "} << position_.get() << " m");
}

// A gripper with a status holds by itself, also with its brake on.
EventText GripperController::whyNotHeld() const {
    constexpr std::string_view noMore = "the force on the work piece is kept no more: ",
                               unknown = "whether the work piece is still held is not known: ";
    if (inputLost()) return EventText{unknown} << "the gripper is lost";
    const bool byItself = status_.bound();
    if (!follows(0) && !(byItself && isBraked(0)))
        return EventText{byItself ? unknown : noMore} << doesNotFollow(0).view();
    if (!byItself && state() != State::Active)
        return EventText{noMore} << "this controller is not Active";
    return {};
}

bool GripperController::isNear() const { return std::abs(wish_.width - position_) <= nearness; }

bool GripperController::hasForce() const {
    return std::abs(pushed() - wish_.force) <= forceBand * wish_.force;
}

void GripperController::tellAsStatus(double seconds) {
    demandEffort_ = force_.get();
    const bool mayRest = hasArrived() || !follows(0);
    rested_ = mayRest && status_ != Moving ? rested_ + seconds : 0;
    const bool isKnown = follows(0) || isBraked(0);
    if (isKnown || object_ != Lost) tell(rested_ >= statusTime ? status_.get() : Moving);
}

void GripperController::watch(double seconds) {
    jaws_.update(position_, jawStandstill, seconds);
    if (phase_ != Phase::Moves) {
        watchPressing(seconds);
    } else if (meetsSomething()) {
        beginToPress();
    } else if (hasArrived() && isNear() && jaws_.seconds >= restTime && object_ != Lost) {
        tell(AtDemand);
    }
}

// Without a command nothing is pressed: the axis keeps its place, as any does.
bool GripperController::meetsSomething() {
    if (direction_ == 0 || jaws_.seconds < contactTime) return false;
    if (pushed() >= wish_.force) return true;
    const double ahead = direction_ * (demands()[0].position - position_);
    const bool behind = hasArrived() ? !isNear() : ahead > mostLead * lead_;
    return behind && jaws_.seconds >= jawPatience;
}

void GripperController::beginToPress() {
    phase_ = Phase::Presses;
    metAt_ = position_;
    ahead_ = 0;
    pressure_ = {pushed(), 0};
}

void GripperController::press(double seconds) {
    const double most = mostLead * lead_;
    const double wished = lead_ / mostForce_ * (wish_.force - pushed());
    const double share = std::min(1.0, seconds / std::max(leadTime, leadCycles * seconds));
    ahead_ += (std::clamp(wished, -most, most) - ahead_) * share;
    const double aim = std::clamp(position_ + direction_ * ahead_, limits(0).min, limits(0).max);
    MotionState& demand = demands()[0];
    const auto way = mechanics::planPosition(demand, aim, limits(0).motion());
    demand = way ? way->at(seconds) : MotionState{demand.position, 0, 0};
}

// Where it gives way by more than a work piece may, the jaws go on to where they were to go.
void GripperController::watchPressing(double seconds) {
    pressure_.update(pushed(), steadyBand * wish_.force, seconds);
    if (direction_ * (position_ - metAt_) > giveWay) {
        tell(Moving);
        if (!plan()) stop();
        return;
    }
    if (phase_ == Phase::Holds || pressure_.seconds < (hasForce() ? restTime : steadyTime)) return;
    phase_ = Phase::Holds;
    metAt_ = position_;
    if (isNear())
        tell(AtDemand);
    else
        tell(direction_ > 0 ? StoppedOpening : StoppedClosing);
}

void GripperController::keep(Archive& archive) {
    AxisController::keep(archive);
    archive.version("GripperController", 1);
    archive & profile_ & wish_ & time_ & direction_ & phase_ & aims_ & wasLost_ & rested_;
    archive & jaws_ & pressure_ & ahead_ & metAt_ & holds_;
}

}  // namespace cortex::toolkit
