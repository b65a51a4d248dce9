// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/toolkit/axis_controller.hpp"

#include <cstddef>
#include <optional>
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
// goes to 0 with half of each limit. Axes whose type states no acceleration have none. A target out
// of range counts as its end; before that end the axis brakes.
class FollowAxisController : public AxisController {
public:
    using AxisController::AxisController;

protected:
    void populate() override;
    bool stateStartingUp(const Tick& tick) CORTEX_REALTIME override;
    void takeOver(const Tick& tick) CORTEX_REALTIME override;
    void move(const Tick& tick) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

    // What an axis is to follow in this cycle, without the offset.
    virtual mechanics::MotionState target(std::size_t axis) CORTEX_REALTIME;

private:
    struct Target {
        Data<const double> position, velocity, acceleration;
        mechanics::Profile offset;
        double time = 0;      // s, since the offset began
        double within = 0;    // s, since the target came back into the range
        bool brakes = false;  // before the end of the range

        void keep(Archive& archive) { archive & offset & time & within & brakes; }
    };

    mechanics::MotionState aimOf(std::size_t axis) CORTEX_REALTIME;  // target(), in range
    void begin(std::size_t axis, double elapsed) CORTEX_REALTIME;    // an offset
    mechanics::MotionState withOffset(std::size_t axis) CORTEX_REALTIME;
    // The end of the range that an axis in this state could not stop before.
    std::optional<double> endBeyond(std::size_t axis, const mechanics::MotionState& state)
        CORTEX_REALTIME;
    void tellOutOfRange(std::size_t axis, double elapsed) CORTEX_REALTIME;

    std::vector<Target> targets_;
};

}  // namespace cortex::toolkit
