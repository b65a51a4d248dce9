// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <optional>

// Motion of one axis whose velocity, acceleration and jerk stay within limits. All functions may be
// called in a tick: they allocate nothing, throw nothing and have loops of a stated length. Units
// are those of the axis: rad or m, and s.
namespace cortex::mechanics {

// Greatest magnitudes. Without a limit of the jerk the velocity is a trapezoid.
struct MotionLimits {
    double velocity = 0;
    double acceleration = 0;
    double jerk = std::numeric_limits<double>::infinity();

    // All above 0, no NaN, velocity and acceleration finite.
    bool valid() const noexcept;
};

struct MotionState {
    double position = 0;
    double velocity = 0;
    double acceleration = 0;

    bool finite() const noexcept;
    template <class Archive>
    void keep(Archive& archive) {
        archive & position & velocity & acceleration;
    }
};

// A time of constant jerk.
struct MotionPhase {
    double duration = 0;
    MotionState begin;
    double jerk = 0;

    MotionState at(double time) const noexcept;
    template <class Archive>
    void keep(Archive& archive) {
        archive & duration & begin & jerk;
    }
};

// A motion of at most seven phases: three that change the velocity, one that cruises, three that
// brake. It is plain data, so it may be copied and kept. Without being planned it stands at 0.
class Profile {
public:
    // State `time` seconds after the start. Before it the start; after the end the axis goes on
    // with the velocity of the end, which is 0 where planPosition() made the profile.
    MotionState at(double time) const noexcept;

    double duration() const noexcept { return duration_; }  // s
    const MotionState& end() const noexcept { return end_; }

    // A profile of no duration that ends in this state.
    static Profile standing(const MotionState& state) noexcept;

    template <class Archive>
    void keep(Archive& archive) {
        archive & phases_ & end_ & duration_;
    }

private:
    friend class ProfilePlanner;

    std::array<MotionPhase, 7> phases_{};
    MotionState end_;
    double duration_ = 0;
};

// The shortest change to a velocity, with no acceleration at its end: for jogging, and for a stop
// with velocity 0. It begins in any state; where that exceeds a limit, the profile leads back below
// it at once. Nothing where limits are not valid, or a number is not finite.
std::optional<Profile> planVelocity(const MotionState& start, double velocity,
                                    const MotionLimits& limits) noexcept;

// A motion from any state to rest at `target`, that takes at least `atLeast` seconds. From rest it
// is the shortest one. From a start in motion there may be a gap of times that cannot be had: then
// it ends at the end of the gap. Nothing where limits are not valid, or a number is not finite.
std::optional<Profile> planPosition(const MotionState& start, double target,
                                    const MotionLimits& limits, double atLeast = 0) noexcept;

}  // namespace cortex::mechanics
