// SPDX-License-Identifier: Apache-2.0
#include "agent/misspelt_path.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/nearest_names.hpp"

#include "wire/presence_extras.hpp"

#include <algorithm>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::int64_t nobodyNew = nsPerSecond, ownerComes = 10 * nsPerSecond;
constexpr std::int64_t awaitedFor = 60 * nsPerSecond;

bool isHeard(const Peer& peer) { return peer.agent && peer.heard && peer.current; }

// Whether all is here of an agent with a path of its own above this one. One that may have any
// path, also the root of all, does not say which.
bool isOwnerHere(const std::string& path, const Peers& peers) {
    return std::ranges::any_of(peers, [&](const auto& each) {
        const Peer& peer = each.second;
        if (!isHeard(peer) || !peer.model().complete()) return false;
        const std::string roots = textIn(*peer.model().presence(), rootPaths);
        return mayHave(roots, path) && !mayHave(roots, "/");
    });
}

// Whether an agent that has the path may be on its way.
bool mayCome(const std::string& path, const Peers& peers) {
    std::uint64_t here = 1, most = 0;  // this agent itself
    for (const auto& [name, peer] : peers) {
        if (!isHeard(peer)) continue;
        const Presence& presence = *peer.model().presence();
        if (!peer.model().complete() && mayHave(textIn(presence, rootPaths), path)) return true;
        ++here;
        most = std::max(most, numberIn(presence, agentsHeard));
    }
    return most > here;
}

}  // namespace

std::string MisspeltPath::hint(const std::string& path, const Peers& peers, bool nameless,
                               std::int64_t now) {
    Asked& asked = asked_[path];
    const auto isGone = [&](const std::string& each) { return !peers.contains(each); };
    std::erase_if(asked.agents, isGone);
    std::erase_if(asked.untold, isGone);
    for (const auto& [name, peer] : peers) {
        const bool known = isHeard(peer) && peer.model().complete();
        if (!known || !asked.agents.insert(name).second) continue;
        asked.untold.push_back(name);
        asked.news = now;
    }
    const std::int64_t quiet = now - asked.news;
    if (asked.untold.empty() || quiet < nobodyNew) return {};
    if (quiet < ownerComes && !isOwnerHere(path, peers)) return {};
    if (quiet < awaitedFor && (nameless || mayCome(path, peers))) return {};
    std::string text;
    for (const std::string& name : std::exchange(asked.untold, {})) {
        const Peer& peer = peers.at(name);
        const std::string nearest =
            isHeard(peer) ? nearestNames(path, peer.model().paths()) : std::string{};
        if (nearest.empty()) continue;
        text += (text.empty() ? "" : "; ") + name + " has no such simplex, " + nearest;
    }
    return text;
}

}  // namespace cortex::comms
