// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"
#include "cortex/mechanics/motion_profile.hpp"

namespace cortex::toolkit {

// Limits that the type of an axis states, in rad or m, s, and N.m or N; infinite where it states
// none:
//   range         position.min, position.max
//   speed         velocity.max, -velocity.min and position.rate, the lowest one
//   acceleration  acceleration.max, -acceleration.min and velocity.rate, the lowest one
//   jerk          acceleration.rate
//   effort        effort.max, -effort.min, the lowest one
// Setup phase; what it gives may be read in a tick.
class AxisLimits {
public:
    explicit AxisLimits(const Type& axis);

    double min, max, speed, acceleration, jerk, effort;

    bool inRange(double position) const { return position >= min && position <= max; }

    // For profiles, with a share of the speed. What the type does not state is chosen: 1,000 per s;
    // the speed within 0.2 s; the acceleration within 0.1 s. A billionth stays unused, so that
    // rounding is no excess.
    mechanics::MotionLimits motion(double speedShare = 1) const;
};

}  // namespace cortex::toolkit
