// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/mechanics/synchronous_move.hpp"
#include "cortex/toolkit/axis_controller.hpp"
#include "cortex/toolkit/target_item.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cortex::toolkit {

// Brings the axes to a pose on command, all arriving at once; a new pose may be given on the way.
class AxisPoseController : public AxisController {
public:
    using AxisController::AxisController;

protected:
    void populate() override;
    void loopStart(const Tick& tick) CORTEX_REALTIME override;
    void settingsProposed(ProposedSettings& proposed) CORTEX_REALTIME override;
    void settingsChanged() CORTEX_REALTIME override;
    bool stateStartingUp(const Tick& tick) CORTEX_REALTIME override;
    void takeOver(const Tick& tick) CORTEX_REALTIME override;
    void move(const Tick& tick) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

    // From demands() to these positions; false where that cannot be planned.
    bool moveTo(std::span<const double> pose, double speedShare) CORTEX_REALTIME;
    // Brings all axes to rest.
    void stop() CORTEX_REALTIME;
    bool moves() const { return time_ < plan_.duration(); }
    // For a long command of a derived class, after moveTo(): whether it goes on, is there, is
    // cancelled, or an axis was lost on the way.
    Outcome proceed(Call& call) CORTEX_REALTIME;

private:
    enum Shape : std::int64_t { Trapezoid, JerkLimited };

    Outcome runMoveTo(Call& call) CORTEX_REALTIME;
    mechanics::MotionLimits limitsOf(std::size_t axis, double speedShare) const CORTEX_REALTIME;

    TargetItem pose_;
    Data<const std::int64_t> shape_;
    Data<double> progress_, remaining_;
    Argument<double> speedShare_;
    mechanics::SynchronousMove plan_;
    std::vector<mechanics::MotionLimits> planLimits_;
    std::vector<double> target_;
    double share_ = 1, time_ = 0;  // s, since the plan began
    bool aims_ = false, lost_ = false;
};

}  // namespace cortex::toolkit
