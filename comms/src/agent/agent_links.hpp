// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent/agent_link_buffer.hpp"
#include "agent/agent_peers.hpp"
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

// The simplexes of other agents that ours name: finds their owners, binds them, and hands their
// samples to the loop. read() in the loop, take() on a thread of DDS as they come, the rest on the
// communication thread.
class AgentLinks {
public:
    explicit AgentLinks(AgentSelf& self);
    ~AgentLinks();  // after the last read()

    bool any() const { return !links_.empty(); }
    bool anyUnbound() const;
    void update(Peers& peers);  // after a change of them
    void take(const Block& block, std::int64_t came);
    std::uint64_t lost() const { return lost_; }  // blocks of owners that did not come; any thread
    std::set<std::string> owners() const;         // that we are linked to
    Interest interest() const;                    // what we want of others
    // Whether to say it again: an owner sends nothing for a second.
    bool askAgain(std::int64_t now);

    void read(Inbox& inbox) CORTEX_REALTIME;

private:
    // An agent that has the path, in one of its starts.
    struct Claim {
        std::int64_t epoch = 0;
        std::uint32_t theirs = noSimplex, simplexes = 0;
        Id structureHash{};
        std::shared_ptr<const Structure> structure;
        LinkBinding binding;
        bool heard = false;
        bool told = false;  // that another stays linked
    };
    // What the loop uses. It says which with `inUse`: that one is kept.
    struct Bound {
        Bound(std::uint64_t number, const std::string& owner, const Claim& claim);

        const std::uint64_t serial;
        const std::string agent;
        const Claim claim;
        const TypeLayout& layout;
        SliceMemory constants;
        LinkBuffer buffer;
    };
    struct Link {
        std::uint32_t simplex = noSimplex;
        std::map<std::string, Claim> claims;  // by agent
        Bound* current = nullptr;
        std::vector<std::unique_ptr<Bound>> kept;
        std::atomic<Bound*> offered{nullptr}, inUse{nullptr};
        std::uint64_t seen = 0;  // the loop's: serial of what it linked last
        bool live = false;
    };
    // Whose blocks are wanted.
    struct Owner {
        std::int64_t epoch = 0;
        Id structureHash{};
        std::uint32_t simplexes = 0;
        std::int64_t patience = 0;               // ns: a block that came later than this after
                                                 // the newest was not overtaken by it
        std::uint64_t newest = 0;                // sequence number of the block
        std::int64_t newestCame = 0;             // steadyNow()
        std::map<std::uint32_t, Bound*> bounds;  // by index there
    };

    bool hasAny(const Peer& peer) const;
    void tellWhyNot(Peer& peer) const;
    void claim(Link& link, Peer& peer);
    Claim makeClaim(const Link& link, Peer& peer, std::uint32_t theirs) const;
    void choose(Link& link);
    void bind(Link& link, const std::string* agent);
    void findOwners();
    bool believable(const Block& block, const Owner& owner);
    void take(const Block& block, const SimplexData& data, const Owner& owner, std::int64_t came,
              std::int64_t delay);
    void readLink(Link& link, Inbox& inbox, std::int64_t now) CORTEX_REALTIME;

    AgentSelf& self_;
    std::vector<std::unique_ptr<Link>> links_;
    std::mutex mutex_;  // of the next, and of what they name
    std::map<Id, Owner> owners_;
    std::map<Id, TransitDelay> delays_;  // of those who are or were owners
    std::int64_t askDue_ = 0;
    std::uint64_t serial_ = 0;
    std::atomic<std::uint64_t> lost_{0};
};

}  // namespace cortex::comms
