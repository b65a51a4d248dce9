// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include "live/live.hpp"
#include "models/graph.hpp"

namespace cortex::cli {

// The types of all agents as one model. What several agents define in different ways is that of the
// first, by name, and is said on standard error.
TypeModel typesOf(Live& live);

// The structures of all agents as one: relationships across agents are joined.
Graph graphOf(Live& live);

}  // namespace cortex::cli
