// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent/agent_peers.hpp"

#include <map>
#include <set>
#include <string>

namespace cortex::comms {

// Finds that a path which no agent has resembles one that an agent does have. Each agent is looked
// at once for each path, after all of its model has come. Communication thread only.
class MisspeltPath {
public:
    // "nearest of: …" with the agent; "" if nothing new resembles `path`.
    std::string hint(const std::string& path, const Peers& peers);

private:
    std::map<std::string, std::set<std::string>> asked_;  // agents, by path
};

}  // namespace cortex::comms
