// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include "text/output.hpp"

#include <cstdint>
#include <string>
#include <vector>

// What several live verbs print as JSON.
namespace cortex::cli {

std::int64_t milliseconds(double seconds);
Json agentJson(const comms::AgentStatus& agent);  // an element of schemas/agents.json
Json contestedJson(const comms::Contested& contested);
Json contestedJson(const std::vector<comms::Contested>& all, const std::string& agent);  // its own
Json eventJson(const comms::AgentEvent& event);  // an element of schemas/events.json
void printLine(const Json& json);                // on one line, at once

}  // namespace cortex::cli
