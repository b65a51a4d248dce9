// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "ds402/processor_axis.hpp"
#include "ds402/step_reasons.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace cortex::toolkit {

// Leads CiA 402 drives through their states and passes demands on to them. Derive, and add the axes
// in populate(). Fault codes: Ds402Faults.
class Ds402Processor : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

protected:
    void populate() override;  // call it first
    // In populate(), at most twice.
    void addAxis(const Ds402ProcessorAxis::Links& links);

    void loopStart(const Tick& tick) CORTEX_REALTIME override;
    void stateStandby(const Tick& tick) CORTEX_REALTIME override;
    bool stateStartingUp(const Tick& tick) CORTEX_REALTIME override;
    void stateActive(const Tick& tick) CORTEX_REALTIME override;
    bool stateShuttingDown(const Tick& tick) CORTEX_REALTIME override;
    bool stateFault(const Tick& tick) CORTEX_REALTIME override;
    void loopEnd(const Tick& tick) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

private:
    using Axis = Ds402ProcessorAxis;
    using Asks = bool (Axis::*)(EventText& why) const;
    using Acts = void (Axis::*)();

    void bindItems();
    void bindCommands();
    void bindSafety();
    // Of faults; of what is only told.
    void report(const Axis::Found& found) CORTEX_REALTIME;
    void reportOnly(const Axis::Found& found) CORTEX_REALTIME;
    void leadAll(const Tick& tick, bool faults) CORTEX_REALTIME;
    bool isSafetyStop() CORTEX_REALTIME;
    void stopForLostDemands(const Tick& tick) CORTEX_REALTIME;
    bool all(bool (*holds)(const Axis& axis)) const CORTEX_REALTIME;

    // The commands.
    Outcome enable(Call& call) CORTEX_REALTIME;
    Outcome disable(Call& call) CORTEX_REALTIME;
    Outcome quickStop(Call& call) CORTEX_REALTIME;
    Outcome resetFault(Call& call) CORTEX_REALTIME;
    Outcome step(Call& call) CORTEX_REALTIME;
    Outcome setMode(Call& call) CORTEX_REALTIME;
    Outcome home(Call& call) CORTEX_REALTIME;

    // Places of the axes that a command names, from `first` to before `end`.
    struct Range {
        std::size_t first = 0, end = 0;
    };
    std::optional<Range> rangeOf(Call& call, std::int64_t axis) CORTEX_REALTIME;
    Outcome forAll(Call& call, std::int64_t axis, Asks asks, Acts acts) CORTEX_REALTIME;
    Outcome forAny(Call& call, std::int64_t axis, Asks asks, Acts acts) CORTEX_REALTIME;
    Outcome stepToEnabled(Call& call, Axis& axis) CORTEX_REALTIME;
    Outcome beginHoming(Call& call) CORTEX_REALTIME;
    Outcome goOnHoming(Call& call) CORTEX_REALTIME;

    std::vector<Axis> axes_;
    Ds402Items items_;
    const StepReasons* reasons_ = nullptr;
    Data<const double> stepTimeout_;
    Data<double> progress_;
    Data<const bool> emergencyStop_, protectiveStop_;
    Argument<std::int64_t> enableAxis_, disableAxis_, stopAxis_, resetAxis_, stepAxis_, stepWord_,
        modeAxis_, newMode_, homeAxis_;
    Argument<double> homeTimeout_;

    State lastState_ = State::Standby;
    bool ran_ = false;                        // stateActive, in this cycle
    bool lostDemands_ = false;                // it did not, in the cycle before
    std::size_t homing_ = 0, homingEnd_ = 0;  // place of the axis; behind that of the last one
    double homed_ = 0;                        // s that `home` has waited, but for standstills
    std::size_t homingFirst_ = 0;
};

// Each drive moves an axis of its own.
class Ds402AxisProcessor final : public Ds402Processor {
public:
    using Ds402Processor::Ds402Processor;

private:
    void populate() override;
};

}  // namespace cortex::toolkit
