// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/live.hpp"

#include <string>
#include <vector>

namespace cortex::cli {

// A simplex that made another one not good. `agent`: that has it; empty while none is heard.
struct Cause {
    std::string path, agent;
};

// From the nearest to the first that is known, also through the inputs of other agents.
std::vector<Cause> causesOf(Live& live, const FoundSimplex& simplex,
                            const comms::AgentImage& image);
// "/hand of station <- /tracker of station"; "" without any.
std::string causesText(const std::vector<Cause>& causes);

}  // namespace cortex::cli
