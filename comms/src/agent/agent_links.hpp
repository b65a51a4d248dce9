// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent/agent_link_buffer.hpp"
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
//    calls the rest, and it alone binds, unbinds and destroys a Bound.
// 2. `mutex_` guards `owners_`, `delays_` and the buffers that they lead to. take() holds it, and
//    so does update() while it binds and makes `owners_` anew. The loop never takes it.
// 3. `offered` is the Bound that the loop is to use, null without an owner. The loop writes the one
//    that it uses to `inUse`, and then reads `offered` again: if that has changed, it uses none in
//    this cycle.
// 4. bind() writes `offered` before it reads `inUse`. All four accesses are sequentially
//    consistent. So bind() sees what the loop uses, or the loop sees that it must not use it.
// 5. bind() keeps the Bound that is offered and the one in use. It destroys all others: the loop
//    cannot reach them any more.
// 6. A Bound never changes after it is offered, except for its LinkBuffer, which has one writer
//    (under `mutex_`) and one reader (the loop), and for `told`, which take() alone uses.
// 7. `serial` grows with each Bound. The loop compares it with `seen`, so it notices a new Bound
//    even at the address of an old one. It then reports the link as lost before it takes values of
//    the new one.
// 8. `seen` and `live` belong to the loop; `current`, `claims` and `kept` belong to the
//    communication thread.
class AgentLinks {
public:
    explicit AgentLinks(AgentSelf& self);  // throws Error if its interest could not be sent
    ~AgentLinks();                         // after the last read()

    bool any() const { return !links_.empty(); }
    bool anyUnbound() const;
    void update(Peers& peers);  // after the peers have changed
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

    void read(Inbox& inbox) CORTEX_REALTIME;

private:
    // An agent that has the path, in one of its starts.
    struct Claim {
        std::int64_t epoch = 0;
        Claimant claimant;
        std::uint32_t theirs = noSimplex, simplexes = 0;
        Id structureHash{};
        std::shared_ptr<const Structure> structure;
        LinkBinding binding;
        bool heard = false;
        bool reported = false;  // whether an event has said that another stays linked
    };
    // One link as the loop uses it.
    struct Bound {
        Bound(std::uint64_t number, std::uint32_t ours, const std::string& owner,
              const Claim& claim);

        const std::uint64_t serial;
        const std::uint32_t simplex;  // of ours
        const std::string agent;
        const Claim claim;
        const TypeLayout& layout;
        SliceMemory constants;
        LinkBuffer buffer;
        std::set<std::string> told;  // why values were refused; bounded
    };
    struct Link {
        std::uint32_t simplex = noSimplex;
        std::map<std::string, Claim> claims;  // by agent
        Bound* current = nullptr;
        std::vector<std::unique_ptr<Bound>> kept;
        std::atomic<Bound*> offered{nullptr}, inUse{nullptr};
        std::uint64_t seen = 0;  // serial of the Bound that the loop used last
        bool live = false;
    };
    // An agent whose blocks are wanted.
    struct Owner {
        std::int64_t epoch = 0;
        Id structureHash{};
        std::uint32_t simplexes = 0;
        std::int64_t patience = 0;               // ns; an older block that comes later than
                                                 // this was not overtaken, and is taken
        std::uint64_t newest = 0;                // sequence number of the block
        std::int64_t newestCame = 0;             // monotonicNow()
        std::int64_t newestCycle = 0;            // of it
        std::int64_t since = 0;                  // it is linked, monotonicNow()
        bool starved = false;                    // since the newest came, and it was told
        std::map<std::uint32_t, Bound*> bounds;  // by index there
    };

    bool hasAny(const Peer& peer) const;
    void reportContradiction(Peer& peer) const;
    void claim(Link& link, Peer& peer);
    Claim makeClaim(const Link& link, Peer& peer, std::uint32_t theirs) const;
    void choose(Link& link);
    void bind(Link& link, const std::string* agent);
    void findOwners();
    bool believable(const Block& block, const Owner& owner);
    void take(const Block& block, const SimplexData& data, const Owner& owner, std::int64_t came,
              std::int64_t delay);
    void refuse(Bound& bound, const std::string& wrong);
    void readLink(Link& link, Inbox& inbox, std::int64_t now) CORTEX_REALTIME;

    AgentSelf& self_;
    MisspeltPath misspelt_;
    std::vector<std::unique_ptr<Link>> links_;
    std::mutex mutex_;
    std::map<Id, Owner> owners_;
    std::map<Id, TransitDelay> delays_;  // of present and former owners
    std::int64_t askDue_ = 0;
    std::uint64_t serial_ = 0;
    std::atomic<std::uint64_t> lost_{0};
};

}  // namespace cortex::comms
