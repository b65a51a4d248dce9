// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"

#include <cstdint>
#include <span>

namespace cortex::cs {

// An error for each demand whose writers different simplexes start and stop: one manager hands a
// demand over, and two know nothing of each other. `managers`: of each simplex by its index,
// noSimplex where group commands start it. After populate().
Report twoManagers(AgentRuntime& agent, std::span<const std::uint32_t> managers);

}  // namespace cortex::cs
