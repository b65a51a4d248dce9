// SPDX-License-Identifier: Apache-2.0
// Jerk-limited profiles from any state to rest, and the times in which they can end.
//   L. Biagiotti, C. Melchiorri, Trajectory Planning for Automatic Machines and Robots, Springer
//     2008, chapter 3: trapezoid and double-S profile
//   R. Haschke, E. Weitnauer, H. Ritter, On-line planning of time-optimal, jerk-limited
//     trajectories, IROS 2008, 3248-3253: the velocity step, and the search over the cruise
//   T. Kröger, F. M. Wahl, Online trajectory generation: basic concepts for instantaneous reactions
//     to unforeseen events, IEEE Trans. Robotics 26 (2010) 94-111: synchronous axes, and the gap
#include "profile_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cortex::mechanics {
namespace {

constexpr int mostHalvings = 100;  // from any velocity to where no double lies between
constexpr int goldenSections = 50;
constexpr double infinity = std::numeric_limits<double>::infinity();

// The last velocity between `low` and `high` that is not beyond something that grows with it.
template <class Beyond>
double bisect(double low, double high, Beyond beyond) {
    for (int i = 0; i < mostHalvings; ++i) {
        const double middle = (low + high) / 2;
        if (middle <= low || middle >= high) break;
        (beyond(middle) ? high : low) = middle;
    }
    return low;
}

MotionState mirrored(const MotionState& state, double direction, double position) {
    return {position + direction * state.position, direction * state.velocity,
            direction * state.acceleration};
}

}  // namespace

VelocityStep VelocityStep::plan(const MotionState& start, double velocity,
                                const MotionLimits& limits) noexcept {
    const double most = limits.acceleration, jerk = limits.jerk;
    const bool jerkLimited = std::isfinite(jerk);
    const double a = jerkLimited ? start.acceleration : 0;
    const double straight = start.velocity + a * std::abs(a) / (2 * jerk);
    const double sign = velocity >= straight ? 1 : -1;
    const double along = sign * a;
    const double change = sign * (velocity - start.velocity);
    double peak = most;
    double hold = 0;
    if (!jerkLimited) {
        hold = change / most;
    } else if (along > most) {  // as after a change of the limits
        hold = (change - along * along / (2 * jerk)) / most;
    } else {
        peak = std::sqrt(std::max(0.0, jerk * change + along * along / 2));
        if (peak > most) {
            peak = most;
            hold = (change - (2 * most * most - along * along) / (2 * jerk)) / most;
        }
    }
    const double up = jerkLimited ? std::abs(peak - along) / jerk : 0;
    const double down = jerkLimited ? peak / jerk : 0;
    const double jerkUp = jerkLimited ? std::copysign(jerk, sign * (peak - along)) : 0;
    const double jerkDown = jerkLimited ? -sign * jerk : 0;

    VelocityStep step;
    step.phases[0] = {up, {0, start.velocity, a}, jerkUp};
    MotionState next = step.phases[0].at(up);
    next.acceleration = sign * peak;
    step.phases[1] = {std::max(0.0, hold), next, 0};
    step.phases[2] = {down, step.phases[1].at(step.phases[1].duration), jerkDown};
    step.way = step.phases[2].at(down).position;
    step.duration = up + step.phases[1].duration + down;
    return step;
}

ProfilePlanner::ProfilePlanner(const MotionState& start, double target,
                               const MotionLimits& limits) noexcept
    : start_{start}, target_{target}, limits_{limits} {
    const VelocityStep stop = VelocityStep::plan(start, 0, limits);
    const double rest = target - start.position - stop.way;
    direction_ = rest >= 0 ? 1 : -1;
    ahead_ = mirrored(start, direction_, 0);
    ahead_.position = 0;
    way_ = direction_ * (target - start.position);
    tolerance_ = 4 * std::numeric_limits<double>::epsilon() *
                 (std::abs(target) + std::abs(start.position) + std::abs(stop.way));
    stopsThere_ = std::abs(rest) <= tolerance_;
    shortest_ = stop.duration;
    if (!stopsThere_) findVelocities();
}

double ProfilePlanner::wayOfSteps(double velocity) const noexcept {
    return VelocityStep::plan(ahead_, velocity, limits_).way +
           VelocityStep::plan({0, velocity, 0}, 0, limits_).way;
}

bool ProfilePlanner::fits(double velocity) const noexcept {
    return wayOfSteps(velocity) <= way_ + tolerance_;
}

ProfilePlanner::Steps ProfilePlanner::steps(double velocity) const noexcept {
    Steps steps{VelocityStep::plan(ahead_, velocity, limits_),
                VelocityStep::plan({0, velocity, 0}, 0, limits_)};
    const double rest = std::max(0.0, way_ - steps.first.way - steps.last.way);
    if (velocity > 0) steps.cruise = rest / velocity;
    return steps;
}

// D has one top below `stopVelocity`.
double ProfilePlanner::topOfHump(double stopVelocity) const noexcept {
    constexpr double ratio = 0.6180339887498949;
    double low = 0, high = stopVelocity;
    double left = high - ratio * (high - low), right = low + ratio * (high - low);
    double leftWay = wayOfSteps(left), rightWay = wayOfSteps(right);
    for (int i = 0; i < goldenSections; ++i) {
        if (leftWay > rightWay) {
            high = right;
            right = left;
            rightWay = leftWay;
            left = high - ratio * (high - low);
            leftWay = wayOfSteps(left);
        } else {
            low = left;
            left = right;
            leftWay = rightWay;
            right = low + ratio * (high - low);
            rightWay = wayOfSteps(right);
        }
    }
    return (low + high) / 2;
}

void ProfilePlanner::findVelocities() noexcept {
    const auto tooFar = [this](double velocity) { return !fits(velocity); };
    const double a = ahead_.acceleration;
    const double stop =
        std::clamp(ahead_.velocity + a * std::abs(a) / (2 * limits_.jerk), 0.0, limits_.velocity);
    behind_ = fits(stop);
    double hump = stop > 0 ? topOfHump(stop) : 0;
    if (wayOfSteps(stop) > wayOfSteps(hump)) hump = stop;
    hump_ = stop > 0 && !fits(hump);
    if (behind_) {
        top_ = fits(limits_.velocity) ? limits_.velocity : bisect(stop, limits_.velocity, tooFar);
        above_ =
            hump_ ? stop - bisect(0, stop - hump, [&](double less) { return !fits(stop - less); })
                  : 0;
    }
    if (hump_) below_ = bisect(0, hump, tooFar);
    if (!hump_ && !behind_) below_ = stop;
    const bool two = hump_ && behind_;
    shortest_ = timeAt(behind_ ? top_ : below_);
    gapBegin_ = two ? timeAt(above_) : infinity;
    gapEnd_ = two ? timeAt(below_) : infinity;
}

double ProfilePlanner::feasible(double time) const noexcept {
    const double longer = std::max(time, shortest_);
    return longer > gapBegin_ ? std::max(longer, gapEnd_) : longer;
}

double ProfilePlanner::velocityFor(double time) const noexcept {
    const bool upper = behind_ && time <= gapBegin_;
    const double high = upper ? top_ : below_;
    if (time <= shortest_) return high;
    return bisect(upper ? above_ : 0, high,
                  [&](double velocity) { return timeAt(velocity) < time; });
}

std::optional<Profile> ProfilePlanner::profile(double time) const noexcept {
    Profile profile;
    const double velocity = stopsThere_ ? 0 : velocityFor(time);
    const Steps steps = this->steps(velocity);
    MotionState from{start_.position, 0, 0};
    const auto add = [&](std::size_t at, const MotionPhase& phase, double before) {
        profile.phases_[at] = {phase.duration, mirrored(phase.begin, direction_, before),
                               direction_ * phase.jerk};
    };
    for (std::size_t i = 0; i < 3; ++i) add(i, steps.first.phases[i], from.position);
    from.position += direction_ * steps.first.way;
    add(3, {steps.cruise, {0, velocity, 0}, 0}, from.position);
    from.position += direction_ * steps.cruise * velocity;
    for (std::size_t i = 0; i < 3; ++i) add(4 + i, steps.last.phases[i], from.position);
    from.position += direction_ * steps.last.way;
    profile.duration_ = stopsThere_ ? std::max(time, steps.duration()) : steps.duration();
    profile.end_ = {target_, 0, 0};
    const double miss = std::abs(from.position - target_);
    const double scale = 1e-9 * (std::abs(way_) + std::abs(target_) + std::abs(start_.position) +
                                 std::abs(steps.first.way) + std::abs(steps.last.way));
    if (!std::isfinite(profile.duration_) || !(miss <= scale)) return std::nullopt;
    return profile;
}

Profile ProfilePlanner::toVelocity(const MotionState& start, double velocity,
                                   const MotionLimits& limits) noexcept {
    const VelocityStep step = VelocityStep::plan(start, velocity, limits);
    Profile profile;
    for (std::size_t i = 0; i < 3; ++i) {
        profile.phases_[i] = step.phases[i];
        profile.phases_[i].begin.position += start.position;
    }
    profile.duration_ = step.duration;
    profile.end_ = {start.position + step.way, velocity, 0};
    return profile;
}

}  // namespace cortex::mechanics
