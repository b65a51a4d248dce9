// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/mechanics/serial_chain.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace cortex::mechanics {

// About fixed axes, x first.
inline Eigen::Matrix3d fromRollPitchYaw(const Eigen::Vector3d& angles) {
    using Eigen::AngleAxisd;
    using Eigen::Vector3d;
    return (AngleAxisd(angles.z(), Vector3d::UnitZ()) * AngleAxisd(angles.y(), Vector3d::UnitY()) *
            AngleAxisd(angles.x(), Vector3d::UnitX()))
        .toRotationMatrix();
}

// Texts of what is wrong, a line each; setup phase.
inline std::string countFinding(std::size_t joints) {
    if (joints >= 1 && joints <= SerialChain::maxJoints) return {};
    return "\n  has " + std::to_string(joints) + " joints: give 1 to " +
           std::to_string(SerialChain::maxJoints);
}

inline std::string jointFinding(std::size_t place, const std::string& why) {
    return "\n  joint " + std::to_string(place + 1) + ": " + why;
}

inline std::string geometryFindings(std::size_t place, const ChainJoint& joint) {
    std::string text;
    if (!joint.origin.allFinite() || !joint.originRotation.allFinite()) {
        text += jointFinding(place, "origin is not finite: give numbers");
    }
    if (!(std::abs(joint.direction.norm() - 1) < 1e-3)) {
        text += jointFinding(place, "direction is no unit vector: give it the length 1");
    }
    return text;
}

}  // namespace cortex::mechanics
