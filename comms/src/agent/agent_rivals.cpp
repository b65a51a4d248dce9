// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_rivals.hpp"

#include "wire/presence_extras.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::size_t mostDecisions = 64, mostToldRivals = 64;

}  // namespace

AgentRivals::AgentRivals(const AgentSelf& self, const AgentRights* rights)
    : self_{self}, rights_{rights}, roots_{rootsOf(self.structure())} {}

bool AgentRivals::needsModels(const Peers& peers) const {
    return std::ranges::any_of(peers, [&](const auto& each) {
        const Peer& peer = each.second;
        return peer.heard && peer.agent && peer.current &&
               mayShare(textIn(*peer.model().presence(), rootPaths), roots_);
    });
}

std::vector<std::uint32_t> AgentRivals::sharedWith(const Peer& peer) const {
    std::vector<std::uint32_t> shared;
    if (!peer.model().complete()) return shared;
    const auto& simplexes = self_.structure().simplexes;
    for (std::uint32_t i = 0; i < simplexes.size(); ++i) {
        if (!simplexes[i].remote && peer.model().has(simplexes[i].path)) shared.push_back(i);
    }
    return shared;
}

void AgentRivals::update(const Peers& peers) {
    std::erase_if(rivals_, [&](const auto& each) { return !peers.contains(each.first); });
    for (auto& [name, rival] : rivals_) rival.present = false;
    std::set<std::uint32_t> contested;
    for (const auto& [name, peer] : peers) {
        if (!peer.agent || !peer.current ||
            !mayShare(textIn(*peer.model().presence(), rootPaths), roots_)) {
            continue;
        }
        Rival& rival = rivals_[name];
        if (rival.epoch != peer.epoch() || rival.shared.empty()) {
            rival.epoch = peer.epoch();
            rival.shared = sharedWith(peer);
        }
        rival.claimant = {name, Rank::Equal, peer.current->seniority};
        rival.present = peer.heard;
        if (rival.shared.empty()) continue;
        contested.insert(rival.shared.begin(), rival.shared.end());
        if (peer.heard) decide(rival);
    }
    refusals_.clear();
    for (const std::uint32_t simplex : contested) judge(simplex, peers);
    tellTakeovers();
}

// The one with the smaller name decides for both, once. The other follows its word, unless it was
// alone for long: then neither yields, and both say so.
void AgentRivals::decide(const Rival& rival) {
    const Seniority& theirs = rival.claimant.seniority;
    const Start start{rival.claimant.agent, rival.epoch};
    if (!decided_.contains(start)) {
        if (decided_.size() >= mostDecisions) decided_.erase(decided_.begin());
        const Claimant ours{self_.name, Rank::Equal, {self_.began, self_.began, {}}};
        const Claimant other{rival.claimant.agent, Rank::Equal, {theirs.heard, theirs.began, {}}};
        decided_[start] = wasFirst(ours, other, self_.began);
    }
    if (start.first > self_.name || theirs.heard - self_.began >= longAlone) return;
    if (theirs.saysFirst(start.first, self_.name)) decided_[start] = false;
    if (theirs.saysFirst(self_.name, start.first)) decided_[start] = true;
}

bool AgentRivals::isFirst(const Claimant& rival) const {
    const auto decided = decided_.find({rival.agent, rivals_.at(rival.agent).epoch});
    return decided == decided_.end() || decided->second;
}

bool AgentRivals::wasFirstHere(const Claimant& one, const Claimant& other) const {
    if (one.agent == self_.name) return isFirst(other);
    if (other.agent == self_.name) return !isFirst(one);
    return wasFirst(one, other, self_.began);
}

AgentPairs AgentRivals::says() const {
    AgentPairs pairs;
    for (const auto& [name, rival] : rivals_) {
        if (!rival.present || rival.shared.empty()) continue;
        pairs.emplace_back(self_.name, name);
        if (!isFirst(rival.claimant)) std::swap(pairs.back().first, pairs.back().second);
    }
    return pairs;
}

void AgentRivals::judge(std::uint32_t simplex, const Peers& peers) {
    const std::string& path = self_.structure().simplexes[simplex].path;
    const Rank rank = rankOf(self_.name, path, rights_ != nullptr, rights_);
    std::vector<Claimant> claimants{{self_.name, rank, {self_.began, self_.began, says()}}};
    for (const auto& [name, rival] : rivals_) {
        const bool claims = rival.present && std::ranges::binary_search(rival.shared, simplex);
        if (claims) claimants.push_back(peers.find(name)->second.current->claimTo(path));
    }
    const auto owner = ownerAmong(claimants, [this](const Claimant& one, const Claimant& other) {
        return wasFirstHere(one, other);
    });
    if (owner && *owner != 0) {
        const std::string reason = ownerReason(claimants, *owner, self_.began);
        refusals_[simplex] = path + " belongs to agent " + claimants[*owner].agent + ", " + reason;
        reasons_[simplex] = reason;
    }
    for (std::size_t i = 1; i < claimants.size(); ++i) {
        const Claimant& rival = claimants[i];
        const bool disputes =
            rival.rank == rank && rival.seniority.saysFirst(rival.agent, self_.name);
        Standing standing = disputes ? Standing::Disputes : Standing::Owner;
        if (owner && *owner != 0) standing = Standing::Yields;
        if (owner == 0 || *owner == i) tell(simplex, rival, standing);
    }
}

// Of a tree that two agents have, the top is told.
bool AgentRivals::isTop(std::uint32_t simplex, const Rival& rival) const {
    const auto& simplexes = self_.structure().simplexes;
    const std::string& path = simplexes[simplex].path;
    return std::ranges::none_of(rival.shared, [&](std::uint32_t each) {
        return path.starts_with(simplexes[each].path + "/");
    });
}

// Once for each pair of starts, and again when it changes.
void AgentRivals::tell(std::uint32_t simplex, const Claimant& rival, Standing standing) {
    const Rival& known = rivals_.at(rival.agent);
    if (!isTop(simplex, known)) return;
    const std::pair<std::uint32_t, Start> about{simplex, {rival.agent, known.epoch}};
    const auto told = told_.find(about);
    if (told != told_.end() ? told->second == standing : told_.size() >= mostToldRivals) return;
    told_[about] = standing;
    const std::string has = "agent " + rival.agent + " has it as well";
    switch (standing) {
        case Standing::Owner:
            return self_.event(Severity::Warning, simplex,
                               has + "; this agent owns it and gets the commands");
        case Standing::Yields:
            return self_.event(Severity::Error, simplex,
                               has + " and owns it, " + reasons_.at(simplex) +
                                   "; this agent refuses commands to it: stop one, or change its "
                                   "path");
        case Standing::Disputes:
            return self_.event(Severity::Error, simplex,
                               has +
                                   " and says that it was first, as this agent does: stop one "
                                   "of them");
        case Standing::Gone:
            return;  // tellTakeovers() does
    }
}

// Of paths that were told to be refused. One that has started anew says more by itself.
void AgentRivals::tellTakeovers() {
    std::uint32_t last = noSimplex;
    for (auto& [about, standing] : told_) {
        const auto& [simplex, start] = about;
        if (standing != Standing::Yields || refusals_.contains(simplex)) continue;
        standing = Standing::Gone;
        const auto rival = rivals_.find(start.first);
        const bool isHere = rival != rivals_.end() && rival->second.present;
        if (isHere || std::exchange(last, simplex) == simplex) continue;
        self_.event(Severity::Info, simplex,
                    "this agent owns it now, as agent " + start.first + " is gone");
    }
}

std::string AgentRivals::refusal(std::uint32_t simplex) const {
    const auto found = refusals_.find(simplex);
    return found == refusals_.end() ? "" : found->second;
}

}  // namespace cortex::comms
