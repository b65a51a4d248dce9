// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_agents.hpp"
#include "wire/presence_extras.hpp"
#include "wire/presence_interval.hpp"

#include <algorithm>
#include <iterator>
#include <map>

// Who owns a path, as a mirror sees it.
namespace cortex::comms {
namespace {

bool hasOwn(const MirrorAgent& agent, std::string_view path) {
    if (!agent.structure) return false;
    const std::uint32_t index = agent.structure->find(path);
    return index != noSimplex && !agent.structure->simplexes[index].remote;
}

}  // namespace

Claimant MirrorAgents::claim(const MirrorAgent& agent, std::string_view path) const {
    const std::string& name = agent.model.agent();
    const Rank rank = rankOf(name, path, identity_ != nullptr, agent.rights.get());
    return {name, rank, agent.seniority, agent.lost};
}

std::vector<Claimant> MirrorAgents::claimants(std::string_view path, bool lost) const {
    std::vector<Claimant> all;
    for (const auto& [name, agent] : agents_) {
        if (hasOwn(agent, path) && (lost || !agent.lost)) all.push_back(claim(agent, path));
    }
    return all;
}

MirrorAgent* MirrorAgents::ownerOf(std::string_view path) {
    const std::vector<Claimant> all = claimants(path, true);
    const std::int64_t began = began_.time_since_epoch().count();
    const auto owner = ownerAmong(all, [&](const Claimant& one, const Claimant& other) {
        return wasFirst(one, other, began);
    });
    return owner ? find(all[*owner].agent) : nullptr;
}

bool MirrorAgents::isOwned(std::string_view path, Moment now, bool allKnown,
                           std::chrono::nanoseconds others) {
    const MirrorAgent* owner = ownerOf(path);
    if (owner == nullptr || owner->lost) return false;
    if (now - owner->known > others) return true;
    return allKnown && std::ranges::none_of(agents_, [&](const auto& each) {
               const MirrorAgent& agent = each.second;
               return !agent.settled() && agent.present() &&
                      mayHave(textIn(*agent.model.presence(), rootPaths), path);
           });
}

void MirrorAgents::findShared() {
    if (!std::exchange(structuresChanged_, false)) return;
    std::map<std::string_view, std::size_t> counts;
    for (const auto& [name, agent] : agents_) {
        if (agent.lost || !agent.structure) continue;
        const bool mayLack = identity_ != nullptr && agent.rights && !agent.rights->owns.empty();
        for (const SimplexInfo& info : agent.structure->simplexes) {
            if (info.remote) continue;
            const bool lacks = mayLack && claim(agent, info.path).rank == Rank::None;
            counts[info.path] += lacks ? 2 : 1;
        }
    }
    shared_.clear();
    for (const auto& [path, count] : counts) {
        if (count > 1) shared_.emplace_back(path);
    }
}

std::vector<Contested> MirrorAgents::contested() {
    findShared();
    const std::int64_t began = began_.time_since_epoch().count();
    std::vector<Contested> all;
    for (const std::string& path : shared_) {
        const std::vector<Claimant> claims = claimants(path, false);
        const auto owner = ownerAmong(claims, [&](const Claimant& one, const Claimant& other) {
            return wasFirst(one, other, began);
        });
        Contested& each = all.emplace_back();
        each.path = path;
        for (const Claimant& claim : claims) each.agents.push_back(claim.agent);
        if (owner) each.owner = claims[*owner].agent;
        if (owner) each.why = ownerReason(claims, *owner, began);
        each.text = ownerText(path, claims, began);
    }
    return all;
}

}  // namespace cortex::comms
