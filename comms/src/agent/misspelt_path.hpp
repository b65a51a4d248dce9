// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent/agent_peers.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace cortex::comms {

// Finds that a path which no agent has resembles one that an agent does have. Each agent is looked
// at once for each path, after all of its model has come. At a start the owner of the path may come
// last. So nothing is said before nobody new has come for a second (ten where nobody has a path
// above it), while somebody who may have the path has not said all, and while somebody hears an
// agent that we do not. But who never says all is awaited for a minute only. Communication thread
// only.
class MisspeltPath {
public:
    // "nearest of: …" with the agent; "" if nothing new resembles `path`. `nameless`: participants
    // were found that have not said who they are. `now`: monotonicNow().
    std::string hint(const std::string& path, const Peers& peers, bool nameless, std::int64_t now);

private:
    struct Asked {
        std::set<std::string> agents;     // that were looked at
        std::vector<std::string> untold;  // of those
        std::int64_t news = 0;            // when the last of them came
    };

    std::map<std::string, Asked> asked_;  // by path
};

}  // namespace cortex::comms
