// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent/agent_peers.hpp"
#include "agent/agent_self.hpp"
#include "peers/owners.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace cortex::comms {

// The paths of this agent that other agents have as well: who owns each of them, what this agent
// says of it, and which commands it refuses. What two agents once decided holds for these two
// starts, so a network that splits and heals changes nothing. Communication thread only.
class AgentRivals {
public:
    // `rights`: those of this agent, null without security.
    AgentRivals(const AgentSelf& self, const AgentRights* rights);

    const std::string& roots() const { return roots_; }
    // Whether one of the peers may have a path of ours, which only its model tells.
    bool needsModels(const Peers& peers) const;
    void update(const Peers& peers);  // after the peers have changed
    AgentPairs says() const;
    // Why commands to this simplex of ours are refused; empty: they are not.
    std::string refusal(std::uint32_t simplex) const;

private:
    using Start = std::pair<std::string, std::int64_t>;  // name and epoch
    enum class Standing { Owner, Yields, Disputes, Gone };
    struct Rival {
        std::int64_t epoch = 0;
        std::vector<std::uint32_t> shared;  // indexes of ours
        Claimant claimant;                  // without rank
        bool present = false;
    };

    std::vector<std::uint32_t> sharedWith(const Peer& peer) const;
    void decide(const Rival& rival);
    bool isFirst(const Claimant& rival) const;  // this agent, before it
    bool wasFirstHere(const Claimant& one, const Claimant& other) const;
    void judge(std::uint32_t simplex, const Peers& peers);
    void tell(std::uint32_t simplex, const Claimant& rival, Standing standing);
    void tellTakeovers();
    bool isTop(std::uint32_t simplex, const Rival& rival) const;

    const AgentSelf& self_;
    const AgentRights* rights_;
    const std::string roots_;
    std::map<std::string, Rival> rivals_;            // by name
    std::map<Start, bool> decided_;                  // whether this agent was first
    std::map<std::uint32_t, std::string> refusals_;  // by simplex
    std::map<std::uint32_t, std::string> reasons_;   // of the same, why their owner owns them
    std::map<std::pair<std::uint32_t, Start>, Standing> told_;
};

}  // namespace cortex::comms
