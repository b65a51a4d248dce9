// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/axis_controller.hpp"

#include "handles.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::toolkit {
namespace {

using mechanics::MotionState;

// Farther from what was written than by rounding.
bool differs(double accepted, double written) {
    return !(std::abs(accepted - written) <= 1e-9 * (1 + std::abs(written)));
}

bool differs(const MotionState& accepted, const MotionState& written) {
    return differs(accepted.position, written.position) ||
           differs(accepted.velocity, written.velocity);
}

}  // namespace

MotionState AxisController::Axis::accepted() const {
    return {acceptedPosition, acceptedVelocity, acceptedAcceleration};
}

void AxisController::Axis::write(const MotionState& state) {
    position = std::clamp(state.position, limits.min, limits.max);  // rounding is no excess
    velocity = state.velocity;
    acceleration = state.acceleration;
}

double AxisController::Axis::nearestInRange() const {
    return std::clamp<double>(observed, limits.min, limits.max);
}

MotionState AxisController::Axis::ledBack(double seconds) const {
    const MotionState now = accepted();
    const auto way = mechanics::planPosition(now, nearestInRange(), limits.motion());
    return way ? way->at(seconds) : MotionState{now.position, 0, 0};
}

void AxisController::populate() {
    const auto axes = inputs("axes");
    const auto demands = outputs("demands");
    requireSameCount(*this, axes.size(), demands.size(), "demands");
    for (std::size_t i = 0; i < demands.size(); ++i) {
        const OutputSimplex& demand = demands[i];
        axes_.push_back({demand.path(), axes[i].path(), AxisLimits{demand.type()},
                         axes[i].data<double>("position"), axes[i].data<std::int64_t>("status"),
                         demand.accepted<double>("position"), demand.accepted<double>("velocity"),
                         demand.accepted<double>("acceleration"), demand.data<double>("position"),
                         demand.data<double>("velocity"), demand.data<double>("acceleration"),
                         demand.data<double>("effort")});
    }
    demands_.resize(axes_.size());
    takenOver_.resize(axes_.size());
}

// The demand of an axis whose drive says that it follows stays where it is, and the axis with it.
bool AxisController::stateStartingUp(const Tick&) {
    takesOver_ = true;
    for (std::size_t i = 0; i < axes_.size() && !inputLost(); ++i) {
        const bool saysSo = axes_[i].status != unknownStatus && follows(i);
        const MotionState accepted = axes_[i].accepted();
        if (saysSo && accepted.velocity == 0) axes_[i].write(accepted);
    }
    return true;
}

void AxisController::stateActive(const Tick& tick) {
    bool changed = false;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const MotionState accepted = axes_[i].accepted();
        const bool others = takesOver_ || differs(accepted, demands_[i]);
        takenOver_[i] = others ? 1 : 0;
        changed = changed || others;
        demands_[i] = accepted;
        axes_[i].effort = 0.0;  // unless move() sets it
    }
    takesOver_ = false;
    if (changed) takeOver(tick);
    move(tick);
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        axes_[i].write(follows(i) ? demands_[i] : axes_[i].ledBack(tick.elapsedSeconds()));
    }
}

bool AxisController::follows(std::size_t axis) const {
    return whyStanding(axes_[axis].status).empty();
}

bool AxisController::isBraked(std::size_t axis) const { return axes_[axis].status == brakedStatus; }

std::size_t AxisController::firstThatDoesNotFollow() const {
    std::size_t axis = 0;
    while (axis < axes_.size() && follows(axis)) ++axis;
    return axis;
}

bool AxisController::allFollow(Call& call) const {
    const std::size_t axis = firstThatDoesNotFollow();
    if (axis == axes_.size()) return true;
    call.reject(Reason::State, doesNotFollow(axis).view());
    return false;
}

EventText AxisController::doesNotFollow(std::size_t axis) const {
    return EventText{axes_[axis].observedPath} << " does not follow: its drive says "
                                               << whyStanding(axes_[axis].status);
}

bool AxisController::inRange(Call& call, std::string_view item, std::size_t axis,
                             double position) const {
    const AxisLimits& limits = axes_[axis].limits;
    if (limits.inRange(position)) return true;
    const double limit = position > limits.max ? limits.max : limits.min;
    EventText why;
    why << item << "[" << axis << "] is ";
    why.apart(position, limit) << (position > limit ? ", above " : ", below ");
    why.apart(limit, position) << ", the limit of " << axes_[axis].path;
    call.reject(Reason::Range, why.view());
    return false;
}

void AxisController::keep(Archive& archive) {
    archive.version("AxisController", 1);
    archive & demands_ & takesOver_;
}

}  // namespace cortex::toolkit
