// SPDX-License-Identifier: Apache-2.0
#include "scene_parts.hpp"

#include "cortex/toolkit/axis_limits.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace cortex::physics {
namespace {

template <std::size_t Length, class Related>
std::array<double, Length> arrayOf(const Related& simplex, const char* item) {
    std::array<double, Length> values{};
    std::ranges::copy(simplex.template array<const double>(item).first(Length), values.begin());
    return values;
}
template <class Related>
Triple tripleOf(const Related& simplex, const char* item) {
    return arrayOf<3>(simplex, item);
}
template <class Related>
double numberOf(const Related& simplex, const char* item) {
    return simplex.template data<const double>(item);
}

}  // namespace

Joint jointOf(const OutputSimplex& axis) {
    const toolkit::AxisLimits limits{axis.type()};
    Joint joint;
    joint.path = axis.path();
    joint.isRotary = !axis.type().isA("LinearAxisConcept");
    joint.origin = tripleOf(axis, "originPosition");
    joint.originRotation = tripleOf(axis, "originRotation");
    joint.direction = tripleOf(axis, "direction");
    joint.mass = numberOf(axis, "linkMass");
    joint.centre = tripleOf(axis, "linkCentre");
    joint.inertia = arrayOf<6>(axis, "linkInertia");
    joint.armature = numberOf(axis, "armature");
    joint.damping = numberOf(axis, "damping");
    joint.friction = numberOf(axis, "friction");
    joint.size = tripleOf(axis, "linkSize");
    joint.min = limits.min;
    joint.max = limits.max;
    joint.effort = limits.effort;
    joint.start = axis.hasValue("position") ? numberOf(axis, "position")
                                            : std::clamp(0.0, limits.min, limits.max);
    return joint;
}

Gripper gripperOf(const InputSimplex& manipulator) {
    Gripper gripper;
    gripper.path = manipulator.path();
    gripper.mass = numberOf(manipulator, "bodyMass");
    gripper.centre = tripleOf(manipulator, "bodyCentre");
    gripper.inertia = arrayOf<6>(manipulator, "bodyInertia");
    gripper.size = tripleOf(manipulator, "bodySize");
    gripper.jawPosition = tripleOf(manipulator, "jawPosition");
    gripper.jawSize = tripleOf(manipulator, "jawSize");
    gripper.leastForce = numberOf(manipulator, "leastForce");
    return gripper;
}

Body bodyOf(const InputSimplex& simplex) {
    Body body;
    body.path = simplex.path();
    body.shape = static_cast<Body::Shape>(simplex.data<std::int64_t>("shape").get());
    body.size = tripleOf(simplex, "size");
    body.mass = numberOf(simplex, "mass");
    body.position = tripleOf(simplex, "position");
    body.rotation = tripleOf(simplex, "rotation");
    body.friction = numberOf(simplex, "friction");
    return body;
}

}  // namespace cortex::physics
