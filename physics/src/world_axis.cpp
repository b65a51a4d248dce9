// SPDX-License-Identifier: Apache-2.0
#include "world_axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

namespace cortex::physics {
namespace {

constexpr double slow = 5e-3;        // rad/s or m/s: nearly at rest
constexpr double standstill = 1e-4;  // rad/s or m/s
constexpr double pushedBy = 1e-4;    // rad or m, behind the end of its range
constexpr double whole = 1 - 1e-9;   // of its greatest effort
constexpr double overshoot = 0.05;   // of its greatest speed

double boundOf(const std::optional<Number>& bound, double otherwise) {
    if (!bound) return otherwise;
    return std::visit([](auto number) { return static_cast<double>(number); }, *bound);
}

}  // namespace

WorldAxis::WorldAxis(const InputSimplex& demand, const OutputSimplex& observation,
                     const Joint& joint)
    : path_{joint.path},
      isRotary_{joint.isRotary},
      start_{joint.start},
      min_{joint.min},
      max_{joint.max},
      mostEffort_{joint.effort},
      slot_{&demand.state()},
      wishedPosition_{demand.data<double>("position")},
      wishedVelocity_{demand.data<double>("velocity")},
      wishedEffort_{demand.data<double>("effort")},
      position_{observation.data<double>("position")},
      velocity_{observation.data<double>("velocity")},
      acceleration_{observation.data<double>("acceleration")},
      effort_{observation.data<double>("effort")},
      status_{observation.data<std::int64_t>("status")} {
    const DataItem& velocity = *observation.type().findData("velocity");
    slowest_ = boundOf(velocity.min, -Joint::unlimited);
    fastest_ = boundOf(velocity.max, Joint::unlimited);
    position_ = start_;
    status_ = static_cast<std::int64_t>(AxisStatus::Braked);
}

JointDemand WorldAxis::wish() const {
    return {wishedPosition_, wishedVelocity_, wishedEffort_, false};
}

double WorldAxis::away(const JointState& now) const {
    if (std::abs(wishedVelocity_) > slow || std::abs(now.velocity) > slow)
        return std::numeric_limits<double>::infinity();
    return std::abs(wishedPosition_ - now.position);
}

double WorldAxis::beyond(const JointState& now) const {
    return std::max(min_ - now.position, now.position - max_);
}

void WorldAxis::show(const JointState& now, AxisStatus status) {
    position_ = std::clamp(now.position, min_, max_);
    const double speed = std::clamp(now.velocity, slowest_, fastest_);
    const bool overshoots = std::abs(now.velocity - speed) < overshoot * std::abs(speed);
    velocity_ = overshoots ? speed : now.velocity;
    acceleration_ = now.acceleration;
    effort_ = now.effort;
    status_ = static_cast<std::int64_t>(status);
}

AxisStatus WorldAxis::statusOf(const JointState& now) const {
    const bool pushes = now.strains || std::abs(now.effort) >= mostEffort_ * whole;
    if (pushes || beyond(now) > pushedBy) return AxisStatus::AtLimit;
    return std::abs(now.velocity) < standstill ? AxisStatus::Ready : AxisStatus::Moving;
}

}  // namespace cortex::physics
