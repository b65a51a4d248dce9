// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene.hpp"

#include <string>
#include <vector>

namespace cortex::physics {

// What is wrong with a scene: path, rule and remedy of each.
std::vector<std::string> findings(const Scene& scene);

}  // namespace cortex::physics
