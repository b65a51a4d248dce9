// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics.hpp"
#include "scene.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace cortex::physics::test {

// The default of an item of a shipped type.
std::vector<double> shipped(const std::string& type, const std::string& item);
Triple shippedTriple(const std::string& type, const std::string& item);

// What the shipped types say of an LBR and of a 2F-85, from where the axes of both are to start.
constexpr std::array lbrPosture{0.0, 0.6, 0.0, -1.4, 0.0, 1.1, 0.0};
Arm shippedLbr(const std::array<double, 7>& start = lbrPosture);
Gripper shippedGripper();

// A carriage /lift on a vertical slide, with this gripper below it; its own frame is at the lift's
// position, its jaws 0.12 m lower.
Scene liftWith(const Gripper& gripper);
Body freeBody(const std::string& path, Body::Shape shape, const Triple& size, double mass,
              const Triple& position);
Body fixedBox(const std::string& path, const Triple& size, const Triple& position);

// Each joint where it is; braked, or not.
std::vector<JointDemand> staying(const Physics& physics, bool braked);

// Positions and velocities of all joints and bodies.
std::vector<double> stateOf(const Physics& physics);

}  // namespace cortex::physics::test
