// SPDX-License-Identifier: Apache-2.0
#include "processor_selector.hpp"

namespace cortex::toolkit {
namespace {

bool running(State state) { return state == State::StartingUp || state == State::Active; }

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
    choices_[0] = lifeCycle(output("whileMoving"), true);
    choices_[1] = lifeCycle(output("otherwise"), true);
}

bool ProcessorSelector::stateStartingUp(const Tick&) {
    stillFor_ = stillTime_ + 1;
    enable_.reset();
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
    if (choices_[0].state() == State::Fault) return Faulted;
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
    const std::size_t wanted = selected_ == WhileMoving ? 0 : 1;
    const HandOver step = LifeCycleSender::handOver(
        choices_, [wanted](std::size_t place) { return place == wanted; }, tick);
    // The hand does not lead on because what follows it does not start.
    if (step == HandOver::Failed && wanted == 1 && running(choices_[0].state()))
        choices_[0].shutdown();
}

bool ProcessorSelector::stopAll(const Tick& tick) {
    selected_ = None;
    reason_ = NotActive;
    const auto none = [](std::size_t) { return false; };
    return LifeCycleSender::handOver(choices_, none, tick) == HandOver::Done;
}

bool ProcessorSelector::stateShuttingDown(const Tick& tick) { return stopAll(tick); }

bool ProcessorSelector::stateFault(const Tick& tick) { return stopAll(tick); }

void ProcessorSelector::keep(Archive& archive) {
    archive.version("ProcessorSelector", 2);
    archive & enable_ & choices_ & stillFor_;
}

}  // namespace cortex::toolkit
