// SPDX-License-Identifier: Apache-2.0
#include "processor_selector.hpp"

namespace cortex::toolkit {
namespace {

constexpr std::int64_t RetryAfter = 500'000'000;  // ns

bool running(State state) { return state == State::StartingUp || state == State::Active; }
bool ended(State state) { return state == State::Standby || state == State::Fault; }

}  // namespace

void ProcessorSelector::populate() {
    hand_ = PoseInput{input("hand")};
    enable_ = input("enable").data<bool>("value");
    enableState_ = &input("enable").state();
    speedThreshold_ = data<const double>("speedThreshold");
    turnThreshold_ = data<const double>("turnThreshold");
    stillTime_ = data<const double>("stillTime");
    selected_ = data<std::int64_t>("selected");
    switchCount_ = data<std::int64_t>("switchCount");
    choices_[0].sender = lifeCycle(output("whileMoving"), true);
    choices_[1].sender = lifeCycle(output("otherwise"), true);
}

bool ProcessorSelector::stateStartingUp(const Tick& tick) {
    stillFor_ = stillTime_ + 1;
    for (Managed& choice : choices_) choice.askedAt = tick.nominalTime - RetryAfter;
    return true;
}

bool ProcessorSelector::handMoves(const Tick& tick) {
    const Twist velocity = hand_.velocity();
    const bool moves =
        velocity.head<3>().norm() >= speedThreshold_ || velocity.tail<3>().norm() >= turnThreshold_;
    stillFor_ = moves ? 0 : stillFor_ + tick.elapsedSeconds();
    return stillFor_ <= stillTime_;
}

void ProcessorSelector::select(Choice choice) {
    if (selected_ == choice) return;
    if (selected_ != None) switchCount_ += 1;
    selected_ = choice;
}

void ProcessorSelector::stateActive(const Tick& tick) {
    const bool moves = handMoves(tick);
    const bool usable = hand_.good() && enableState_->quality == Quality::Good;
    const bool follow = usable && enable_ && moves && choices_[0].sender.state() != State::Fault;
    select(follow ? WhileMoving : Otherwise);
    Managed& chosen = choices_[follow ? 0 : 1];
    Managed& other = choices_[follow ? 1 : 0];
    if (running(other.sender.state())) other.sender.shutdown();
    if (chosen.sender.state() != State::Standby) {
        chosen.askedAt = tick.nominalTime - RetryAfter;
    } else if (tick.nominalTime - chosen.askedAt >= RetryAfter) {
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
    return all;
}

bool ProcessorSelector::stateShuttingDown(const Tick&) { return stopAll(); }

bool ProcessorSelector::stateFault(const Tick&) { return stopAll(); }

}  // namespace cortex::toolkit
