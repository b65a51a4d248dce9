// SPDX-License-Identifier: Apache-2.0
#include "ds402/ds402_processor.hpp"

namespace cortex::toolkit {

void Ds402Processor::populate() {
    static const StepReasons reasons;
    reasons_ = &reasons;
    bindItems();
    bindSafety();
    bindCommands();
}

void Ds402Processor::bindItems() {
    items_ = {array<std::int64_t>("wanted"),
              array<std::int64_t>("driveState"),
              array<std::int64_t>("mode"),
              array<std::int64_t>("lastTransition"),
              array<std::int64_t>("transitionCount"),
              array<std::int64_t>("refusedCount"),
              array<std::int64_t>("unknownCount"),
              array<std::int64_t>("errorCode"),
              array<bool>("homed"),
              array<std::string_view>("errorText"),
              array<const std::int64_t>("quickStopOption"),
              array<const std::int64_t>("faultReactionOption"),
              array<const std::int64_t>("homingMethod"),
              array<const double>("homingSpeed"),
              array<const double>("homingCreep"),
              array<const double>("homeOffset")};
    stepTimeout_ = data<const double>("stepTimeout");
    progress_ = data<double>("progress");
}

void Ds402Processor::bindSafety() {
    for (const InputSimplex& safety : inputs("safety")) {
        emergencyStop_ = safety.data<bool>("emergencyStop");
        protectiveStop_ = safety.data<bool>("protectiveStop");
    }
}

void Ds402Processor::addAxis(const Ds402ProcessorAxis::Links& links) {
    axes_.emplace_back(static_cast<int>(axes_.size()) + 1, links, items_);
}

void Ds402AxisProcessor::populate() {
    Ds402Processor::populate();
    const auto drives = inputs("drives"), demands = inputs("demands");
    const auto setpoints = outputs("setpoints");
    for (std::size_t i = 0; i < drives.size(); ++i) addAxis({drives[i], demands[i], setpoints[i]});
}

// --- reports ------------------------------------------------------------------------------------

void Ds402Processor::report(const Axis::Found& found) {
    if (found && found->code != 0)
        fault(found->code, found->text.view());
    else
        reportOnly(found);
}

void Ds402Processor::reportOnly(const Axis::Found& found) {
    if (found) event(Severity::Warning, found->text);
}

bool Ds402Processor::all(bool (*holds)(const Axis& axis)) const {
    for (const Axis& axis : axes_) {
        if (!holds(axis)) return false;
    }
    return true;
}

bool Ds402Processor::isSafetyStop() {
    if (!emergencyStop_.bound() || (!emergencyStop_ && !protectiveStop_)) return false;
    fault(Ds402Faults::safetyStop,
          emergencyStop_ ? "safety stop: emergency stop" : "safety stop: protective stop");
    return true;
}

// --- states -------------------------------------------------------------------------------------

void Ds402Processor::loopStart(const Tick&) {
    ran_ = false;
    for (Axis& axis : axes_) reportOnly(axis.observe());
    if (lastState_ == state()) return;
    const bool cleared = lastState_ == State::Fault && state() == State::Standby;
    lastState_ = state();
    for (Axis& axis : axes_) {
        if (cleared) axis.faultsCleared();
        if (state() == State::StartingUp) axis.beginStartup();
        if (state() == State::ShuttingDown || state() == State::Fault) axis.powerOff();
    }
}

void Ds402Processor::leadAll(const Tick& tick, bool faults) {
    for (Axis& axis : axes_) {
        const Axis::Found found = axis.lead(tick.elapsedSeconds(), stepTimeout_);
        if (faults)
            report(found);
        else
            reportOnly(found);
    }
}

void Ds402Processor::stateStandby(const Tick& tick) { leadAll(tick, false); }

bool Ds402Processor::stateStartingUp(const Tick& tick) {
    if (isSafetyStop()) return false;
    if (inputLost()) {
        fault(Ds402Faults::inputLost, "an input was lost in the startup");
        return false;
    }
    for (Axis& axis : axes_) report(axis.startUp(tick.elapsedSeconds(), stepTimeout_));
    return all([](const Axis& axis) { return axis.isReady(); });
}

void Ds402Processor::stateActive(const Tick& tick) {
    ran_ = true;
    homed_ += tick.elapsedSeconds();
    if (isSafetyStop()) return;
    for (Axis& axis : axes_) report(axis.follow(tick.elapsedSeconds(), stepTimeout_));
}

bool Ds402Processor::stateShuttingDown(const Tick& tick) {
    leadAll(tick, true);
    return all([](const Axis& axis) { return axis.isOff(); });
}

bool Ds402Processor::stateFault(const Tick& tick) {
    leadAll(tick, false);
    return !inputLost() && all([](const Axis& axis) {
        return axis.state() != drives::Ds402State::FaultReactionActive;
    });
}

void Ds402Processor::loopEnd(const Tick& tick) {
    const bool lost = state() == State::Active && !ran_;
    if (lost) {
        stopForLostDemands(tick);
    } else if (lostDemands_ && state() == State::Active) {
        event(Severity::Warning, "demands are back; axes were stopped: enable them");
    }
    lostDemands_ = lost;
    for (Axis& axis : axes_) axis.tell();
}

// Safe targets stand, and stateActive is left out: each drive stops by itself, as quickly as it
// may.
void Ds402Processor::stopForLostDemands(const Tick& tick) {
    for (Axis& axis : axes_) {
        if (!lostDemands_) axis.quickStop();
    }
    leadAll(tick, false);
}

void Ds402Processor::keep(Archive& archive) {
    archive.version("Ds402Processor", 2);
    archive & axes_ & lastState_ & lostDemands_ & homing_ & homingEnd_ & homingFirst_ & homed_;
}

}  // namespace cortex::toolkit
