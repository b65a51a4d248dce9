// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/archive.hpp"
#include "cortex/core/simplex.hpp"
#include "cortex/drives/ds402_parameters.hpp"
#include "cortex/drives/ds402_signals.hpp"

#include "ds402/axis_targets.hpp"

#include <cstdint>

namespace cortex::toolkit {

// What a device of CiA 402 drives reads and writes of one axis. Made in populate(), for its hooks.

inline constexpr std::uint16_t ds402QuickStop = 0x0002;  // control word

// The items of a Ds402Modification.
class Ds402DemandItems {
public:
    explicit Ds402DemandItems(const InputSimplex& demand);

    // Once in each cycle, before the rest, with what the drive showed last. A demand that was lost
    // (`isLost`: inputLost()) or began anew may be anywhere when it is back. So until it rests
    // where the axis is, each word of it that enables is a quick stop.
    void see(bool isLost, double position, std::int64_t modeDisplay, double seconds)
        CORTEX_REALTIME;
    // Targets and offsets as the mode that the drive shows takes them.
    drives::Ds402Inputs inputs(std::int64_t modeDisplay) const CORTEX_REALTIME;
    // The axis is held where it stands, whatever its demand does.
    bool waits() const CORTEX_REALTIME { return waits_ || isAwaited_; }
    // Replaces the parameters that its processor wishes.
    void wish(drives::Ds402Parameters& parameters) const CORTEX_REALTIME;

    void keep(Archive& archive) CORTEX_REALTIME { archive & joining_ & isAwaited_; }

private:
    Data<const std::int64_t> controlWord_, mode_, digitalOutputs_, homingMethod_, quickStopOption_,
        faultReactionOption_;
    Data<const double> position_, velocity_, effort_, homingSpeed_, homingCreep_, homeOffset_;
    Data<const bool> waits_;
    AxisTargets joining_;  // where the axis is
    bool isAwaited_ = false;
};

// The items of a Ds402Observation.
class Ds402ObservationItems {
public:
    explicit Ds402ObservationItems(const OutputSimplex& observation);

    // What the drive says. A status word that fits no state leaves `driveState` as it was.
    // `waits`: Ds402DemandItems::waits().
    void write(const drives::Ds402Outputs& outputs, double acceleration, bool waits)
        CORTEX_REALTIME;

    double position() const { return position_; }
    double countsPerUnit() const { return countsPerUnit_; }
    double ratedEffort() const { return ratedEffort_; }
    bool homingNeeded() const { return homingNeeded_; }

private:
    Data<std::int64_t> status_, statusWord_, driveState_, modeDisplay_, errorCode_, digitalInputs_;
    Data<bool> voltageEnabled_, warning_, remote_, targetReached_, internalLimit_, homed_;
    Data<double> position_, velocity_, acceleration_, effort_, followingError_, temperature_;
    double countsPerUnit_, ratedEffort_;
    bool homingNeeded_;
};

}  // namespace cortex::toolkit
