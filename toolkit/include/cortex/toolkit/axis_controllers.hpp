// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/toolkit/axis_controller.hpp"

#include <vector>

namespace cortex::toolkit {

// Brings the axes to rest within their limits, where they go on, and keeps them there.
class HoldAxisController : public AxisController {
public:
    using AxisController::AxisController;

protected:
    void populate() override;
    void takeOver(const Tick& tick) CORTEX_REALTIME override;
    void move(const Tick& tick) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

private:
    std::vector<mechanics::Profile> stops_;
    double time_ = 0;  // s, since the stop began
};

// Passes targets on as demands, each with an offset to where the axis was when it began; the offset
// goes to 0 with half of each limit. Axes whose type states no acceleration have none.
class FollowAxisController : public AxisController {
public:
    using AxisController::AxisController;

protected:
    void populate() override;
    void takeOver(const Tick& tick) CORTEX_REALTIME override;
    void move(const Tick& tick) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

    // What an axis is to follow in this cycle, without the offset.
    virtual mechanics::MotionState target(std::size_t axis) CORTEX_REALTIME;

private:
    struct Target {
        Data<const double> position, velocity, acceleration;
        mechanics::Profile offset;

        void keep(Archive& archive) { archive & offset; }
    };
    std::vector<Target> targets_;
    double time_ = 0;  // s, since the offsets began
};

}  // namespace cortex::toolkit
