// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event.hpp"
#include "cortex/core/simplex.hpp"
#include "cortex/drives/ds402_words.hpp"
#include "cortex/toolkit/axis_limits.hpp"

#include "ds402/axis_homing.hpp"
#include "ds402/axis_targets.hpp"
#include "ds402/transition_lead.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace cortex::toolkit {

// Fault codes of a Ds402Processor; `1` and `2` of an axis are added.
struct Ds402Faults {
    static constexpr std::int64_t leftEnabled = 10, notHomed = 20, refused = 30, outOfReach = 50;
    static constexpr std::int64_t inputLost = 30, safetyStop = 40;  // of all axes
};

// The arrays of a processor, a place for each axis.
struct Ds402Items {
    std::span<std::int64_t> wanted, driveState, mode, lastTransition, transitionCount, refusedCount,
        unknownCount, errorCode;
    std::span<bool> homed;
    TextArray<std::string_view> errorText;
    std::span<const std::int64_t> quickStopOption, faultReactionOption, homingMethod;
    std::span<const double> homingSpeed, homingCreep, homeOffset;
};

// One axis of a processor: what its drive says, what it is told, and how a demand gets there. Tells
// what its processor is to report. For hooks of the processor.
class Ds402ProcessorAxis {
public:
    struct Links {
        InputSimplex drive, demand;
        OutputSimplex setpoint;
    };
    struct Finding {
        std::int64_t code;  // of a fault; 0: an event
        EventText text;
    };
    using Found = std::optional<Finding>;
    using State = drives::Ds402State;

    // Setup. `number`: 1 or 2. Throws Error where the set-point names no mode to begin with.
    Ds402ProcessorAxis(int number, const Links& links, const Ds402Items& items);

    // In each cycle, before anything else.
    Found observe() CORTEX_REALTIME;
    // Then one of these: words alone; with targets that stand; with targets that follow.
    Found lead(double seconds, double timeout) CORTEX_REALTIME;
    Found startUp(double seconds, double timeout) CORTEX_REALTIME;
    Found follow(double seconds, double timeout) CORTEX_REALTIME;
    // Last in each cycle.
    void tell() CORTEX_REALTIME;

    void beginStartup() CORTEX_REALTIME;
    bool isReady() const CORTEX_REALTIME;  // for Active
    bool isOff() const CORTEX_REALTIME;    // without power, or in Fault
    void powerOff() CORTEX_REALTIME;
    void faultsCleared() CORTEX_REALTIME { resetsAtStart_ = state_ == State::Fault; }

    // Commands. `why` gets the reason where one is refused.
    bool mayEnable(EventText& why) const CORTEX_REALTIME;
    bool mayDisable(EventText& why) const CORTEX_REALTIME;
    bool mayReset(EventText& why) const CORTEX_REALTIME;
    bool mayChangeMode(EventText& why, std::int64_t mode) const CORTEX_REALTIME;
    bool mayHome(EventText& why) const CORTEX_REALTIME;
    bool isHoming(EventText& why) const CORTEX_REALTIME;
    void enable() CORTEX_REALTIME;
    void disable() CORTEX_REALTIME { lead_.aimAt(TransitionLead::Aim::Disable); }
    void quickStop() CORTEX_REALTIME;
    void reset() CORTEX_REALTIME;
    void step(const drives::Ds402Transition& step) CORTEX_REALTIME { lead_.aimAt(step); }
    void changeMode(std::int64_t mode) CORTEX_REALTIME;

    AxisHoming& homing() { return homing_; }
    bool needsHoming() const { return homingNeeded_; }
    State state() const { return state_; }
    bool hasError() const { return errorCode_ != 0; }
    int quickStopOption() const { return static_cast<int>(quickStopOption_.get()); }
    EventText name() const CORTEX_REALTIME;          // "axis 1"
    EventText errorOfDrive() const CORTEX_REALTIME;  // in words
    std::int64_t homingMethod() const { return items_.homingMethod[place()]; }

    void keep(Archive& archive) CORTEX_REALTIME;

private:
    std::size_t place() const { return static_cast<std::size_t>(number_ - 1); }
    std::uint16_t statusWord() const { return static_cast<std::uint16_t>(statusWord_.get()); }
    bool isFaulty() const { return state_ == State::Fault || state_ == State::FaultReactionActive; }
    bool stands() const CORTEX_REALTIME;
    bool isHomed() const { return homed_ || !homingNeeded_; }
    bool isLost() const { return driveSlot_->quality == Quality::Lost; }
    bool isLeftUnasked() const { return lead_.hasArrived() && state_ != State::OperationEnabled; }
    bool targetsThere() const CORTEX_REALTIME;
    bool takesTargets() const CORTEX_REALTIME;
    bool awaitsHoming() const CORTEX_REALTIME;
    bool isOutOfReach(std::int64_t mode) const CORTEX_REALTIME;
    bool mayHomeAtItsSpeeds(EventText& why) const CORTEX_REALTIME;
    bool mayHomeToItsOffset(EventText& why) const CORTEX_REALTIME;
    EventText outOfReach() const CORTEX_REALTIME;  // in words, with the way out
    std::int64_t wishedMode() const CORTEX_REALTIME;
    AxisTarget demand() const CORTEX_REALTIME;
    double demandAway() const CORTEX_REALTIME;  // from what goes out
    bool mayJoin() const CORTEX_REALTIME;
    bool demandIsThere() const CORTEX_REALTIME;  // and stands
    Finding leftUnasked() CORTEX_REALTIME;
    Finding refused() CORTEX_REALTIME;
    Found waitForDemand(bool waits, double seconds) CORTEX_REALTIME;
    Found waitForDrive(double seconds, double timeout) CORTEX_REALTIME;
    void proceedWithHoming(double seconds, double timeout) CORTEX_REALTIME;
    void write() CORTEX_REALTIME;
    EventText inState() const CORTEX_REALTIME;  // "axis 1 is in Fault"

    int number_;
    Ds402Items items_;
    const SlotState* driveSlot_;
    std::string demandPath_;
    AxisLimits limits_;  // of the demand
    Data<const std::int64_t> statusWord_, driveState_, modeDisplay_, errorCode_;
    Data<const double> position_, velocity_, countsPerUnit_;
    Data<const bool> homed_, homingNeeded_;
    Data<const double> demandPosition_, demandVelocity_, demandAcceleration_, demandEffort_;
    Data<std::int64_t> controlWord_, mode_, homingMethod_, quickStopOption_, faultReactionOption_;
    Data<double> targetPosition_, targetVelocity_, targetAcceleration_, targetEffort_;
    Data<double> homingSpeed_, homingCreep_, homeOffset_;
    Data<bool> waits_;

    TransitionLead lead_;
    AxisTargets targets_;
    AxisHoming homing_;
    State state_ = State::Unknown;
    std::int64_t followMode_ = 0;  // that is wished, but for homing
    std::int64_t lastWord_ = 0;
    bool resetsAtStart_ = false;  // faults were cleared while it was in Fault
    double waited_ = 0;           // s, for its demand, while that does not come nearer
    double nearest_ = 0;          // that this demand was, meanwhile
    double driveWaited_ = 0;      // s, enabled, for the drive to take targets
    double demandRested_ = 0;     // s, while it homes
};

}  // namespace cortex::toolkit
