// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"
#include "cortex/core/simplex_tree.hpp"

#include <cstdint>

namespace cortex {

// Part: of a system, as in a test, whose program writes what no simplex does.
enum class Extent : std::uint8_t { Whole, Part };

// Every finding of a tree against its types and rules: a pure function, nothing is changed. Rules
// with `create` are as SimplexTree::createRelated() left them: call it before.
// Loops without a delayed relationship are found here too, printed whole by path.
Report validate(const SimplexTree& tree, Extent extent = Extent::Whole);

}  // namespace cortex
