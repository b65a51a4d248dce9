// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"
#include "cortex/core/image.hpp"

#include <cstdint>
#include <map>
#include <string>

namespace cortex::toolkit {

// One line for a terminal: cycle, duty cycle, overflows, how many simplexes are in which state.
std::string statusLine(const Image& image, const std::string& cluster);

// A table of the loop's metrics.
std::string metricsTable(const Image& image, const std::string& cluster);

// One more line of it.
std::string countLine(const std::string& title, std::uint64_t count);

// Paths of other agents that are not linked and without which a simplex cannot start, with that
// simplex.
using MissingLinks = std::map<std::string, std::string>;
MissingLinks missingLinks(const AgentRuntime& agent);

// Simplexes in Fault and why, a line each; "" if there is none.
std::string faultLines(const Image& image);

// Data of every simplex whose type is a Monitor.
std::string monitorTables(const Image& image);

}  // namespace cortex::toolkit
