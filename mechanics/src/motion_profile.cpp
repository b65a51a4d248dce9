// SPDX-License-Identifier: Apache-2.0
#include "cortex/mechanics/motion_profile.hpp"

#include "profile_planner.hpp"

#include <cmath>

namespace cortex::mechanics {

bool MotionLimits::valid() const noexcept {
    return velocity > 0 && acceleration > 0 && jerk > 0 && std::isfinite(velocity) &&
           std::isfinite(acceleration);
}

bool MotionState::finite() const noexcept {
    return std::isfinite(position) && std::isfinite(velocity) && std::isfinite(acceleration);
}

MotionState MotionPhase::at(double time) const noexcept {
    return {begin.position +
                time * (begin.velocity + time * (begin.acceleration / 2 + time * jerk / 6)),
            begin.velocity + time * (begin.acceleration + time * jerk / 2),
            begin.acceleration + time * jerk};
}

MotionState Profile::at(double time) const noexcept {
    if (time >= duration_) {
        const double after = time - duration_;
        return {end_.position + after * end_.velocity, end_.velocity, end_.acceleration};
    }
    double left = time > 0 ? time : 0;
    for (const MotionPhase& phase : phases_) {
        if (left < phase.duration) return phase.at(left);
        left -= phase.duration;
    }
    return end_;
}

Profile Profile::standing(const MotionState& state) noexcept {
    Profile profile;
    profile.end_ = state;
    return profile;
}

std::optional<Profile> planVelocity(const MotionState& start, double velocity,
                                    const MotionLimits& limits) noexcept {
    if (!limits.valid() || !start.finite() || !std::isfinite(velocity)) return std::nullopt;
    const Profile profile = ProfilePlanner::toVelocity(start, velocity, limits);
    if (!std::isfinite(profile.duration()) || !profile.end().finite()) return std::nullopt;
    return profile;
}

std::optional<Profile> planPosition(const MotionState& start, double target,
                                    const MotionLimits& limits, double atLeast) noexcept {
    if (!limits.valid() || !start.finite() || !std::isfinite(target) || !std::isfinite(atLeast)) {
        return std::nullopt;
    }
    const ProfilePlanner planner{start, target, limits};
    return planner.profile(planner.feasible(atLeast));
}

}  // namespace cortex::mechanics
