// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"
#include "cortex/core/registry.hpp"

namespace cortex::cs {

// Setup phase. `registry`: where classes came from, to name those that were not taken; may be null.

// Whether it is to be run in every cycle of this agent.
bool hasTask(const SimplexInfo& info);

// A finding for each active simplex, the agent's own one aside, that no C++ class runs.
Report missingClasses(AgentRuntime& agent, const ClassRegistry* registry);

// An event of each simplex that runs the class of an ancestor of its type: somebody may have
// forgotten the plug-in that has one for the type itself.
void tellInheritedClasses(AgentRuntime& agent, const ClassRegistry* registry);

}  // namespace cortex::cs
