// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/registry.hpp"

namespace cortex::toolkit {

// Registers the classes of the active types in robotics.xml (kinematics, axis controllers, clutch,
// selector, simulated axis, handset, monitor) and in process.xml. Setup phase.
void addClasses(ClassRegistry& registry);

}  // namespace cortex::toolkit
