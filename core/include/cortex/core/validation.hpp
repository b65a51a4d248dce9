// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"
#include "cortex/core/simplex_tree.hpp"

namespace cortex {

// Every finding of a tree against its types and rules: a pure function, nothing is changed. Rules
// with `create` are as SimplexTree::createRelated() left them: call it before.
// Loops without a delayed relationship are found here too, printed whole by path.
Report validate(const SimplexTree& tree);

}  // namespace cortex
