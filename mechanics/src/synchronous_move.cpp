// SPDX-License-Identifier: Apache-2.0
#include "cortex/mechanics/synchronous_move.hpp"

#include "profile_planner.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::mechanics {

bool SynchronousMove::plan(std::span<const MotionState> starts, std::span<const double> targets,
                           std::span<const MotionLimits> limits, double atLeast) noexcept {
    const std::size_t count = starts.size();
    if (count > maxAxes || targets.size() != count || limits.size() != count) return false;
    if (!std::isfinite(atLeast)) return false;
    std::array<std::optional<ProfilePlanner>, maxAxes> planners;
    for (std::size_t i = 0; i < count; ++i) {
        if (!limits[i].valid() || !starts[i].finite() || !std::isfinite(targets[i])) return false;
        planners[i].emplace(starts[i], targets[i], limits[i]);
    }
    // Each axis has at most one gap, so it makes the others wait at most twice.
    double time = std::max(0.0, atLeast);
    for (std::size_t round = 0; round < 2 * count; ++round) {
        const double before = time;
        for (std::size_t i = 0; i < count; ++i) time = planners[i]->feasible(time);
        if (time <= before) break;
    }
    std::array<Profile, maxAxes> profiles;
    double duration = time;
    for (std::size_t i = 0; i < count; ++i) {
        const std::optional<Profile> profile = planners[i]->profile(time);
        if (!profile) return false;
        profiles[i] = *profile;
        duration = std::max(duration, profile->duration());
    }
    profiles_ = profiles;
    size_ = count;
    duration_ = duration;
    return true;
}

bool SynchronousMove::stop(std::span<const MotionState> starts,
                           std::span<const MotionLimits> limits) noexcept {
    const std::size_t count = starts.size();
    if (count > maxAxes || limits.size() != count) return false;
    duration_ = 0;
    for (std::size_t i = 0; i < count; ++i) {
        profiles_[i] = planVelocity(starts[i], 0, limits[i])
                           .value_or(Profile::standing({starts[i].position, 0, 0}));
        duration_ = std::max(duration_, profiles_[i].duration());
    }
    size_ = count;
    return true;
}

}  // namespace cortex::mechanics
