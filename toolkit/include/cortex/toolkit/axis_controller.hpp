// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/archive.hpp"
#include "cortex/cs/simplex_cs.hpp"
#include "cortex/mechanics/motion_profile.hpp"
#include "cortex/toolkit/axis_limits.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cortex::toolkit {

// What all that write the demands of axes have in common. Derive, and override move(). In each
// cycle it finds in demands() what went out in the cycle before, and leaves there what is to go out
// now, in rad or m and s. So a controller goes on from where another one stopped writing, in motion
// too, and not from the observation, which lags behind.
// While the drive of an axis says that it is in fault, not homed, disabled or braked, the demand of
// that axis is led back to the observed position within its limits, whatever move() leaves there.
class AxisController : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

protected:
    // Each calls that of the base first.
    void populate() override;
    bool stateStartingUp(const Tick& tick) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

    // Before move(), where demands() is not what this controller wrote: in its first Active cycle,
    // after a limit or a lost input, beside another writer, and while an axis is led back. Plan
    // anew from demands().
    virtual void takeOver(const Tick&) CORTEX_REALTIME {}
    virtual void move(const Tick& tick) CORTEX_REALTIME = 0;

    std::size_t axisCount() const { return axes_.size(); }
    std::span<mechanics::MotionState> demands() { return demands_; }
    // In takeOver(): whether the demand of this axis is not what was written.
    bool takesOver(std::size_t axis) const { return takenOver_[axis] != 0; }
    double observed(std::size_t axis) const { return axes_[axis].observed; }
    // The observed position, within the limits of the axis.
    double nearestInRange(std::size_t axis) const CORTEX_REALTIME {
        return axes_[axis].nearestInRange();
    }
    const AxisLimits& limits(std::size_t axis) const { return axes_[axis].limits; }
    const std::string& demandPath(std::size_t axis) const { return axes_[axis].path; }

    // Whether the drive of this axis goes where it is told; otherwise doesNotFollow() says why not.
    bool follows(std::size_t axis) const CORTEX_REALTIME;
    EventText doesNotFollow(std::size_t axis) const CORTEX_REALTIME;
    // It does not follow either, and its brake holds it.
    bool isBraked(std::size_t axis) const CORTEX_REALTIME;
    std::size_t firstThatDoesNotFollow() const CORTEX_REALTIME;  // axisCount(): all do
    // In a command, as inRange().
    bool allFollow(Call& call) const CORTEX_REALTIME;

    // In a command: whether a position is one that the axis may have. Otherwise the call has the
    // words why not, and is to be rejected: `if (!inRange(…)) return Outcome::Rejected;`
    bool inRange(Call& call, std::string_view item, std::size_t axis, double position) const
        CORTEX_REALTIME;

private:
    struct Axis {
        std::string path, observedPath;
        AxisLimits limits;
        Data<const double> observed;
        Data<const std::int64_t> status;
        Data<const double> acceptedPosition, acceptedVelocity, acceptedAcceleration;
        Data<double> position, velocity, acceleration, effort;

        mechanics::MotionState accepted() const CORTEX_REALTIME;
        void write(const mechanics::MotionState& state) CORTEX_REALTIME;
        double nearestInRange() const CORTEX_REALTIME;
        // A cycle later, on the way back to where the axis is.
        mechanics::MotionState ledBack(double seconds) const CORTEX_REALTIME;
    };

    void stateActive(const Tick& tick) CORTEX_REALTIME final;

    std::vector<Axis> axes_;
    std::vector<mechanics::MotionState> demands_;
    std::vector<std::uint8_t> takenOver_;
    bool takesOver_ = true;
};

}  // namespace cortex::toolkit
