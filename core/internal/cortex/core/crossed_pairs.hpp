// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"
#include "cortex/core/simplex_tree.hpp"

#include <span>

namespace cortex {

// Demands that a writer in the one tree and a reader in one of the others pair with different
// observations: finding `pair-crossed`. validate() asks so of a tree alone; of several agents the
// others are the trees that read its demands as remote ones.
void checkCrossedPairs(const SimplexTree& writers, std::span<const SimplexTree* const> readers,
                       Report& report);

}  // namespace cortex
