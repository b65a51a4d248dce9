// SPDX-License-Identifier: Apache-2.0
// The commands of a processor of CiA 402 drives.
#include "ds402/drive_words.hpp"
#include "ds402/ds402_processor.hpp"

#include <algorithm>

namespace cortex::toolkit {

using Result = AxisHoming::Result;

void Ds402Processor::bindCommands() {
    enableAxis_ = argument<std::int64_t>("enable", "axis");
    disableAxis_ = argument<std::int64_t>("disable", "axis");
    stopAxis_ = argument<std::int64_t>("quickStop", "axis");
    resetAxis_ = argument<std::int64_t>("resetFault", "axis");
    stepAxis_ = argument<std::int64_t>("step", "axis");
    stepWord_ = argument<std::int64_t>("step", "word");
    modeAxis_ = argument<std::int64_t>("setMode", "axis");
    newMode_ = argument<std::int64_t>("setMode", "mode");
    homeAxis_ = argument<std::int64_t>("home", "axis");
    homeTimeout_ = argument<double>("home", "timeout");
    on<&Ds402Processor::enable>("enable");
    on<&Ds402Processor::disable>("disable");
    on<&Ds402Processor::quickStop>("quickStop");
    on<&Ds402Processor::resetFault>("resetFault");
    on<&Ds402Processor::step>("step");
    on<&Ds402Processor::setMode>("setMode");
    on<&Ds402Processor::home>("home");
}

std::optional<Ds402Processor::Range> Ds402Processor::rangeOf(Call& call, std::int64_t axis) {
    if (axis == 0) return Range{0, axes_.size()};
    const auto place = static_cast<std::size_t>(axis - 1);
    if (place < axes_.size()) return Range{place, place + 1};
    call.reject(Reason::Range, (EventText{"there is no axis "} << axis << ", there is 1").view());
    return std::nullopt;
}

// All of them, or none.
Outcome Ds402Processor::forAll(Call& call, std::int64_t axis, Asks asks, Acts acts) {
    const auto range = rangeOf(call, axis);
    if (!range) return Outcome::Rejected;
    EventText why;
    for (std::size_t i = range->first; i < range->end; ++i) {
        if (!(axes_[i].*asks)(why)) return call.reject(Reason::State, why.view());
    }
    for (std::size_t i = range->first; i < range->end; ++i) (axes_[i].*acts)();
    return Outcome::Done;
}

// Those of them that can; at least one.
Outcome Ds402Processor::forAny(Call& call, std::int64_t axis, Asks asks, Acts acts) {
    const auto range = rangeOf(call, axis);
    if (!range) return Outcome::Rejected;
    EventText all;
    bool any = false;
    for (std::size_t i = range->first; i < range->end; ++i) {
        EventText why;
        if ((axes_[i].*asks)(why)) {
            (axes_[i].*acts)();
            any = true;
        } else {
            all << (all.view().empty() ? "" : "; ") << why.view();
        }
    }
    return any ? Outcome::Done : call.reject(Reason::State, all.view());
}

Outcome Ds402Processor::enable(Call& call) {
    return forAll(call, call[enableAxis_], &Axis::mayEnable, &Axis::enable);
}

Outcome Ds402Processor::disable(Call& call) {
    return forAny(call, call[disableAxis_], &Axis::mayDisable, &Axis::disable);
}

Outcome Ds402Processor::resetFault(Call& call) {
    return forAny(call, call[resetAxis_], &Axis::mayReset, &Axis::reset);
}

Outcome Ds402Processor::quickStop(Call& call) {
    const auto range = rangeOf(call, call[stopAxis_]);
    if (!range) return Outcome::Rejected;
    for (std::size_t i = range->first; i < range->end; ++i) {
        if (state() == State::StartingUp) {
            fault(Ds402Faults::refused + static_cast<std::int64_t>(i) + 1,
                  (axes_[i].name() << ": a quick stop ended the startup").view());
        } else if (state() == State::Active || state() == State::Standby) {
            axes_[i].quickStop();
        }
    }
    return Outcome::Done;
}

Outcome Ds402Processor::step(Call& call) {
    const auto range = rangeOf(call, call[stepAxis_]);
    if (!range) return Outcome::Rejected;
    Axis& axis = axes_[range->first];
    const auto word = static_cast<StepWord>(call[stepWord_].get());
    const int option = axis.quickStopOption();
    EventText why;
    if (axis.isHoming(why)) return call.reject(Reason::State, why.view());
    const auto* transition = StepReasons::transition(word, axis.state(), option);
    if (transition == nullptr)
        return call.reject(Reason::State, reasons_->why(word, axis.state(), option));
    if (word == StepWord::EnableOperation) return stepToEnabled(call, axis);
    if (word == StepWord::DisableOperation)
        axis.disable();
    else if (word == StepWord::QuickStop)
        axis.quickStop();
    else if (word == StepWord::FaultReset)
        axis.reset();
    else
        axis.step(*transition);
    return Outcome::Done;
}

Outcome Ds402Processor::stepToEnabled(Call& call, Axis& axis) {
    if (state() != State::Active) {
        return call.reject(Reason::State,
                           "in Standby targets are safe ones and may be elsewhere: startup leads "
                           "to Operation enabled");
    }
    EventText why;
    if (!axis.mayEnable(why)) return call.reject(Reason::State, why.view());
    axis.enable();
    return Outcome::Done;
}

Outcome Ds402Processor::setMode(Call& call) {
    const auto range = rangeOf(call, call[modeAxis_]);
    if (!range) return Outcome::Rejected;
    const std::int64_t mode = call[newMode_];
    EventText why;
    for (std::size_t i = range->first; i < range->end; ++i) {
        if (!axes_[i].mayChangeMode(why, mode)) return call.reject(Reason::State, why.view());
    }
    for (std::size_t i = range->first; i < range->end; ++i) axes_[i].changeMode(mode);
    return Outcome::Done;
}

// --- homing -------------------------------------------------------------------------------------

Outcome Ds402Processor::home(Call& call) {
    if (call.first()) {
        const Outcome outcome = beginHoming(call);
        if (outcome != Outcome::Running) return outcome;
    }
    AxisHoming& homing = axes_[homing_].homing();
    if (call.cancelling()) {
        homing.stop(Result::Cancelled);
        return Outcome::Cancelled;
    }
    if (homing.runs() && homed_ > call[homeTimeout_]) homing.stop(Result::TimedOut);
    return goOnHoming(call);
}

Outcome Ds402Processor::beginHoming(Call& call) {
    const std::int64_t axis = call[homeAxis_];
    const auto range = rangeOf(call, axis);
    if (!range) return Outcome::Rejected;
    EventText why{"no axis needs homing: their encoders are absolute"};
    homing_ = homingFirst_ = homingEnd_ = range->end;
    for (std::size_t i = range->first; i < range->end; ++i) {
        if (axis == 0 && !axes_[i].needsHoming()) continue;
        if (!axes_[i].mayHome(why)) return call.reject(Reason::State, why.view());
        homing_ = homingFirst_ = std::min(homing_, i);
    }
    if (homing_ == homingEnd_) return call.reject(Reason::State, why.view());
    axes_[homing_].homing().begin();
    homed_ = 0;
    return Outcome::Running;
}

Outcome Ds402Processor::goOnHoming(Call& call) {
    Axis& axis = axes_[homing_];
    const double axes = static_cast<double>(homingEnd_ - homingFirst_);
    const double done = static_cast<double>(homing_ - homingFirst_) + axis.homing().share();
    progress_ = done / axes;
    if (axis.homing().runs()) return Outcome::Running;
    const Result result = axis.homing().result();
    if (result != Result::Done) {
        EventText why = axis.name() << ": " << AxisHoming::words(result);
        if (result == Result::Failed) why << ", by method " << axis.homingMethod();
        if (axis.hasError()) why << ": " << axis.errorOfDrive().view();
        return call.fail(why.view());
    }
    for (std::size_t i = homing_ + 1; i < homingEnd_; ++i) {
        if (!axes_[i].needsHoming()) continue;
        homing_ = i;
        EventText why;
        if (!axes_[i].mayHome(why)) return call.fail(why.view());
        axes_[i].homing().begin();
        return Outcome::Running;
    }
    progress_ = 1.0;
    return Outcome::Done;
}

}  // namespace cortex::toolkit
