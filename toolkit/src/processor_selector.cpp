// SPDX-License-Identifier: Apache-2.0
#include "processor_selector.hpp"

namespace cortex::toolkit {
namespace {

constexpr std::int64_t retryAfter = 500'000'000;  // ns

bool running(State state) { return state == State::StartingUp || state == State::Active; }
bool ended(State state) { return state == State::Standby || state == State::Fault; }

}  // namespace

void ProcessorSelector::populate() {
    hand_ = PoseInput{input("hand")};
    enable_ = Enable{input("enable"), {hand_.state}};
    speedThreshold_ = data<const double>("speedThreshold");
    turnThreshold_ = data<const double>("turnThreshold");
    stillTime_ = data<const double>("stillTime");
    selected_ = data<std::int64_t>("selected");
    reason_ = data<std::int64_t>("reason");
    switchCount_ = data<std::int64_t>("switchCount");
    choices_[0].sender = lifeCycle(output("whileMoving"), true);
    choices_[1].sender = lifeCycle(output("otherwise"), true);
}

bool ProcessorSelector::stateStartingUp(const Tick& tick) {
    stillFor_ = stillTime_ + 1;
    enable_.reset();
    for (Managed& choice : choices_) choice.askedAt = tick.nominalTime - retryAfter;
    return true;
}

bool ProcessorSelector::handMoves(const Tick& tick) {
    const Twist velocity = hand_.velocity();
    const bool moves =
        velocity.head<3>().norm() >= speedThreshold_ || velocity.tail<3>().norm() >= turnThreshold_;
    stillFor_ = moves ? 0 : stillFor_ + tick.elapsedSeconds();
    return stillFor_ <= stillTime_;
}

ProcessorSelector::Reason ProcessorSelector::reason(const Tick& tick) {
    const bool moves = handMoves(tick);
    const bool enabled = enable_.update(inputLost());
    if (!enable_.usable()) return InputLost;
    if (!enabled) return NotEnabled;
    if (choices_[0].sender.state() == State::Fault) return Faulted;
    return moves ? HandMoves : HandStill;
}

void ProcessorSelector::select(Reason reason) {
    if (reason != reason_ && reason == InputLost)
        event(Severity::Warning, "follows 'otherwise': the hand or its button is lost");
    if (reason != reason_ && reason_ == InputLost)
        event(Severity::Info, "the hand and its button are back: press anew to move");
    reason_ = reason;
    const Choice choice = reason == HandMoves ? WhileMoving : Otherwise;
    if (selected_ == choice) return;
    if (selected_ != None) switchCount_ += 1;
    selected_ = choice;
}

void ProcessorSelector::stateActive(const Tick& tick) {
    select(reason(tick));
    const bool follow = selected_ == WhileMoving;
    Managed& chosen = choices_[follow ? 0 : 1];
    Managed& other = choices_[follow ? 1 : 0];
    if (running(other.sender.state())) other.sender.shutdown();
    if (chosen.sender.state() != State::Standby) {
        chosen.askedAt = tick.nominalTime - retryAfter;
    } else if (tick.nominalTime - chosen.askedAt >= retryAfter) {
        chosen.askedAt = tick.nominalTime;
        chosen.sender.startup();
    }
}

bool ProcessorSelector::stopAll() {
    bool all = true;
    for (Managed& choice : choices_) {
        const State state = choice.sender.state();
        if (running(state)) choice.sender.shutdown();
        all = all && ended(state);
    }
    selected_ = None;
    reason_ = NotActive;
    return all;
}

bool ProcessorSelector::stateShuttingDown(const Tick&) { return stopAll(); }

bool ProcessorSelector::stateFault(const Tick&) { return stopAll(); }

void ProcessorSelector::keep(Archive& archive) {
    archive.version("ProcessorSelector", 1);
    archive & enable_ & choices_ & stillFor_;
}

}  // namespace cortex::toolkit
