// SPDX-License-Identifier: Apache-2.0
// What commands ask of one axis, and why not.
#include "ds402/drive_words.hpp"
#include "ds402/processor_axis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace cortex::toolkit {

bool Ds402ProcessorAxis::isHoming(EventText& why) const {
    if (homing_.runs()) why = name() << " is homing: cancel that first";
    return homing_.runs();
}

bool Ds402ProcessorAxis::mayEnable(EventText& why) const {
    if (isHoming(why)) return false;
    if (isFaulty()) {
        why = inState() << "; send resetFault first";
        return false;
    }
    if (lead_.hasArrived() || awaitsHoming()) return true;
    if (isOutOfReach(followMode_)) {
        why = outOfReach();
        return false;
    }
    const double away = demandAway();
    if (away <= AxisTargets::tolerance) return true;
    why = name() << ": its demand is " << away << " away from it, allowed is "
                 << AxisTargets::tolerance << ": bring it there first";
    return false;
}

bool Ds402ProcessorAxis::mayDisable(EventText& why) const {
    if (isHoming(why)) return false;
    if (state_ == State::OperationEnabled) return true;
    why = inState() << ", not in Operation enabled";
    return false;
}

bool Ds402ProcessorAxis::mayReset(EventText& why) const {
    if (state_ == State::Fault) return true;
    why = name() << " is in " << nameOf(state_) << ", not in Fault";
    return false;
}

bool Ds402ProcessorAxis::mayChangeMode(EventText& why, std::int64_t mode) const {
    if (isHoming(why)) return false;
    if (mode == followMode_ || state_ != State::OperationEnabled) return true;
    if (isOutOfReach(mode)) {
        why = outOfReach();
        return false;
    }
    const double demanded = targets_.follows() ? targets_.target().velocity : 0;
    if (stands() && std::abs(demanded) <= AxisTargets::tolerance) return true;
    const double fastest = std::max(std::abs(velocity_.get()), std::abs(demanded));
    why = name() << " moves at " << fastest << ": its mode changes at standstill only";
    return false;
}

bool Ds402ProcessorAxis::mayHome(EventText& why) const {
    if (isHoming(why)) return false;
    if (!homingNeeded_) {
        why = name() << " needs no homing: its encoder is absolute";
        return false;
    }
    if (!isHomingMethodOfCia402(homingMethod())) {
        why =
            name() << ": homingMethod " << homingMethod()
                   << " is none of CiA 402; the drives of CorteX have 1, 2, 17, 18, 33, 34, 35, 37";
        return false;
    }
    if (!mayHomeAtItsSpeeds(why) || !mayHomeToItsOffset(why)) return false;
    if (!lead_.hasArrived() || state_ != State::OperationEnabled) {
        why = inState() << ": enable it first";
        return false;
    }
    if (stands()) return true;
    why = name() << " moves at " << velocity_.get() << ": homing begins at standstill only";
    return false;
}

// Methods that only say where it stands need no speeds.
bool Ds402ProcessorAxis::mayHomeAtItsSpeeds(EventText& why) const {
    if (homingMethod() == 35 || homingMethod() == 37) return true;
    const double speed = items_.homingSpeed[place()], creep = items_.homingCreep[place()];
    const double most = limits_.motion().velocity;
    if (!(speed > 0 && creep > 0)) {
        why = name() << ": homingSpeed is " << speed << " and homingCreep " << creep
                     << "; both must be above 0";
        return false;
    }
    if (std::max(speed, creep) <= most) return true;
    why = name() << ": homingSpeed is " << speed << " and homingCreep " << creep << ", at most "
                 << most << ", the limit of its demand";
    return false;
}

// A drive has 32 bits for a position, its sign included.
bool Ds402ProcessorAxis::mayHomeToItsOffset(EventText& why) const {
    const double most = std::numeric_limits<std::int32_t>::max() / countsPerUnit_;
    const double offset = items_.homeOffset[place()];
    if (std::abs(offset) <= most) return true;
    why = name() << ": homeOffset is " << offset << ", at most " << most
                 << ", as its drive counts positions in 32 bits";
    return false;
}

void Ds402ProcessorAxis::enable() {
    if (!lead_.hasArrived()) lead_.aimAt(TransitionLead::Aim::Enable);
}

// A startup resets it itself.
void Ds402ProcessorAxis::reset() {
    if (lead_.aim() != TransitionLead::Aim::Enable) lead_.aimAt(TransitionLead::Aim::Reset);
}

void Ds402ProcessorAxis::quickStop() {
    homing_.abort(AxisHoming::Result::Stopped);
    lead_.aimAt(TransitionLead::Aim::QuickStop);
}

void Ds402ProcessorAxis::changeMode(std::int64_t mode) {
    if (mode != followMode_) targets_.standAt(position_);
    followMode_ = mode;
    driveWaited_ = 0;
}

}  // namespace cortex::toolkit
