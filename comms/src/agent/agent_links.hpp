// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent/agent_bound_links.hpp"
#include "agent/agent_peers.hpp"
#include "agent/misspelt_path.hpp"
#include "agent/transit_delay.hpp"

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace cortex::comms {

// Links the simplexes of other agents that ours name: finds their owners, binds them, and passes
// their samples to the loop.
//
// **Invariants**
// 1. The loop calls read(). Threads of DDS call take() for each block. The communication thread
//    calls the rest.
// 2. `mutex_` guards `owners_`, `delays_`, `newest_` and the buffers of `bound_`. take() holds it,
//    and so does update() while it binds and makes `owners_` anew. The loop never takes it.
// 3. `current` and `claims` belong to the communication thread.
class AgentLinks {
public:
    explicit AgentLinks(AgentSelf& self);  // throws Error if its interest could not be sent
    ~AgentLinks();                         // after the last read()

    bool any() const { return !links_.empty(); }
    bool anyUnbound() const;
    void update(Peers& peers);  // after the peers have changed
    // Tells of paths that nobody has and that are perhaps misspelt. In each step. `nameless`:
    // participants were found that have not said who they are.
    void tellMisspelt(const Peers& peers, bool nameless, std::int64_t now);
    void take(const Block& block, std::int64_t came);
    std::uint64_t lost() const { return lost_; }  // blocks that did not come; any thread
    std::set<std::string> owners() const;         // agents to which links exist
    // Who a remote simplex of ours is linked to; without structure: nobody.
    struct OwnerOf {
        std::string agent;
        std::int64_t epoch = 0;
        std::shared_ptr<const Structure> structure;
    };
    OwnerOf ownerOf(std::uint32_t simplex) const;
    Interest interest() const;  // what this agent wants of others
    // Whether to send the interest again, because an owner has sent nothing for a second.
    bool askAgain(std::int64_t now);
    // The owners whose loops go on, as their presences say, while nothing of them arrives: their
    // readers are to be made anew. Each is named once until something arrives.
    std::vector<std::string> takeStarving(const Peers& peers, std::int64_t now);

    void read(Inbox& inbox) CORTEX_REALTIME { bound_.read(inbox); }

private:
    struct Link {
        std::uint32_t simplex = noSimplex;
        std::map<std::string, LinkClaim> claims;  // by agent
        std::shared_ptr<BoundLink> current;       // null: nobody has it
    };
    // An agent whose blocks are wanted.
    struct Owner {
        std::int64_t epoch = 0;
        Id structureHash{};
        std::uint32_t simplexes = 0;
        std::int64_t patience = 0;     // ns; an older block that comes later than
                                       // this was not overtaken, and is taken
        std::uint64_t newest = 0;      // sequence number of the block
        std::int64_t newestCame = 0;   // monotonicNow()
        std::int64_t newestCycle = 0;  // of it
        std::int64_t since = 0;        // it is linked, monotonicNow()
        bool starved = false;          // since the newest came, and it was told
        std::shared_ptr<BoundGroup> group;
    };

    bool hasAny(const Peer& peer) const;
    void reportContradiction(Peer& peer) const;
    void claim(Link& link, Peer& peer);
    LinkClaim makeClaim(const Link& link, Peer& peer, std::uint32_t theirs) const;
    bool choose(Link& link);
    bool bind(Link& link, const std::string* agent);
    void offer();
    void findOwners();
    bool believable(const Block& block, const Owner& owner);
    LinkBuffer::Sample* take(const SimplexData& data, const Owner& owner);
    void refuse(BoundLink& bound, const std::string& wrong);

    AgentSelf& self_;
    MisspeltPath misspelt_;
    std::vector<Link> links_;
    BoundLinks bound_;
    std::mutex mutex_;
    std::map<Id, Owner> owners_;
    std::map<Id, TransitDelay> delays_;  // of present and former owners
    std::int64_t askDue_ = 0, misspeltDue_ = 0;
    std::uint64_t serial_ = 0;
    std::uint64_t newest_ = 0;  // number of the samples of a block
    std::atomic<std::uint64_t> lost_{0};
};

}  // namespace cortex::comms
