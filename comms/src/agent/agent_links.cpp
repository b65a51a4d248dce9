// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_links.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/error.hpp"

#include "wire/cdr.hpp"
#include "wire/ids.hpp"

#include <algorithm>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::int64_t longestTime = std::int64_t{1} << 60U;  // ns: sums do not overflow
constexpr std::int64_t longestDetour = 100'000'000;           // ns that the network may add
constexpr std::int64_t longestStarving = 2 * nsPerSecond;     // or two of its patiences
constexpr std::int64_t betweenHints = 100'000'000;            // ns
constexpr std::size_t mostDelays = 1'000;
constexpr std::size_t mostTold = 8;  // reasons for which values of one link are refused

bool isTime(std::int64_t time) { return time >= 0 && time < longestTime; }
bool isWallClock(std::int64_t time) { return time >= 0 && time < std::int64_t{1} << 62U; }

// The index of the path if it is one of the owner's own simplexes.
std::uint32_t indexOf(const Structure* structure, const std::string& path) {
    const std::uint32_t index = structure != nullptr ? structure->find(path) : noSimplex;
    return index == noSimplex || structure->simplexes[index].remote ? noSimplex : index;
}

std::vector<std::uint32_t> remoteSimplexes(const Structure& structure) {
    std::vector<std::uint32_t> remote;
    for (std::uint32_t i = 0; i < structure.simplexes.size(); ++i) {
        if (structure.simplexes[i].remote) remote.push_back(i);
    }
    return remote;
}

}  // namespace

AgentLinks::AgentLinks(AgentSelf& self) : self_{self}, bound_{remoteSimplexes(self.structure())} {
    for (const std::uint32_t simplex : remoteSimplexes(self.structure())) {
        links_.emplace_back().simplex = simplex;
    }
    if (const std::size_t size = encodedSize(interest()); size > maxInOneDatagram) {
        throw Error{self.name + " reads " + std::to_string(links_.size()) +
                    " simplexes of other agents, whose paths take " + std::to_string(size) +
                    " octets: at most " + std::to_string(maxInOneDatagram) +
                    " can be asked for; use shorter paths, or divide the system among agents"};
    }
}

AgentLinks::~AgentLinks() = default;

bool AgentLinks::anyUnbound() const {
    return std::ranges::any_of(links_, [](const auto& each) { return each.current == nullptr; });
}

void AgentLinks::update(Peers& peers) {
    if (links_.empty()) return;
    for (auto& [name, peer] : peers) {
        if (hasAny(peer)) reportContradiction(peer);
    }
    for (Link& link : links_) {
        std::erase_if(link.claims, [&](const auto& each) { return !peers.contains(each.first); });
        for (auto& [name, peer] : peers) claim(link, peer);
    }
    const std::lock_guard lock{mutex_};
    bool isOther = false;
    for (Link& link : links_) isOther = choose(link) || isOther;
    if (isOther) offer();
    findOwners();
}

void AgentLinks::tellMisspelt(const Peers& peers, bool nameless, std::int64_t now) {
    if (now < misspeltDue_) return;
    misspeltDue_ = now + betweenHints;
    for (const Link& link : links_) {
        if (!link.claims.empty()) continue;
        const std::string& path = self_.structure().simplexes[link.simplex].path;
        const std::string hint = misspelt_.hint(path, peers, nameless, now);
        if (!hint.empty()) self_.event(Severity::Warning, link.simplex, "is not linked: " + hint);
    }
}

// Whether the peer has any simplex to be linked. Only then its model is compared and laid out.
bool AgentLinks::hasAny(const Peer& peer) const {
    return peer.current && std::ranges::any_of(links_, [&](const auto& link) {
               return peer.model().has(self_.structure().simplexes[link.simplex].path);
           });
}

// Reports a model that contradicts itself once, with the first contradiction.
void AgentLinks::reportContradiction(Peer& peer) const {
    if (!peer.heard || !peer.agent || peer.current->reported) return;
    PeerModel& model = peer.current->model;
    std::string why;
    try {
        if (model.structure() != nullptr || model.findings().ok()) return;
        why = std::ranges::find(model.findings().findings, Severity::Error, &Finding::severity)
                  ->text();
    } catch (const Error& error) {
        why = error.what();
    }
    peer.current->reported = true;
    self_.rejections.add("a model of " + peer.name + " that contradicts itself");
    self_.event(Severity::Error, self_.simplex, "nothing of " + peer.name + " is linked: " + why);
}

void AgentLinks::claim(Link& link, Peer& peer) {
    const std::string& path = self_.structure().simplexes[link.simplex].path;
    const auto known = link.claims.find(peer.name);
    if (known != link.claims.end()) {
        known->second.heard = peer.heard;
        if (peer.current) known->second.claimant = peer.current->claimTo(path);
        if (peer.current && known->second.epoch == peer.epoch()) return;
        link.claims.erase(known);
    }
    if (!peer.heard || !peer.agent) return;
    if (!peer.model().has(path)) return;
    const auto theirs = peer.current->model.structure();
    const std::uint32_t index = indexOf(theirs.get(), path);
    if (index == noSimplex) return;
    const LinkClaim& made = link.claims[peer.name] = makeClaim(link, peer, index);
    for (const Finding& finding : made.binding.findings.findings) {
        self_.event(finding.severity, link.simplex, peer.name + ": " + finding.text());
    }
}

LinkClaim AgentLinks::makeClaim(const Link& link, Peer& peer, std::uint32_t theirs) const {
    const Presence& presence = *peer.model().presence();
    const Structure& ours = self_.structure();
    LinkClaim claim;
    claim.epoch = peer.epoch();
    claim.claimant = peer.current->claimTo(ours.simplexes[link.simplex].path);
    claim.theirs = theirs;
    claim.simplexes = presence.simplexes;
    claim.structureHash = presence.structureHash;
    claim.structure = peer.current->model.structure();
    claim.heard = true;
    claim.binding = compileLink(*ours.simplexes[link.simplex].layout,
                                *claim.structure->simplexes[theirs].layout, *ours.types,
                                *claim.structure->types);
    const std::int64_t every = claim.structure->writtenEvery(theirs);
    claim.binding.period =
        std::clamp(presence.period, std::int64_t{0}, longestTime / every) * every;
    return claim;
}

// Of several agents that have the path its owner is linked. Whether that is another one now.
bool AgentLinks::choose(Link& link) {
    std::vector<Claimant> claimants;
    for (const auto& [agent, claim] : link.claims) {
        if (claim.heard && claim.binding.usable) claimants.push_back(claim.claimant);
    }
    const auto owner = ownerAmong(claimants, [&](const Claimant& one, const Claimant& other) {
        return wasFirst(one, other, self_.began);
    });
    for (const Claimant& each : claimants) {
        if (owner && each.agent == claimants[*owner].agent) continue;
        if (std::exchange(link.claims.at(each.agent).reported, true)) continue;
        self_.event(
            Severity::Error, link.simplex,
            owner ? each.agent + " claims it as well; " + claimants[*owner].agent + " stays linked"
                  : each.agent + " is not linked: its signed list owns other paths");
    }
    return bind(link, owner ? &claimants[*owner].agent : nullptr);
}

bool AgentLinks::bind(Link& link, const std::string* agent) {
    const LinkClaim* claim = agent != nullptr ? &link.claims.at(*agent) : nullptr;
    const bool same = link.current == nullptr ? claim == nullptr
                                              : claim != nullptr && link.current->agent == *agent &&
                                                    link.current->claim.epoch == claim->epoch;
    if (same) return false;
    link.current.reset();
    if (claim != nullptr) {
        link.current = std::make_shared<BoundLink>(++serial_, link.simplex, *agent, *claim);
        self_.event(Severity::Info, link.simplex, "linked to agent " + *agent);
    }
    return true;
}

void AgentLinks::offer() {
    std::vector<std::shared_ptr<BoundLink>> links;
    for (const Link& link : links_) links.push_back(link.current);
    bound_.offer(links);
}

void AgentLinks::findOwners() {
    std::map<Id, Owner> before;
    before.swap(owners_);
    if (delays_.size() > mostDelays) delays_.clear();
    for (const auto& group : bound_.groups()) {
        const LinkClaim& first = group->links.front()->claim;
        Owner& owner = owners_[agentId(group->agent())];
        owner.epoch = first.epoch;
        owner.structureHash = first.structureHash;
        owner.simplexes = first.simplexes;
        owner.group = group;
        owner.patience = longestDetour;
        for (const auto& link : group->links) {
            owner.patience = std::max(owner.patience, 3 * link->claim.binding.period);
        }
        const auto old = before.find(agentId(group->agent()));
        if (old != before.end() && old->second.epoch == first.epoch) {
            owner.newest = old->second.newest;
            owner.newestCame = old->second.newestCame;
            owner.newestCycle = old->second.newestCycle;
            owner.since = old->second.since;
            owner.starved = old->second.starved;
        }
        if (owner.since == 0) owner.since = monotonicNow();
    }
}

std::set<std::string> AgentLinks::owners() const {
    std::set<std::string> owners;
    for (const auto& group : bound_.groups()) owners.insert(group->agent());
    return owners;
}

AgentLinks::OwnerOf AgentLinks::ownerOf(std::uint32_t simplex) const {
    const auto found = std::ranges::find(links_, simplex, &Link::simplex);
    if (found == links_.end() || found->current == nullptr) return {};
    const BoundLink& bound = *found->current;
    return {bound.agent, bound.claim.epoch, bound.claim.structure};
}

Interest AgentLinks::interest() const {
    Interest interest;
    interest.agent = self_.id;
    interest.name = self_.name;
    interest.epoch = self_.epoch;
    for (const Link& link : links_) {
        interest.links.push_back(self_.structure().simplexes[link.simplex].path);
    }
    return interest;
}

// The owner may have forgotten this agent's interest, or somebody else may have sent one in its
// name.
bool AgentLinks::askAgain(std::int64_t now) {
    if (now < askDue_) return false;
    askDue_ = now + nsPerSecond;
    const std::lock_guard lock{mutex_};
    return std::ranges::any_of(owners_, [&](const auto& each) {
        const Owner& owner = each.second;
        return now - owner.newestCame > std::max(nsPerSecond, owner.patience);
    });
}

// A loop that stands still, or is stepped by hand, has nothing to send.
std::vector<std::string> AgentLinks::takeStarving(const Peers& peers, std::int64_t now) {
    std::vector<std::string> starving;
    const std::lock_guard lock{mutex_};
    for (const auto& [name, peer] : peers) {
        const auto found = owners_.find(agentId(name));
        if (found == owners_.end() || !peer.heard || !peer.current) continue;
        Owner& owner = found->second;
        const bool goesOn = peer.model().presence()->cycle > owner.newestCycle;
        const std::int64_t silence = now - std::max(owner.newestCame, owner.since);
        if (owner.starved || !goesOn || silence < std::max(longestStarving, 2 * owner.patience)) {
            continue;
        }
        owner.starved = true;
        starving.push_back(name);
        self_.event(Severity::Warning, self_.simplex,
                    "nothing linked has come from agent " + name + " for " +
                        std::to_string(silence / nsPerSecond) +
                        " s, although it runs; the link is made anew");
    }
    return starving;
}

bool AgentLinks::believable(const Block& block, const Owner& owner) {
    const char* wrong = nullptr;
    if (block.structureHash != owner.structureHash) wrong = "another structure";
    if (!isTime(block.nominalTime) || !isWallClock(block.wallClock) || block.cycle < 0) {
        wrong = "a time that cannot be";
    }
    if (block.simplexes.size() > owner.simplexes) wrong = "more simplexes than there are";
    if (wrong != nullptr) self_.rejections.add(std::string{"a block with "} + wrong);
    return wrong == nullptr;
}

void AgentLinks::take(const Block& block, std::int64_t came) {
    const std::lock_guard lock{mutex_};
    const auto found = owners_.find(block.agent);
    if (found == owners_.end()) return;
    Owner& owner = found->second;
    if (block.epoch != owner.epoch || !believable(block, owner)) return;
    // A block with an older number was overtaken. But if the newest one did not come from the
    // owner, nothing follows it, and the older ones count after a while.
    const bool older = block.sequenceNumber <= owner.newest;
    if (older && came - owner.newestCame < owner.patience) return;
    if (!older && owner.newest != 0) lost_ += block.sequenceNumber - owner.newest - 1;
    owner.newest = block.sequenceNumber;
    owner.newestCame = came;
    owner.newestCycle = block.cycle;
    owner.starved = false;
    // The time that a block spent in queues or waiting for a thread adds to its age.
    const std::int64_t delay =
        block.wallClock > 0 ? delays_[block.agent].next(block.wallClock, came) : 0;
    ++newest_;
    bool isNew = false;
    for (const SimplexData& data : block.simplexes) {
        LinkBuffer::Sample* const sample = take(data, owner);
        if (sample == nullptr) continue;
        sample->number = newest_;
        sample->age = std::max(block.nominalTime - data.time, std::int64_t{0}) + delay;
        sample->came = came;
        isNew = true;
    }
    if (isNew) owner.group->buffer.publish();
}

// Null: it is refused, or nobody wants it.
LinkBuffer::Sample* AgentLinks::take(const SimplexData& data, const Owner& owner) {
    if (data.index >= owner.simplexes) {
        self_.rejections.add("values of no simplex");
        return nullptr;
    }
    BoundGroup& group = *owner.group;
    const auto found = group.places.find(data.index);
    if (found == group.places.end()) return nullptr;
    BoundLink& bound = *group.links[found->second];
    const std::string wrong = misfit(data, bound.layout);
    if (!wrong.empty()) {
        refuse(bound, wrong);
        return nullptr;
    }
    LinkBuffer::Sample& sample = group.buffer.writable(found->second);
    storeValues(data, bound.layout, sample.values.slice());
    return &sample;
}

// Counted each time, and told on the simplex once for each reason.
void AgentLinks::refuse(BoundLink& bound, const std::string& wrong) {
    const std::string of = "values of " + bound.agent;
    const std::uint32_t simplex = bound.simplex;
    const std::string& path = self_.structure().simplexes[simplex].path;
    self_.rejections.add(of + " for " + path + ": " + wrong);
    if (bound.told.size() >= mostTold || !bound.told.insert(wrong).second) return;
    self_.event(Severity::Warning, simplex, of + " are refused: " + wrong);
}

}  // namespace cortex::comms
