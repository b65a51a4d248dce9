// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene.hpp"

#include <string>

namespace cortex::physics {

// The scene in the language of MuJoCo. Bodies, joints, tendons and motors have the paths of the
// scene as their names. It judges nothing: see findings().
std::string mjcf(const Scene& scene);

// Name of the slide of one jaw, 1 or 2; an opening is the sum of both.
std::string jawName(const Gripper& gripper, int jaw);

}  // namespace cortex::physics
