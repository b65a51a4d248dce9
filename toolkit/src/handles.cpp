// SPDX-License-Identifier: Apache-2.0
#include "handles.hpp"

#include "cortex/core/error.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace cortex::toolkit {
namespace {

Eigen::Vector3d vector(std::span<const double> values) { return {values[0], values[1], values[2]}; }

void copy(const Eigen::Vector3d& from, std::span<double> to) {
    for (Eigen::Index i = 0; i < 3; ++i) to[static_cast<std::size_t>(i)] = from[i];
}

// For a chain, which wants finite limits: more than any mechanism moves.
double finite(double value) { return std::clamp(value, -1e4, 1e4); }

}  // namespace

PoseInput::PoseInput(const InputSimplex& frame)
    : position{frame.array<double>("position")},
      rotation{frame.array<double>("rotation")},
      linearVelocity{frame.array<double>("linearVelocity")},
      angularVelocity{frame.array<double>("angularVelocity")},
      state{&frame.state()} {}

Pose PoseInput::pose() const {
    Pose pose{vector(position), {rotation[3], rotation[0], rotation[1], rotation[2]}};
    const double norm = pose.rotation.norm();
    if (norm > 0.5)
        pose.rotation.coeffs() /= norm;
    else
        pose.rotation.setIdentity();
    return pose;
}

Twist PoseInput::velocity() const {
    Twist twist;
    twist << vector(linearVelocity), vector(angularVelocity);
    return twist;
}

Enable::Enable(const InputSimplex& button, std::vector<const SlotState*> needed)
    : pressed_{button.data<bool>("value")} {
    needed.push_back(&button.state());
    for (const SlotState* state : needed) needed_.push_back({state});
}

bool Enable::update(bool lost) {
    usable_ = !lost;
    for (Needed& each : needed_) {
        if (each.state->quality == Quality::Good)
            each.good = true;
        else if (each.state->quality != Quality::Stale || each.state->time != each.time)
            each.good = false;
        each.time = each.state->time;
        usable_ = usable_ && each.good;
    }
    if (!usable_)
        released_ = false;
    else if (!pressed_)
        released_ = true;
    return pressed_ && released_;
}

PoseOutput::PoseOutput(const OutputSimplex& frame)
    : position{frame.array<double>("position")},
      rotation{frame.array<double>("rotation")},
      linearVelocity{frame.array<double>("linearVelocity")},
      angularVelocity{frame.array<double>("angularVelocity")} {}

void PoseOutput::write(const Pose& pose, const Twist& velocity) {
    copy(pose.position, position);
    copy(pose.rotation.vec(), rotation);
    rotation[3] = pose.rotation.w();
    copy(velocity.head<3>(), linearVelocity);
    copy(velocity.tail<3>(), angularVelocity);
}

AxisInput::AxisInput(const InputSimplex& axis)
    : position{axis.data<double>("position")},
      velocity{axis.data<double>("velocity")},
      acceleration{axis.data<double>("acceleration")} {}

AxisOutput::AxisOutput(const OutputSimplex& axis)
    : position{axis.data<double>("position")},
      velocity{axis.data<double>("velocity")},
      acceleration{axis.data<double>("acceleration")},
      effort{axis.data<double>("effort")} {}

void AxisOutput::write(double newPosition, double newVelocity, double newAcceleration) {
    position = newPosition;
    velocity = newVelocity;
    acceleration = newAcceleration;
    effort = 0.0;
}

std::vector<AxisInput> axisInputs(const std::vector<InputSimplex>& axes) {
    return {axes.begin(), axes.end()};
}

std::vector<AxisOutput> axisOutputs(const std::vector<OutputSimplex>& axes) {
    return {axes.begin(), axes.end()};
}

std::string_view whyStanding(std::int64_t status) {
    switch (status) {
        case 4:
            return "Fault";
        case 5:
            return "NotHomed";
        case 6:
            return "Disabled";
        case brakedStatus:
            return "Braked";
        default:
            return {};
    }
}

void requireSameCount(const Simplex& owner, std::size_t axes, std::size_t others,
                      const char* otherRule) {
    if (axes == others) return;
    throw Error(owner.path() + ": rule 'axes' has " + std::to_string(axes) + ", rule '" +
                otherRule + "' has " + std::to_string(others) +
                ": relate one for each axis, in the same order");
}

std::vector<mechanics::ChainJoint> chainJoints(const Simplex& owner,
                                               const std::vector<InputSimplex>& axes) {
    std::vector<mechanics::ChainJoint> joints;
    for (const InputSimplex& axis : axes) {
        if (axis.isRemote()) {
            throw Error(owner.path() + ": " + axis.path() +
                        " belongs to another agent, and its geometry comes when that is linked: "
                        "let the agent that has the axes compute their chain");
        }
        const AxisLimits limits{axis.type()};
        joints.push_back({vector(axis.array<double>("originPosition")),
                          vector(axis.array<double>("originRotation")),
                          vector(axis.array<double>("direction")),
                          axis.type().isA("LinearAxisConcept") ? mechanics::JointKind::Linear
                                                               : mechanics::JointKind::Rotary,
                          finite(limits.min), finite(limits.max), finite(limits.speed)});
    }
    return joints;
}

SerialChain chainOf(const Simplex& owner, const std::vector<InputSimplex>& axes,
                    std::span<const double> tipPosition, std::span<const double> tipRotation) {
    const std::vector<mechanics::ChainJoint> joints = chainJoints(owner, axes);
    const Eigen::Vector3d angles = vector(tipRotation);
    const Eigen::Quaterniond rotation = Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
                                        Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
                                        Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX());
    try {
        return SerialChain{joints, Pose{vector(tipPosition), rotation}};
    } catch (const std::invalid_argument& error) {
        throw Error(owner.path() + ": " + error.what());
    }
}

}  // namespace cortex::toolkit
