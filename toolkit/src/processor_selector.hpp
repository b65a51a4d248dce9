// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "handles.hpp"

#include <array>

namespace cortex::toolkit {

// Keeps one of two processors Active: the first while it is enabled and the hand moves, otherwise
// the second. Each goes on until the other one is Active, so there is no gap between them.
class ProcessorSelector final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    enum Choice : std::int64_t { None, WhileMoving, Otherwise };
    enum Reason : std::int64_t { NotActive, HandMoves, HandStill, NotEnabled, InputLost, Faulted };

    void populate() override;
    bool stateStartingUp(const Tick& tick) override;
    void stateActive(const Tick& tick) override;
    bool stateShuttingDown(const Tick& tick) override;
    bool stateFault(const Tick& tick) override;
    void keep(Archive& archive) override;

    bool handMoves(const Tick& tick);
    Reason reason(const Tick& tick);
    void select(Reason reason);
    bool stopAll(const Tick& tick);

    PoseInput hand_;
    Enable enable_;
    Data<const double> speedThreshold_, turnThreshold_, stillTime_;
    Data<std::int64_t> selected_, reason_, switchCount_;
    std::array<LifeCycleSender, 2> choices_;  // WhileMoving, Otherwise
    double stillFor_ = 0;                     // s
};

}  // namespace cortex::toolkit
