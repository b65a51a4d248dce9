// SPDX-License-Identifier: Apache-2.0
#include "ds402/processor_axis.hpp"

#include "cortex/core/error.hpp"

#include "ds402/drive_words.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cortex::toolkit {

using Aim = TransitionLead::Aim;

namespace {

constexpr double standingSpeed = 0.01;     // rad/s or m/s, below which an axis stands
constexpr double patienceWithDemands = 1;  // s

}  // namespace

Ds402ProcessorAxis::Ds402ProcessorAxis(int number, const Links& links, const Ds402Items& items)
    : number_{number},
      items_{items},
      driveSlot_{&links.drive.state()},
      demandPath_{links.demand.path()},
      limits_{links.demand.type()} {
    const InputSimplex& drive = links.drive;
    statusWord_ = drive.data<std::int64_t>("statusWord");
    driveState_ = drive.data<std::int64_t>("driveState");
    modeDisplay_ = drive.data<std::int64_t>("modeDisplay");
    errorCode_ = drive.data<std::int64_t>("errorCode");
    position_ = drive.data<double>("position");
    velocity_ = drive.data<double>("velocity");
    homed_ = drive.data<bool>("homed");
    homingNeeded_ = drive.data<bool>("homingNeeded");
    countsPerUnit_ = drive.data<double>("countsPerUnit");
    demandPosition_ = links.demand.data<double>("position");
    demandVelocity_ = links.demand.data<double>("velocity");
    demandAcceleration_ = links.demand.data<double>("acceleration");
    demandEffort_ = links.demand.data<double>("effort");
    const OutputSimplex& setpoint = links.setpoint;
    controlWord_ = setpoint.data<std::int64_t>("controlWord");
    mode_ = setpoint.data<std::int64_t>("mode");
    targetPosition_ = setpoint.data<double>("position");
    targetVelocity_ = setpoint.data<double>("velocity");
    targetAcceleration_ = setpoint.data<double>("acceleration");
    targetEffort_ = setpoint.data<double>("effort");
    homingMethod_ = setpoint.data<std::int64_t>("homingMethod");
    homingSpeed_ = setpoint.data<double>("homingSpeed");
    homingCreep_ = setpoint.data<double>("homingCreep");
    homeOffset_ = setpoint.data<double>("homeOffset");
    quickStopOption_ = setpoint.data<std::int64_t>("quickStopOption");
    faultReactionOption_ = setpoint.data<std::int64_t>("faultReactionOption");
    waits_ = setpoint.data<bool>("waits");
    followMode_ = mode_;
    if (drives::isBuilt(static_cast<int>(followMode_)) && followMode_ != ds402HomingMode) return;
    throw Error(setpoint.path() + ": mode " + std::to_string(followMode_) +
                " is none to begin with: " + "set 1, 3, 8, 9 or 10");
}

// --- what the drive says ------------------------------------------------------------------------

Ds402ProcessorAxis::Found Ds402ProcessorAxis::observe() {
    const std::int64_t word = statusWord_;
    const State told = drives::stateOf(statusWord());
    const bool everTold = driveState_ != 0;
    if (everTold && told == State::Unknown && word != lastWord_) ++items_.unknownCount[place()];
    lastWord_ = word;
    if (!everTold || told == State::Unknown || told == state_) return std::nullopt;
    const State before = std::exchange(state_, told);
    const bool wasFaulty = before == State::Fault || before == State::FaultReactionActive;
    if (before == State::Fault) resetsAtStart_ = false;
    if (before == State::Unknown) return std::nullopt;
    ++items_.transitionCount[place()];
    items_.lastTransition[place()] =
        transitionBetween(static_cast<int>(before), static_cast<int>(state_));
    if (wasFaulty || !isFaulty() || lead_.hasArrived()) return std::nullopt;
    return Finding{0, name() << " reports " << errorOfDrive().view()};
}

bool Ds402ProcessorAxis::stands() const { return std::abs(velocity_.get()) < standingSpeed; }

// The own handle reads what went out in the cycle before, which a rate may keep behind.
bool Ds402ProcessorAxis::targetsThere() const {
    return std::abs(targetPosition_ - position_) <= AxisTargets::tolerance;
}

// Enabled, in the mode that is wished, and the drive follows its targets.
bool Ds402ProcessorAxis::takesTargets() const {
    const bool cyclic = followMode_ >= static_cast<int>(drives::Ds402Mode::CyclicPosition);
    const bool follows = !cyclic || (statusWord() & drives::Ds402Status::follows) != 0;
    return lead_.hasArrived() && state_ == State::OperationEnabled && !homing_.runs() &&
           modeDisplay_ == followMode_ && follows;
}

// It cannot move by position before, so its demand may be anywhere.
bool Ds402ProcessorAxis::awaitsHoming() const {
    return AxisTargets::isOfPosition(static_cast<int>(followMode_)) && !isHomed();
}

// No demand can come to where the axis is. Where that is, is known once it is homed.
bool Ds402ProcessorAxis::isOutOfReach(std::int64_t mode) const {
    const double allowed = std::clamp<double>(position_, limits_.min, limits_.max);
    return AxisTargets::isOfPosition(static_cast<int>(mode)) && state_ != State::Unknown &&
           isHomed() && std::abs(position_ - allowed) > AxisTargets::tolerance;
}

EventText Ds402ProcessorAxis::outOfReach() const {
    EventText text = name() << " stands at " << position_.get() << ", outside of " << limits_.min
                            << " to " << limits_.max << " of " << demandPath_;
    return text << ": jog it back " << (homingNeeded_ ? "or home it " : "") << "in CyclicVelocity";
}

EventText Ds402ProcessorAxis::name() const { return EventText{"axis "} << number_; }

EventText Ds402ProcessorAxis::errorOfDrive() const {
    return errorCode_ != 0 ? errorWords(errorCode_) : EventText{"a fault without a code"};
}

EventText Ds402ProcessorAxis::inState() const {
    EventText text = name() << " is in " << nameOf(state_);
    return isFaulty() ? text << ": " << errorOfDrive().view() : text;
}

// --- words and targets --------------------------------------------------------------------------

std::int64_t Ds402ProcessorAxis::wishedMode() const {
    return homing_.wantsMode() ? ds402HomingMode : followMode_;
}

AxisTarget Ds402ProcessorAxis::demand() const {
    return {demandPosition_, demandVelocity_, demandAcceleration_, demandEffort_};
}

Ds402ProcessorAxis::Finding Ds402ProcessorAxis::refused() {
    if (isLost()) {
        return {Ds402Faults::refused + number_,
                name() << ": its drive is lost; it was in " << nameOf(state_)};
    }
    ++items_.refusedCount[place()];
    if (isFaulty()) return {Ds402Faults::leftEnabled + number_, inState()};
    EventText text = name() << ": wanted " << nameOf(lead_.next()) << ", is " << nameOf(state_);
    if (state_ == State::SwitchedOn && modeDisplay_ != wishedMode()) {
        text << "; its mode is " << modeWords(modeDisplay_).view() << ", not "
             << modeWords(wishedMode()).view();
    }
    return {Ds402Faults::refused + number_, text};
}

double Ds402ProcessorAxis::demandAway() const {
    return targets_.away(demand(), static_cast<int>(followMode_));
}

bool Ds402ProcessorAxis::mayJoin() const {
    return targets_.mayJoin(demand(), static_cast<int>(followMode_));
}

bool Ds402ProcessorAxis::demandIsThere() const {
    return mayJoin() && std::abs(demandVelocity_.get()) <= AxisTargets::tolerance;
}

// Torque comes on where target and demand stand at the axis: until then its controller leads the
// demand there.
Ds402ProcessorAxis::Found Ds402ProcessorAxis::lead(double seconds, double timeout) {
    targets_.see(demand(), seconds);
    waits_ = true;  // unless write() knows better
    const bool there = targetsThere() && (awaitsHoming() || demandIsThere());
    const TransitionLead::Seen seen{state_, stands(), modeDisplay_ == wishedMode(), there,
                                    quickStopOption_};
    const auto course = lead_.advance(seen, seconds, timeout);
    controlWord_ = lead_.word();
    if (course != TransitionLead::Course::Refused) return std::nullopt;
    return refused();
}

void Ds402ProcessorAxis::powerOff() {
    homing_.abort(AxisHoming::Result::Stopped);
    if (lead_.aim() != Aim::Reset) lead_.aimAt(Aim::PowerOff);
}

void Ds402ProcessorAxis::beginStartup() {
    homing_.abort(AxisHoming::Result::Stopped);
    targets_.standAt(position_);
    lead_.aimAt(Aim::Enable, resetsAtStart_);
    waited_ = driveWaited_ = 0;
}

bool Ds402ProcessorAxis::isReady() const { return takesTargets() && (awaitsHoming() || mayJoin()); }

bool Ds402ProcessorAxis::isOff() const {
    return state_ == State::SwitchOnDisabled || state_ == State::NotReadyToSwitchOn ||
           state_ == State::Fault || state_ == State::Unknown;
}

Ds402ProcessorAxis::Finding Ds402ProcessorAxis::leftUnasked() {
    const EventText error = errorOfDrive();
    EventText text = name();
    if (isFaulty())
        text << ": " << error.view();
    else
        text << " left Operation enabled: " << nameOf(state_);
    lead_.aimAt(Aim::PowerOff);
    return {Ds402Faults::leftEnabled + number_, text};
}

// A demand that comes nearer is on its way. Told once, until the wait is over.
Ds402ProcessorAxis::Found Ds402ProcessorAxis::waitForDemand(bool waits, double seconds) {
    if (!waits) waited_ = 0;
    if (!waits || waited_ > patienceWithDemands) return std::nullopt;
    const double away = demandAway();
    if (waited_ == 0 || away < nearest_) {
        nearest_ = away;
        waited_ = 0;
    }
    waited_ += seconds;
    if (waited_ <= patienceWithDemands) return std::nullopt;
    if (isOutOfReach(followMode_)) return Finding{0, outOfReach()};
    EventText text = name() << " waits for its demand, which ";
    if (away > AxisTargets::tolerance)
        text << "is " << away << " away: bring it to the axis";
    else
        text << "moves: let it rest";
    return Finding{0, text};
}

Ds402ProcessorAxis::Found Ds402ProcessorAxis::startUp(double seconds, double timeout) {
    if (isLeftUnasked()) return leftUnasked();
    if (isOutOfReach(followMode_)) return Finding{Ds402Faults::outOfReach + number_, outOfReach()};
    Found found = lead(seconds, timeout);
    if (!found) found = waitForDrive(seconds, timeout);
    if (found && found->code == 0) found->code = Ds402Faults::refused + number_;
    if (!takesTargets()) targets_.standAt(position_);
    const bool there = lead_.hasArrived() ? !takesTargets() || mayJoin() : demandIsThere();
    if (!found) found = waitForDemand(!there && !awaitsHoming(), seconds);
    write();
    return found;
}

// An enabled axis that does not take targets: it is in another mode, or does not follow them.
Ds402ProcessorAxis::Found Ds402ProcessorAxis::waitForDrive(double seconds, double timeout) {
    const bool waits = lead_.hasArrived() && !homing_.runs() && !takesTargets();
    const double before = driveWaited_;
    driveWaited_ = waits ? before + seconds : 0;
    if (before > timeout || driveWaited_ <= timeout) return std::nullopt;
    ++items_.refusedCount[place()];
    EventText text = name();
    if (modeDisplay_ == followMode_)
        return Finding{0, text << ": is enabled and does not follow its targets (bit 12)"};
    text << ": wanted the mode " << modeWords(followMode_).view() << ", it is "
         << modeWords(modeDisplay_).view();
    const auto display = static_cast<int>(modeDisplay_.get());
    if (drives::isBuilt(display) && display != ds402HomingMode) followMode_ = display;
    return Finding{0, text};
}

// A controller leads its demand to an axis that is NotHomed. The mode in which the axis would
// follow comes back when the demand is there, or when it has stood elsewhere for a second.
void Ds402ProcessorAxis::proceedWithHoming(double seconds, double timeout) {
    if (!homing_.runs()) return;
    const bool rests = std::abs(demandVelocity_.get()) < standingSpeed;
    demandRested_ = rests ? demandRested_ + seconds : 0;
    const bool moves = !demandIsThere() && demandRested_ < patienceWithDemands;
    homing_.advance({static_cast<int>(modeDisplay_.get()), static_cast<int>(followMode_),
                     drives::homingOf(statusWord()), stands(), targetsThere(), moves},
                    seconds, timeout);
}

Ds402ProcessorAxis::Found Ds402ProcessorAxis::follow(double seconds, double timeout) {
    if (isLeftUnasked()) return leftUnasked();
    Found found = lead(seconds, timeout);
    if (found) found->code = 0;  // the other axis goes on
    if (!found) found = waitForDrive(seconds, timeout);
    const auto display = static_cast<int>(modeDisplay_.get());
    proceedWithHoming(seconds, timeout);
    bool waits = false;
    if (!takesTargets()) {
        targets_.standAt(position_);
        const bool enables = lead_.aim() == Aim::Enable && !lead_.hasArrived();
        waits = enables && !demandIsThere();
    } else {
        const auto course = targets_.follow(demand(), display, isHomed(), position_, seconds);
        waits = course == AxisTargets::Course::Waits;
        if (course == AxisTargets::Course::NotHomed)
            found = Finding{Ds402Faults::notHomed + number_, name() << " is to move and not homed"};
    }
    if (!found) found = waitForDemand(waits && !awaitsHoming(), seconds);
    write();
    return found;
}

// All that goes out, in each cycle: a demand that hooks move is theirs as a whole.
void Ds402ProcessorAxis::write() {
    std::uint16_t word = lead_.word();
    const bool byProfile = modeDisplay_ == static_cast<int>(drives::Ds402Mode::ProfilePosition);
    if (state_ == State::OperationEnabled && lead_.hasArrived()) {
        if (homing_.startBit()) word |= drives::Ds402Control::startHoming;
        const bool taken = (statusWord() & drives::Ds402Status::setPointTaken) != 0;
        if (byProfile && targets_.follows()) word |= targets_.setPointBits(taken);
    }
    controlWord_ = word;
    mode_ = wishedMode();
    waits_ = !takesTargets() || !targets_.follows();
    const AxisTarget& target = targets_.target();
    targetPosition_ = target.position;
    targetVelocity_ = target.velocity;
    targetAcceleration_ = target.acceleration;
    targetEffort_ = target.effort;
    homingMethod_ = items_.homingMethod[place()];
    homingSpeed_ = items_.homingSpeed[place()];
    homingCreep_ = items_.homingCreep[place()];
    homeOffset_ = items_.homeOffset[place()];
    quickStopOption_ = items_.quickStopOption[place()];
    faultReactionOption_ = items_.faultReactionOption[place()];
}

void Ds402ProcessorAxis::tell() {
    items_.wanted[place()] = static_cast<std::int64_t>(lead_.wanted(quickStopOption_));
    items_.driveState[place()] = static_cast<std::int64_t>(state_);
    items_.mode[place()] = modeDisplay_;
    items_.homed[place()] = isHomed();
    const std::int64_t error = errorCode_;
    if (items_.errorCode[place()] == error) return;
    items_.errorCode[place()] = error;
    if (error == 0)
        items_.errorText[place()] = std::string_view{};
    else
        items_.errorText[place()] = errorOfDrive().view();
}

void Ds402ProcessorAxis::keep(Archive& archive) {
    archive & lead_ & targets_ & homing_ & state_ & followMode_ & lastWord_ & resetsAtStart_ &
        waited_ & nearest_ & driveWaited_ & demandRested_;
}

}  // namespace cortex::toolkit
