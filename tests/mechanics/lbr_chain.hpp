// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/mechanics/serial_chain.hpp"

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

/// A posture with room to move in every direction, the tool pointing down.
inline SerialChain::JointVector lbrPosture() {
    SerialChain::JointVector posture(7);
    posture << 0, 0.6, 0, -1.4, 0, 1.1, 0;
    return posture;
}

}  // namespace cortex::mechanics::test
