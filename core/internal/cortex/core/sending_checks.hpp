// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/core/structure.hpp"
#include "cortex/core/type_description.hpp"

#include <span>

namespace cortex {

// Whether other agents and tools could read what an agent with this tree, and the structure that
// was made of it, says of itself: its types, as checkDescribed() has it, and sizes as compared with
// what can be sent. For a tree of types without errors.
Report checkSending(const SimplexTree& tree, const Structure& structure);

// Whether these descriptions of types of this model are read as what they describe. Types that were
// once right are so for the rest of the process. Any thread.
Report checkDescribed(const TypeModel& types, std::span<const TypeDescription> described);

}  // namespace cortex
