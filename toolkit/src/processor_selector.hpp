// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "handles.hpp"

#include <array>

namespace cortex::toolkit {

// Keeps one of two processors Active: the first while it is enabled and the
// hand moves, otherwise the second.
class ProcessorSelector final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    enum Choice : std::int64_t { None, WhileMoving, Otherwise };
    enum Reason : std::int64_t { NotActive, HandMoves, HandStill, NotEnabled, InputLost, Faulted };
    struct Managed {
        LifeCycleSender sender;
        std::int64_t askedAt = 0;  // ns; a startup that was refused is tried again later

        void keep(Archive& archive) { archive & askedAt; }
    };

    void populate() override;
    bool stateStartingUp(const Tick& tick) override;
    void stateActive(const Tick& tick) override;
    bool stateShuttingDown(const Tick& tick) override;
    bool stateFault(const Tick& tick) override;
    void keep(Archive& archive) override;

    bool handMoves(const Tick& tick);
    Reason reason(const Tick& tick);
    void select(Reason reason);
    bool stopAll();

    PoseInput hand_;
    Enable enable_;
    Data<const double> speedThreshold_, turnThreshold_, stillTime_;
    Data<std::int64_t> selected_, reason_, switchCount_;
    std::array<Managed, 2> choices_;  // WhileMoving, Otherwise
    double stillFor_ = 0;             // s
};

}  // namespace cortex::toolkit
