// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/simplex.hpp"

#include "scene.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cortex::physics {

// What a world is joined to, by the names of its rules.
struct WorldRelations {
    std::string path;  // of the world
    std::vector<InputSimplex> manipulators, arms, bodies, demands;
    std::vector<OutputSimplex> observations, bodyPoses, statuses;
};

// The scene, and which of the relations each part of it is.
struct SceneMap {
    Scene scene{};  // gravity and contact limit are as they were
    // Of each joint, in the order of the scene: its place among demands and observations.
    std::vector<std::size_t> axes{};
    // Of each gripper: the place of its status.
    std::vector<std::optional<std::size_t>> statuses{};
};

// A manipulator that is a Gripper is one here, any other SerialManipulator or OneDofManipulator is
// an arm. Constants are read through observations, manipulators and bodies. Setup phase. Throws
// Error with every finding, one in a line: path, rule, what to do.
SceneMap readScene(const WorldRelations& world);

}  // namespace cortex::physics
