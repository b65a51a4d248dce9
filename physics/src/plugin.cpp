// SPDX-License-Identifier: Apache-2.0
// What cortex-agent loads. The type is listed in cortex-mujoco.types, too.
#include "cortex/core/registry.hpp"

#include "mujoco_world.hpp"

namespace {

void addClasses(cortex::ClassRegistry& registry) {
    registry.add<cortex::physics::MujocoWorld>("MujocoWorld");
}

}  // namespace

CORTEX_PLUGIN(addClasses, {"MujocoWorld", ""})
