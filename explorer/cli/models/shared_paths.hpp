// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "models/model.hpp"

#include <span>

namespace cortex::cli {

// What two systems of one plant both have: an error for the name of an agent, whose second start is
// refused, and a warning for a path, which one of them owns while both run. Each is reported to the
// later of the two.
void checkSharedPaths(std::span<Model* const> systems);

}  // namespace cortex::cli
