// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/mechanics/motion_profile.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace cortex::mechanics {

// Axes that all come to rest at their targets at the same time, each within its own limits. May be
// used in a tick: planning allocates nothing and takes some microseconds for each axis. Plain data.
class SynchronousMove {
public:
    static constexpr std::size_t maxAxes = 16;

    // One element of each span for each axis. The move takes at least `atLeast` seconds, and the
    // time of the slowest axis. False, and nothing changes, where the spans are not of one length
    // up to maxAxes, or planPosition() would give nothing for an axis. To aim anew while the axes
    // move, plan from their present states.
    bool plan(std::span<const MotionState> starts, std::span<const double> targets,
              std::span<const MotionLimits> limits, double atLeast = 0) noexcept;

    // Brings each axis to rest as fast as its limits allow, wherever that is. Where planVelocity()
    // would give nothing, the axis stands at once. False as in plan(), for the spans.
    bool stop(std::span<const MotionState> starts, std::span<const MotionLimits> limits) noexcept;

    std::size_t size() const noexcept { return size_; }
    double duration() const noexcept { return duration_; }  // s
    const Profile& profile(std::size_t axis) const noexcept { return profiles_[axis]; }

    template <class Archive>
    void keep(Archive& archive) {
        archive & profiles_ & size_ & duration_;
    }

private:
    std::array<Profile, maxAxes> profiles_{};
    std::size_t size_ = 0;
    double duration_ = 0;
};

}  // namespace cortex::mechanics
