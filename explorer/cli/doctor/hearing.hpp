// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror_data.hpp"

#include "doctor/diagnosis.hpp"

#include <cstdint>
#include <vector>

namespace cortex::cli {

// Whether agents that are heard here hear each other as well. `now` is UTC in microseconds; agents
// that have just started are left out, because they join still.
void examineHearing(const std::vector<comms::AgentStatus>& agents, std::int64_t now,
                    Diagnoses& found);

}  // namespace cortex::cli
