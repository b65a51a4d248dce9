// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/mechanics/inverse_dynamics.hpp"
#include "cortex/mechanics/serial_chain.hpp"

#include <cstddef>
#include <numbers>
#include <vector>

namespace cortex::mechanics::test {

inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// KUKA LBR iiwa 14 R820: lengths, limits and speeds from the maker's data sheet.
inline std::vector<ChainJoint> lbrJoints() {
    const auto joint = [](double height, const Eigen::Vector3d& direction, double limit,
                          double speed) {
        return ChainJoint{{0, 0, height},  {0, 0, 0},      direction,     JointKind::Rotary,
                          radians(-limit), radians(limit), radians(speed)};
    };
    return {joint(0, {0, 0, 1}, 170, 85),  joint(0.360, {0, 1, 0}, 120, 85),
            joint(0, {0, 0, 1}, 170, 100), joint(0.420, {0, -1, 0}, 120, 75),
            joint(0, {0, 0, 1}, 170, 130), joint(0.400, {0, 1, 0}, 120, 135),
            joint(0, {0, 0, 1}, 175, 135)};
}

inline SerialChain lbrChain() {
    return SerialChain(lbrJoints(), Pose{{0, 0, 0.126}, {1, 0, 0, 0}});
}

/// Masses and inertias of Drake's model of it; its maker publishes none. Armature, damping: chosen.
inline std::vector<DynamicJoint> lbrDynamics() {
    const std::vector<RigidBody> links{
        {5.76, {0, -0.03, 0.2775}, {0.0333, 0.033, 0.0123, 0, 0, 0}},
        {6.35, {-0.0003, 0.042, 0.059}, {0.0305, 0.011, 0.0304, 0, 0, 0}},
        {3.5, {0, 0.03, 0.3345}, {0.025, 0.0238, 0.0076, 0, 0, 0}},
        {3.5, {0, -0.034, 0.067}, {0.017, 0.006, 0.0164, 0, 0, 0}},
        {3.5, {-0.0001, -0.021, 0.2605}, {0.01, 0.0087, 0.00449, 0, 0, 0}},
        {1.8, {0, 0.0004, 0.0006}, {0.0049, 0.0036, 0.0047, 0, 0, 0}},
        {1.2, {0, 0, -0.025}, {0.001, 0.001, 0.001, 0, 0, 0}}};
    std::vector<ChainJoint> joints = lbrJoints();
    joints.back().origin.z() = 0.126;  // its frame is at the flange, as in the ontology
    std::vector<DynamicJoint> chain;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        chain.push_back({joints[i], links[i], 0.1, 0.5});
    }
    return chain;
}

/// A posture with room to move in every direction, the tool pointing down.
inline SerialChain::JointVector lbrPosture() {
    SerialChain::JointVector posture(7);
    posture << 0, 0.6, 0, -1.4, 0, 1.1, 0;
    return posture;
}

}  // namespace cortex::mechanics::test
