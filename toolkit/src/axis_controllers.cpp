// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/axis_controllers.hpp"

#include "handles.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::toolkit {

using mechanics::MotionLimits;
using mechanics::MotionState;
using mechanics::Profile;

namespace {

constexpr double quiet = 1;        // s
constexpr double rounding = 1e-9;  // rad or m

}  // namespace

void HoldAxisController::populate() {
    AxisController::populate();
    stops_.resize(axisCount());
}

void HoldAxisController::takeOver(const Tick&) {
    for (std::size_t i = 0; i < axisCount(); ++i) {
        const MotionState& now = demands()[i];
        stops_[i] = mechanics::planVelocity(now, 0, limits(i).motion())
                        .value_or(Profile::standing({now.position, 0, 0}));
    }
    time_ = 0;
}

void HoldAxisController::move(const Tick& tick) {
    time_ += tick.elapsedSeconds();
    for (std::size_t i = 0; i < axisCount(); ++i) demands()[i] = stops_[i].at(time_);
}

void HoldAxisController::keep(Archive& archive) {
    AxisController::keep(archive);
    archive.version("HoldAxisController", 2);
    archive & stops_ & time_;
}

void FollowAxisController::populate() {
    AxisController::populate();
    const auto targets = inputs("targets");
    requireSameCount(*this, axisCount(), targets.size(), "targets");
    for (const InputSimplex& target : targets) {
        targets_.push_back({target.data<double>("position"),
                            target.data<double>("velocity"),
                            target.data<double>("acceleration"),
                            {},
                            0,
                            0,
                            false});
    }
}

MotionState FollowAxisController::target(std::size_t axis) {
    const Target& target = targets_[axis];
    return {target.position, target.velocity, target.acceleration};
}

bool FollowAxisController::stateStartingUp(const Tick& tick) {
    for (Target& each : targets_) each.within = quiet;
    return AxisController::stateStartingUp(tick);
}

// A target that is no number goes on as it is, so that it puts the writer into Fault.
MotionState FollowAxisController::aimOf(std::size_t axis) {
    const MotionState aim = target(axis);
    const AxisLimits& range = limits(axis);
    if (range.inRange(aim.position) || !std::isfinite(aim.position)) return aim;
    return {std::clamp(aim.position, range.min, range.max), 0, 0};
}

void FollowAxisController::begin(std::size_t axis, double elapsed) {
    Target& to = targets_[axis];
    to.offset = Profile{};
    to.time = 0;
    to.brakes = false;
    if (!std::isfinite(limits(axis).acceleration)) return;
    const MotionState aim = aimOf(axis), now = demands()[axis];
    const MotionLimits half = limits(axis).motion();
    // Where the target was in the cycle before, which is when the demand was there.
    const double before = aim.position - elapsed * aim.velocity;
    const auto offset = mechanics::planPosition(
        {now.position - before, now.velocity - aim.velocity, now.acceleration - aim.acceleration},
        0, {half.velocity / 2, half.acceleration / 2, half.jerk / 2});
    if (offset) to.offset = *offset;
}

void FollowAxisController::takeOver(const Tick& tick) {
    for (std::size_t i = 0; i < axisCount(); ++i) {
        if (takesOver(i)) begin(i, tick.elapsedSeconds());
    }
}

MotionState FollowAxisController::withOffset(std::size_t axis) {
    const Target& to = targets_[axis];
    const MotionState aim = aimOf(axis), offset = to.offset.at(to.time);
    return {aim.position + offset.position, aim.velocity + offset.velocity,
            aim.acceleration + offset.acceleration};
}

std::optional<double> FollowAxisController::endBeyond(std::size_t axis, const MotionState& state) {
    const AxisLimits& range = limits(axis);
    if (!std::isfinite(range.acceleration)) return std::nullopt;
    const auto stop = mechanics::planVelocity(state, 0, range.motion());
    if (!stop) return std::nullopt;
    const double stands = stop->end().position;
    if (stands > range.max + rounding) return range.max;
    if (stands < range.min - rounding) return range.min;
    return std::nullopt;
}

// Once for each time out of range, and not again before it was within for a while.
void FollowAxisController::tellOutOfRange(std::size_t axis, double elapsed) {
    const AxisLimits& range = limits(axis);
    const double position = target(axis).position;
    double& since = targets_[axis].within;
    if (range.inRange(position) || !std::isfinite(position)) {
        since = std::min(quiet, since + elapsed);
        return;
    }
    const double end = position > range.max ? range.max : range.min;
    EventText text{"the target of "};
    text << demandPath(axis) << " is ";
    text.apart(position, end) << (position > end ? ", above " : ", below ");
    text.apart(end, position) << ": it stops there";
    if (since >= quiet) event(Severity::Warning, text);
    since = 0;
}

void FollowAxisController::move(const Tick& tick) {
    const double elapsed = tick.elapsedSeconds();
    for (std::size_t i = 0; i < axisCount(); ++i) {
        Target& to = targets_[i];
        const bool wasInRange = to.within > 0;
        tellOutOfRange(i, elapsed);
        const bool turns = wasInRange != (to.within > 0);
        if (turns || (to.brakes && !endBeyond(i, aimOf(i)))) begin(i, elapsed);
        to.time += elapsed;
        const MotionState next = withOffset(i);
        const auto end = endBeyond(i, next);
        const auto way =
            end ? mechanics::planPosition(demands()[i], *end, limits(i).motion()) : std::nullopt;
        to.brakes = way.has_value();
        demands()[i] = way ? way->at(elapsed) : next;
    }
}

void FollowAxisController::keep(Archive& archive) {
    AxisController::keep(archive);
    archive.version("FollowAxisController", 2);
    archive & targets_;
}

}  // namespace cortex::toolkit
