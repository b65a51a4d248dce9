// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cortex::toolkit {

// Keeps one group of the controllers of some axes Active, and exchanges groups on command, without
// a gap and without a step of a demand. Until the new group is Active the one before goes on.
class AxisControllerSelector : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

protected:
    void populate() override;
    bool stateStartingUp(const Tick& tick) CORTEX_REALTIME override;
    void stateActive(const Tick& tick) CORTEX_REALTIME override;
    bool stateShuttingDown(const Tick& tick) CORTEX_REALTIME override;
    bool stateFault(const Tick& tick) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

    // The group that is to work from now on. False: no controller is in it.
    bool want(std::int64_t group) CORTEX_REALTIME;
    std::int64_t wanted() const { return wanted_; }

private:
    Outcome select(Call& call) CORTEX_REALTIME;
    HandOver exchange(std::int64_t group, const Tick& tick) CORTEX_REALTIME;

    std::vector<LifeCycleSender> choices_;
    std::span<const std::int64_t> group_;
    Data<std::int64_t> selected_, switchCount_;
    Argument<std::int64_t> newGroup_;
    std::int64_t wanted_ = 0;
    HandOver step_ = HandOver::Starting;
};

}  // namespace cortex::toolkit
