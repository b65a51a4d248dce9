// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror_data.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace cortex::cli {

// The starts of agents, by name: what was read of one does not hold for the next.
using Starts = std::map<std::string, std::int64_t>;

// Those of which another start is there now, or none.
std::vector<std::string> startedAnew(const Starts& starts,
                                     const std::vector<comms::AgentStatus>& now);

}  // namespace cortex::cli
