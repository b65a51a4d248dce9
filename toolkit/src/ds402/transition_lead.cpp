// SPDX-License-Identifier: Apache-2.0
#include "ds402/transition_lead.hpp"

#include "cortex/drives/ds402_words.hpp"

namespace cortex::toolkit {

using drives::Ds402Command;
using drives::Ds402State;

namespace {

const std::uint16_t quickStopWord = controlWordOf(Ds402Command::QuickStop);

// Quick stop options after which the drive stays in Quick stop active.
bool staysAfter(std::int64_t quickStopOption) { return quickStopOption >= 5; }

bool isFaulty(Ds402State state) {
    return state == Ds402State::Fault || state == Ds402State::FaultReactionActive;
}

bool isWithoutPower(Ds402State state) {
    return state == Ds402State::SwitchOnDisabled || state == Ds402State::Fault ||
           state == Ds402State::NotReadyToSwitchOn;
}

}  // namespace

void TransitionLead::aimAt(Aim aim, bool resets) {
    aim_ = aim;
    resets_ = resets;
    arrived_ = false;
    waited_ = 0;
}

void TransitionLead::aimAt(const drives::Ds402Transition& step) {
    aimAt(Aim::Step);
    stepCommand_ = step.command;
    stepEnd_ = step.to;
}

Ds402State TransitionLead::wanted(std::int64_t quickStopOption) const {
    switch (aim_) {
        case Aim::None:
            return Ds402State::Unknown;
        case Aim::Enable:
            return Ds402State::OperationEnabled;
        case Aim::Disable:
            return Ds402State::SwitchedOn;
        case Aim::QuickStop:
            if (staysAfter(quickStopOption)) return Ds402State::QuickStopActive;
            break;
        case Aim::Step:
            return stepEnd_;
        case Aim::PowerOff:
        case Aim::Reset:
            break;
    }
    return Ds402State::SwitchOnDisabled;
}

bool TransitionLead::isThere(const Seen& seen) const {
    const bool rests = seen.state == Ds402State::QuickStopActive && seen.stands &&
                       staysAfter(seen.quickStopOption);
    switch (aim_) {
        case Aim::QuickStop:
            return isWithoutPower(seen.state) || rests;
        case Aim::PowerOff:
            return isWithoutPower(seen.state);
        case Aim::Reset:
            return !isFaulty(seen.state);
        default:
            return seen.state == wanted(seen.quickStopOption);
    }
}

// A fault has come between; or what is to be disabled is not enabled any more.
bool TransitionLead::isInVain(const Seen& seen) const {
    if (aim_ == Aim::Disable) return seen.state != Ds402State::OperationEnabled;
    return (aim_ == Aim::Enable || aim_ == Aim::Step) && isFaulty(seen.state) && !resets_;
}

Ds402Command TransitionLead::towardsEnabled(const Seen& seen) const {
    const bool ready = seen.modeShown && seen.targetsThere;
    switch (seen.state) {
        case Ds402State::SwitchOnDisabled:
            return Ds402Command::Shutdown;
        case Ds402State::ReadyToSwitchOn:
            return Ds402Command::SwitchOn;
        case Ds402State::SwitchedOn:
            return ready ? Ds402Command::EnableOperation : Ds402Command::SwitchOn;
        case Ds402State::QuickStopActive:
            return ready && seen.stands && staysAfter(seen.quickStopOption)
                       ? Ds402Command::EnableOperation
                       : Ds402Command::QuickStop;
        case Ds402State::Fault:
            return Ds402Command::FaultReset;
        default:
            return Ds402Command::None;
    }
}

Ds402Command TransitionLead::commandIn(const Seen& seen) const {
    switch (aim_) {
        case Aim::Enable:
            return towardsEnabled(seen);
        case Aim::Disable:
            return Ds402Command::SwitchOn;
        case Aim::PowerOff:
            if (seen.state == Ds402State::QuickStopActive && seen.stands &&
                staysAfter(seen.quickStopOption))
                return Ds402Command::DisableVoltage;
            return Ds402Command::QuickStop;
        case Aim::QuickStop:
            return Ds402Command::QuickStop;
        case Aim::Reset:
            return Ds402Command::FaultReset;
        case Aim::Step:
            return stepCommand_;
        case Aim::None:
            break;
    }
    return Ds402Command::None;
}

// A reset is an edge: first a word without the bit stands for long enough to be seen.
void TransitionLead::send(Ds402Command command, const Seen& seen) {
    if (command == Ds402Command::None) return;
    std::uint16_t word = controlWordOf(command);
    const bool low = (word_ & drives::Ds402Control::faultReset) == 0;
    if (command == Ds402Command::FaultReset && low && (word_ != 0 || waited_ < ds402ExchangeTime))
        word = 0;
    const auto option = static_cast<int>(seen.quickStopOption);
    const drives::Ds402Transition* leads = transitionOf(seen.state, command, option);
    next_ = leads != nullptr ? leads->to : wanted(seen.quickStopOption);
    if (word != word_) waited_ = 0;
    word_ = word;
}

// How long a ramp takes is nobody's fault.
bool TransitionLead::isBraking(const Seen& seen) const {
    if (seen.stands) return false;
    if (seen.state == Ds402State::QuickStopActive) return true;
    return seen.state == Ds402State::OperationEnabled && word_ != quickStopWord;
}

// What stands in the word where nothing is aimed at any more must not do harm later.
void TransitionLead::arrive() {
    arrived_ = aim_ == Aim::Enable;
    if (arrived_) return;
    const bool stays = aim_ == Aim::Disable || aim_ == Aim::Step;
    if (!stays) word_ = quickStopWord;
    aim_ = Aim::None;
}

TransitionLead::Course TransitionLead::refuse() {
    aimAt(Aim::None);
    word_ = quickStopWord;
    return Course::Refused;
}

TransitionLead::Course TransitionLead::advance(const Seen& seen, double seconds, double timeout) {
    if (seen.state != last_) {
        waited_ = 0;
        if (last_ == Ds402State::Fault) resets_ = false;
        last_ = seen.state;
    }
    if (aim_ == Aim::None) return Course::Idle;
    if (isThere(seen)) {
        arrive();
        return Course::Reached;
    }
    if (isInVain(seen)) return refuse();
    const Ds402Command command = commandIn(seen);
    send(command, seen);
    waited_ += seconds;
    const bool prepares = command == Ds402Command::FaultReset && word_ == 0;
    const bool waitsForTargets = aim_ == Aim::Enable && !seen.targetsThere;
    if (isBraking(seen) || (waitsForTargets && seen.state == Ds402State::SwitchedOn)) waited_ = 0;
    if (!prepares && waited_ > timeout) return refuse();
    return Course::Goes;
}

}  // namespace cortex::toolkit
