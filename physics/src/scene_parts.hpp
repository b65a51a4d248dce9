// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/simplex.hpp"

#include "scene.hpp"

namespace cortex::physics {

// Parts of a scene as the constants of their simplexes state them, none of another agent. Setup
// phase. Throw Error where a type lacks an item.

// Its start is the position that was given for the axis, else that of its range next to 0.
Joint jointOf(const OutputSimplex& axis);
// Without its opening and its carrier.
Gripper gripperOf(const InputSimplex& manipulator);
Body bodyOf(const InputSimplex& body);

}  // namespace cortex::physics
