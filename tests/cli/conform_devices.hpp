// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/registry.hpp"

namespace cortex::test {

// The classes of tests/data/conform-types.xml.
void addConformDevices(ClassRegistry& registry);

}  // namespace cortex::test
