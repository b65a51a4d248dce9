// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/structure.hpp"
#include "cortex/core/transport.hpp"

#include "agent/agent_link_buffer.hpp"
#include "peers/owners.hpp"
#include "wire/ids.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace cortex::comms {

// An agent that has a path that we link, in one of its starts.
struct LinkClaim {
    std::int64_t epoch = 0;
    Claimant claimant;
    std::uint32_t theirs = noSimplex, simplexes = 0;
    Id structureHash{};
    std::shared_ptr<const Structure> structure;
    LinkBinding binding;
    bool heard = false;
    bool reported = false;  // whether an event has said that another stays linked
};

// One link to the agent that is linked. It never changes, except for `told`, which belongs to who
// takes blocks.
struct BoundLink {
    BoundLink(std::uint64_t number, std::uint32_t ours, const std::string& owner,
              const LinkClaim& claim);

    const std::uint64_t serial;   // it grows with each
    const std::uint32_t simplex;  // of ours
    const std::string agent;
    const LinkClaim claim;
    const TypeLayout& layout;
    SliceMemory constants;
    std::set<std::string> told;  // why values were refused; bounded
};

// All that is linked from one agent. It has one buffer, which the loop takes once a cycle. So what
// it reads there is of one cycle of that agent.
struct BoundGroup {
    explicit BoundGroup(std::vector<std::shared_ptr<BoundLink>> theirs);

    const std::string& agent() const { return links.front()->agent; }

    const std::vector<std::shared_ptr<BoundLink>> links;  // at least one
    std::map<std::uint32_t, std::size_t> places;          // in `links`, by index there
    LinkBuffer buffer;                                    // by place
    const LinkBuffer::Samples* taken = nullptr;           // the loop's, in this cycle
};

// Hands what is linked to the loop, and takes samples for it from the buffers.
//
// **Invariants**
// 1. The loop calls read(). One other thread calls the rest, and it alone makes and destroys an
//    Offer.
// 2. `offered_` is the Offer that the loop is to use. The loop writes the one that it uses to
//    `inUse_`, and then reads `offered_` again: if that has changed, it uses none in this cycle.
// 3. offer() writes `offered_` before it reads `inUse_`. All four accesses are sequentially
//    consistent. So offer() sees what the loop uses, or the loop sees that it must not use it.
// 4. offer() keeps the Offer that is offered and the one in use. It destroys all others: the loop
//    cannot reach them any more.
// 5. An Offer never changes after it is offered, except for the buffers of its groups and `taken`.
//    A group whose links stay goes into the next Offer as it is. Another one of that agent begins
//    with its samples.
// 6. The loop compares the serial of each link with that of the cycle before, so it notices a new
//    one even at the address of an old one. It then reports the link as lost before it takes
//    values of the new one.
// 7. The numbers of samples grow, over all agents. So the loop takes each only once, also from a
//    new group.
class BoundLinks {
public:
    explicit BoundLinks(const std::vector<std::uint32_t>& simplexes);  // ours that are linked

    // By link; null: nobody has it. Nobody fills a buffer meanwhile.
    void offer(const std::vector<std::shared_ptr<BoundLink>>& links);
    const std::vector<std::shared_ptr<BoundGroup>>& groups() const { return kept_.back()->groups; }

    void read(Inbox& inbox) CORTEX_REALTIME;

private:
    struct Place {
        const BoundLink* link = nullptr;
        const BoundGroup* group = nullptr;
        std::size_t place = 0;
    };
    struct Offer {
        std::vector<std::shared_ptr<BoundGroup>> groups;
        std::vector<Place> places;  // by link
    };
    // What the loop knows of a link.
    struct Seen {
        std::uint32_t simplex = noSimplex;
        std::uint64_t serial = 0;  // 0: nobody has it
        std::uint64_t number = 0;  // of the newest sample
        bool live = false;
    };

    std::shared_ptr<BoundGroup> groupOf(std::vector<std::shared_ptr<BoundLink>> links) const;
    static void read(Seen& seen, const Place& at, Inbox& inbox, std::int64_t now) CORTEX_REALTIME;

    std::vector<Seen> seen_;                    // by link
    std::vector<std::unique_ptr<Offer>> kept_;  // the last one is offered
    std::atomic<const Offer*> offered_{nullptr}, inUse_{nullptr};
};

}  // namespace cortex::comms
