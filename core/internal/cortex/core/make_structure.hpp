// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/simplex_tree.hpp"
#include "cortex/core/structure.hpp"

#include <memory>
#include <string>

namespace cortex {

// Builds the structure of a validated tree; tools use it to show a model without running it.
// Throws ModelError if the data takes more than 1 GiB.
std::shared_ptr<Structure> makeStructure(const std::string& agent, const SimplexTree& tree);

}  // namespace cortex
