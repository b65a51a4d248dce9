// SPDX-License-Identifier: Apache-2.0
#include "ds402/drive_items.hpp"

#include "cortex/drives/ds402_state.hpp"
#include "cortex/drives/ds402_words.hpp"

#include <cmath>

namespace cortex::toolkit {
namespace {

using drives::Ds402Mode;
using drives::Ds402State;
using drives::Ds402Status;

constexpr double movesAbove = 1e-3;  // rad/s or m/s

// The item `status` of an axis; numbers of its labels in ontology/robotics.xml.
enum class AxisStatus : std::int64_t {
    Unknown,
    Ready,
    Moving,
    AtLimit,
    Fault,
    NotHomed,
    Disabled,
    Braked
};

AxisStatus statusOf(Ds402State state, const drives::Ds402Outputs& outputs, bool homed, bool waits) {
    switch (state) {
        case Ds402State::Unknown:
            return AxisStatus::Unknown;
        case Ds402State::FaultReactionActive:
        case Ds402State::Fault:
            return AxisStatus::Fault;
        case Ds402State::SwitchedOn:
            return AxisStatus::Braked;
        case Ds402State::OperationEnabled:
            break;
        default:
            return AxisStatus::Disabled;  // in Quick stop active, too, it follows nobody
    }
    const auto mode = static_cast<Ds402Mode>(outputs.modeDisplay);
    const bool byPosition = mode == Ds402Mode::CyclicPosition || mode == Ds402Mode::ProfilePosition;
    if (mode == Ds402Mode::Homing || (byPosition && !homed)) return AxisStatus::NotHomed;
    if (waits) return AxisStatus::Disabled;
    if ((outputs.statusWord & Ds402Status::internalLimit) != 0) return AxisStatus::AtLimit;
    return std::abs(outputs.velocity) > movesAbove ? AxisStatus::Moving : AxisStatus::Ready;
}

}  // namespace

Ds402DemandItems::Ds402DemandItems(const InputSimplex& demand)
    : controlWord_{demand.data<std::int64_t>("controlWord")},
      mode_{demand.data<std::int64_t>("mode")},
      digitalOutputs_{demand.data<std::int64_t>("digitalOutputs")},
      homingMethod_{demand.data<std::int64_t>("homingMethod")},
      quickStopOption_{demand.data<std::int64_t>("quickStopOption")},
      faultReactionOption_{demand.data<std::int64_t>("faultReactionOption")},
      position_{demand.data<double>("position")},
      velocity_{demand.data<double>("velocity")},
      effort_{demand.data<double>("effort")},
      homingSpeed_{demand.data<double>("homingSpeed")},
      homingCreep_{demand.data<double>("homingCreep")},
      homeOffset_{demand.data<double>("homeOffset")},
      waits_{demand.data<bool>("waits")} {}

void Ds402DemandItems::see(bool isLost, double position, std::int64_t modeDisplay, double seconds) {
    const AxisTarget demand{position_, velocity_, 0, 0};
    joining_.standAt(position);
    joining_.see(demand, seconds);
    const bool mayJoin = joining_.mayJoin(demand, static_cast<int>(modeDisplay));
    isAwaited_ = isLost || (isAwaited_ && !mayJoin);
}

drives::Ds402Inputs Ds402DemandItems::inputs(std::int64_t modeDisplay) const {
    const bool inPosition = modeDisplay == static_cast<int>(Ds402Mode::CyclicPosition);
    const bool inTorque = modeDisplay == static_cast<int>(Ds402Mode::CyclicTorque);
    drives::Ds402Inputs inputs;
    inputs.controlWord = static_cast<std::uint16_t>(controlWord_.get());
    if (isAwaited_ &&
        drives::commandOf(inputs.controlWord) == drives::Ds402Command::EnableOperation)
        inputs.controlWord = ds402QuickStop;
    inputs.mode = static_cast<std::int8_t>(mode_.get());
    inputs.position = position_;
    inputs.velocity = velocity_;
    inputs.effort = effort_;
    inputs.velocityOffset = inPosition ? velocity_.get() : 0;
    inputs.effortOffset = inTorque ? 0 : effort_.get();
    inputs.digitalOutputs = static_cast<std::uint32_t>(digitalOutputs_.get());
    return inputs;
}

void Ds402DemandItems::wish(drives::Ds402Parameters& parameters) const {
    parameters.homingMethod = static_cast<std::int32_t>(homingMethod_);
    parameters.homingSpeed = homingSpeed_;
    parameters.homingCreep = homingCreep_;
    parameters.homeOffset = homeOffset_;
    parameters.quickStopOption = static_cast<std::int32_t>(quickStopOption_);
    parameters.faultReactionOption = static_cast<std::int32_t>(faultReactionOption_);
}

Ds402ObservationItems::Ds402ObservationItems(const OutputSimplex& observation)
    : status_{observation.data<std::int64_t>("status")},
      statusWord_{observation.data<std::int64_t>("statusWord")},
      driveState_{observation.data<std::int64_t>("driveState")},
      modeDisplay_{observation.data<std::int64_t>("modeDisplay")},
      errorCode_{observation.data<std::int64_t>("errorCode")},
      digitalInputs_{observation.data<std::int64_t>("digitalInputs")},
      voltageEnabled_{observation.data<bool>("voltageEnabled")},
      warning_{observation.data<bool>("warning")},
      remote_{observation.data<bool>("remote")},
      targetReached_{observation.data<bool>("targetReached")},
      internalLimit_{observation.data<bool>("internalLimit")},
      homed_{observation.data<bool>("homed")},
      position_{observation.data<double>("position")},
      velocity_{observation.data<double>("velocity")},
      acceleration_{observation.data<double>("acceleration")},
      effort_{observation.data<double>("effort")},
      followingError_{observation.data<double>("followingError")},
      temperature_{observation.data<double>("temperature", "Cel")},
      countsPerUnit_{observation.data<const double>("countsPerUnit")},
      ratedEffort_{observation.data<const double>("ratedEffort")},
      homingNeeded_{observation.data<const bool>("homingNeeded")} {}

void Ds402ObservationItems::write(const drives::Ds402Outputs& outputs, double acceleration,
                                  bool waits) {
    const auto has = [&](std::uint16_t bit) { return (outputs.statusWord & bit) != 0; };
    const Ds402State told = drives::stateOf(outputs.statusWord);
    statusWord_ = outputs.statusWord;
    if (told != Ds402State::Unknown) driveState_ = static_cast<std::int64_t>(told);
    status_ = static_cast<std::int64_t>(statusOf(static_cast<Ds402State>(driveState_.get()),
                                                 outputs, outputs.homed || !homingNeeded_, waits));
    modeDisplay_ = outputs.modeDisplay;
    voltageEnabled_ = has(Ds402Status::voltageEnabled);
    warning_ = has(Ds402Status::warning);
    remote_ = has(Ds402Status::remote);
    targetReached_ = has(Ds402Status::targetReached);
    internalLimit_ = has(Ds402Status::internalLimit);
    homed_ = outputs.homed;
    errorCode_ = outputs.errorCode;
    digitalInputs_ = outputs.digitalInputs;
    position_ = outputs.position;
    velocity_ = outputs.velocity;
    acceleration_ = acceleration;
    effort_ = outputs.effort;
    followingError_ = outputs.followingError;
    temperature_ = outputs.temperature;
}

}  // namespace cortex::toolkit
