// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/mechanics/motion_profile.hpp"

#include <array>

namespace cortex::mechanics {

// The shortest change from a state to a velocity without acceleration: three phases, with jerks
// g J, 0, -g J. Starts at position 0.
struct VelocityStep {
    std::array<MotionPhase, 3> phases{};
    double duration = 0;  // s
    double way = 0;       // signed distance that it covers

    static VelocityStep plan(const MotionState& start, double velocity,
                             const MotionLimits& limits) noexcept;
};

// What the profiles of one axis from a state to rest at a target have in common, so that several
// axes can agree on a time. A profile is a step to a velocity vp, a cruise at vp, and a step to 0.
// Everything is mirrored so that the target lies ahead of where the axis would stop.
//
// Invariants
// - D(vp) is the way of both steps; the cruise has the rest of the way, so D(vp) must not exceed
// it.
// - D(0) is the way of the stop and never exceeds the way to the target.
// - Below the velocity vs, at which the axis would be if its acceleration went to 0, D may rise
//   above D(0) and come back: to brake in two parts takes more way. That is the hump.
// - So the velocities that can be had are [0, below_], and, behind the hump, [above_, top_].
// - The time of a profile falls with vp in each of the two. Times between both are the gap.
class ProfilePlanner {
public:
    ProfilePlanner(const MotionState& start, double target, const MotionLimits& limits) noexcept;

    // The shortest time that can be had and is not below `time`.
    double feasible(double time) const noexcept;
    // A time is one that feasible() gave. Nothing where a number left the range of double.
    std::optional<Profile> profile(double time) const noexcept;

    static Profile toVelocity(const MotionState& start, double velocity,
                              const MotionLimits& limits) noexcept;

private:
    struct Steps {
        VelocityStep first, last;
        double cruise = 0;  // s

        double duration() const noexcept { return first.duration + cruise + last.duration; }
    };

    double wayOfSteps(double velocity) const noexcept;
    bool fits(double velocity) const noexcept;
    Steps steps(double velocity) const noexcept;
    double timeAt(double velocity) const noexcept { return steps(velocity).duration(); }
    double topOfHump(double stopVelocity) const noexcept;
    double velocityFor(double time) const noexcept;
    void findVelocities() noexcept;

    MotionState start_;
    double target_;
    MotionLimits limits_;
    double direction_ = 1;
    MotionState ahead_;  // the start, mirrored, at position 0
    double way_ = 0;     // to the target, mirrored
    double tolerance_ = 0;
    bool stopsThere_ = false;  // the stop alone ends at the target
    bool behind_ = false;      // there are velocities behind the hump
    bool hump_ = false;
    double below_ = 0, above_ = 0, top_ = 0;
    double shortest_ = 0, gapBegin_ = 0, gapEnd_ = 0;  // s
};

}  // namespace cortex::mechanics
