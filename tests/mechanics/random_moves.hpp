// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/mechanics/synchronous_move.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <span>
#include <vector>

namespace cortex::mechanics::test {

// Greatest share of its limits that an axis used, from its positions alone: finite differences over
// the cycle. It knows nothing of how the motion was planned.
struct UsedLimits {
    double velocity = 0, acceleration = 0, jerk = 0;

    void include(const UsedLimits& other) {
        velocity = std::max(velocity, other.velocity);
        acceleration = std::max(acceleration, other.acceleration);
        jerk = std::max(jerk, other.jerk);
    }
};

class DifferenceCheck {
public:
    DifferenceCheck(double position, double period) : period_{period} { last_.fill(position); }

    void add(double position, const MotionLimits& limits) {
        const double first = position - last_[0];
        const double second = first - (last_[0] - last_[1]);
        const double third = second - (last_[0] - 2 * last_[1] + last_[2]);
        used_.include({std::abs(first) / period_ / limits.velocity,
                       std::abs(second) / (period_ * period_) / limits.acceleration,
                       std::abs(third) / (period_ * period_ * period_) / limits.jerk});
        last_ = {position, last_[0], last_[1]};
    }
    const UsedLimits& used() const { return used_; }

private:
    double period_;
    std::array<double, 3> last_{};
    UsedLimits used_;
};

// Seven axes that go to random targets in random limits; a third of the moves is aimed anew on the
// way, up to three times. One axis in ten stays, one in twenty moves a millionth.
class RandomMoves {
public:
    static constexpr std::size_t axes = 7;
    static constexpr double period = 1e-3, range = 2;

    struct Result {
        UsedLimits used;
        double endError = 0;     // rad
        double spread = 0;       // s, between the arrivals of the axes that moved
        double beyondRange = 0;  // rad
        long samples = 0;
        int aimedAnew = 0, refused = 0;
    };

    // `accelerationFactor`: of the limit that the planner is told; 1 unless it is a mutant.
    // Without jerk limits: trapezoids.
    RandomMoves(unsigned seed, bool jerkLimited, double accelerationFactor = 1)
        : engine_{seed}, jerkLimited_{jerkLimited}, factor_{accelerationFactor} {}

    Result run(int moves) {
        for (int i = 0; i < moves; ++i) move(i % 3 == 0);
        return result_;
    }

private:
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    void begin() {
        for (std::size_t i = 0; i < axes; ++i) {
            const double jerk = between(20, 300);
            limits_[i] = {between(0.5, 2.4), between(1, 15),
                          jerkLimited_ ? jerk : std::numeric_limits<double>::infinity()};
            states_[i] = {between(-range, range), 0, 0};
            targets_[i] = between(-range, range);
            if (between(0, 1) < 0.1) targets_[i] = states_[i].position;
            if (between(0, 1) < 0.05) near(i, 1e-6);
        }
    }
    void near(std::size_t axis, double distance) {
        targets_[axis] =
            std::clamp(states_[axis].position + between(-distance, distance), -range, range);
    }
    void aimAnew() {
        ++result_.aimedAnew;
        for (std::size_t i = 0; i < axes; ++i) {
            targets_[i] = between(-range, range);
            if (between(0, 1) < 0.5) near(i, 0.05);
        }
    }
    void plan() {
        std::array<MotionLimits, axes> told = limits_;
        for (MotionLimits& limits : told) limits.acceleration *= factor_;
        if (!plan_.plan(states_, targets_, told)) ++result_.refused;
        double first = plan_.duration();
        for (std::size_t i = 0; i < axes; ++i) {
            const Profile& profile = plan_.profile(i);
            const bool moves = std::abs(states_[i].position - targets_[i]) > 1e-12;
            if (moves) first = std::min(first, profile.duration());
            const MotionState end = profile.at(profile.duration() * (1 - 1e-12));
            result_.endError = std::max({result_.endError, std::abs(end.position - targets_[i]),
                                         std::abs(profile.at(plan_.duration()).velocity)});
        }
        result_.spread = std::max(result_.spread, plan_.duration() - first);
        time_ = 0;
    }
    void move(bool aimsAnew) {
        begin();
        int left = aimsAnew ? static_cast<int>(between(1, 4)) : 0;
        std::vector<DifferenceCheck> checks;
        for (const MotionState& state : states_) checks.emplace_back(state.position, period);
        plan();
        for (bool ended = false; !ended || left > 0;) {
            time_ += period;
            ended = time_ >= plan_.duration();
            sample(checks);
            if (left > 0 && (ended || between(0, 1) < 0.003)) {
                --left;
                aimAnew();
                plan();
                ended = false;
            }
        }
        for (int i = 0; i < 4; ++i) {
            time_ += period;
            sample(checks);
        }
        for (const DifferenceCheck& check : checks) result_.used.include(check.used());
    }
    void sample(std::span<DifferenceCheck> checks) {
        for (std::size_t i = 0; i < axes; ++i) {
            states_[i] = plan_.profile(i).at(time_);
            checks[i].add(states_[i].position, limits_[i]);
            result_.beyondRange =
                std::max(result_.beyondRange, std::abs(states_[i].position) - range);
            ++result_.samples;
        }
    }

    std::mt19937_64 engine_;
    bool jerkLimited_;
    double factor_;
    std::array<MotionLimits, axes> limits_;
    std::array<MotionState, axes> states_;
    std::array<double, axes> targets_{};
    SynchronousMove plan_;
    double time_ = 0;
    Result result_;
};

}  // namespace cortex::mechanics::test
