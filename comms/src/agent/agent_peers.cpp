// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_peers.hpp"

#include "security/security_identity.hpp"
#include "wire/ids.hpp"
#include "wire/presence_interval.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::int64_t longestAbsence = 600'000'000'000;  // ns until a lost agent is given up
constexpr std::int64_t longestLook = 500'000'000;         // ns between two looks of a live thread
constexpr std::size_t mostPeers = 1'024;
constexpr std::size_t longestAgentName = 127;
constexpr std::size_t mostPaths = 100'000;  // in one interest

std::size_t pathsIn(const Interest& interest) {
    std::size_t count = interest.links.size();
    for (const View& view : interest.views) count += view.prefixes.size();
    return count;
}

}  // namespace

AgentPeers::AgentPeers(AgentSelf& self, std::function<void(const std::string&, std::int64_t)> lost,
                       SecurityIdentity* identity)
    : self_{self}, lost_{std::move(lost)}, identity_{identity} {}

bool AgentPeers::plausible(const std::string& name, std::int64_t epoch) {
    if (name.empty() || name.size() > longestAgentName || epoch <= 0) {
        self_.rejections.add("a name or epoch that cannot be");
        return false;
    }
    if (isStart(epoch)) return true;
    self_.rejections.add(name + " started in the future");
    if (std::exchange(early_, name) != name) {
        self_.event(Severity::Warning, self_.simplex,
                    name + " is not heard: its clock is more than a day ahead; set the clocks");
    }
    return false;
}

void AgentPeers::take(const Presence& presence, std::int64_t now) {
    if (!plausible(presence.name, presence.epoch)) return;
    if (presence.agent != agentId(presence.name)) {
        return self_.rejections.add("the id of " + presence.name + " is not that of its name");
    }
    if (presence.name == self_.name) {
        if (presence.role == "agent") return name_.hear(presence, now);
        return self_.rejections.add("a " + presence.role + " uses our name");
    }
    if (Peer* peer = place(presence.name)) hear(*peer, presence, now);
}

Peer* AgentPeers::place(const std::string& name) {
    const auto found = peers_.find(name);
    if (found != peers_.end()) return &found->second;
    if (peers_.size() >= mostPeers) {
        const auto oldest = std::ranges::min_element(peers_, {}, [](const auto& each) {
            const Peer& peer = each.second;  // an agent that is back does not send its model again
            return std::tuple{peer.heard, peer.agent, peer.lastHeard};
        });
        if (oldest->second.heard) {
            self_.rejections.add("too many agents and tools in the domain");
            return nullptr;
        }
        peers_.erase(oldest);
    }
    Peer& peer = peers_[name];
    peer.name = name;
    return &peer;
}

// A model comes only once. So what a start has sent is kept: it may be alive, and the later one a
// mistake.
void AgentPeers::makeCurrent(Peer& peer, std::int64_t epoch) {
    if (peer.heard) lose(peer, "it started anew");
    if (peer.other && peer.other->model.epoch() == epoch) {
        std::swap(peer.current, peer.other);
    } else {
        if (peer.current && peer.current->model.complete()) peer.other = std::move(peer.current);
        peer.current.emplace(peer.name, epoch, identity_ != nullptr);
    }
    peer.goodbye.clear();
    changed_ = true;
}

void AgentPeers::hear(Peer& peer, const Presence& presence, std::int64_t now) {
    if (peer.current && presence.epoch != peer.epoch()) {
        const bool isHere =
            peer.heard && now - peer.lastHeard <= patienceWithRival(*peer.model().presence());
        if (isHere || presence.state != "running") {
            if (peer.other && peer.other->model.epoch() == presence.epoch) peer.other->spoke = now;
            return;
        }
    }
    if (!peer.current || presence.epoch != peer.epoch()) makeCurrent(peer, presence.epoch);
    peer.current->spoke = now;
    const bool complete = peer.model().complete();
    if (!peer.current->model.add(presence)) {
        return self_.rejections.add("a presence of " + peer.name + " that cannot be");
    }
    if (peer.model().complete() != complete) becameComplete(*peer.current);
    if (presence.state != "running") {
        peer.missed = false;
        peer.goodbye =
            presence.state == "silent" ? "another start of it was there first" : "it stopped";
        return;
    }
    peer.goodbye.clear();
    peer.lastHeard = now;
    if (peer.current->seniority.take(presence, now)) changed_ = true;
    const bool agent = presence.role == "agent";
    changed_ = changed_ || agent != peer.agent || !peer.heard;
    peer.agent = agent;
    peer.missed = false;
    if (!std::exchange(peer.heard, true) && peer.agent) {
        self_.event(Severity::Info, self_.simplex,
                    "agent " + peer.name + " was found, on host " + presence.host, EventKind::Loss);
    }
    if (!complete) sayIfKnown(peer);
}

// Only agents from which something is linked are reported.
void AgentPeers::sayIfKnown(const Peer& peer) const {
    if (!peer.agent || !peer.model().complete()) return;
    const Presence& presence = *peer.model().presence();
    self_.event(Severity::Info, self_.simplex,
                "agent " + peer.name +
                    " has described itself: " + std::to_string(presence.simplexes) +
                    " simplexes, " + std::to_string(presence.types) + " types");
}

void AgentPeers::lose(Peer& peer, const std::string& why) {
    if (!std::exchange(peer.heard, false)) return;
    changed_ = true;
    if (peer.agent) {
        self_.event(Severity::Warning, self_.simplex, "agent " + peer.name + " is lost: " + why,
                    EventKind::Loss);
    }
    lost_(peer.name, peer.epoch());
}

// A process that stood still (a debugger, a paused machine) heard nobody meanwhile.
void AgentPeers::look(std::int64_t now) {
    const std::int64_t last = std::exchange(looked_, now);
    if (last == 0 || now - last <= longestLook) return;
    stoodFor_ += now - last;
    stood_ = stood_ || now - last > leaseOfParticipant / 2;
    name_.stood(last, now);
}

void AgentPeers::expire(std::int64_t now) {
    look(now);
    name_.expire(now);
    const std::uint32_t crowd = agents();
    const std::int64_t stood = std::exchange(stoodFor_, 0);
    for (auto& [name, peer] : peers_) {
        if (!peer.heard) continue;
        peer.lastHeard = std::min(now, peer.lastHeard + stood);
        const Presence& presence = *peer.model().presence();
        const std::int64_t silence = now - peer.lastHeard;
        if (!peer.goodbye.empty() && silence > patienceAfterGoodbye(presence)) {
            lose(peer, peer.goodbye);
            continue;
        }
        const std::int64_t patience = patienceWith(presence, peer.agent ? crowd : 0);
        if (silence <= patience) continue;
        lose(peer, "nothing was received for " + std::to_string(patience / 1'000'000) + " ms");
        peer.missed = peer.agent;
    }
}

// Null: the sample is refused, or comes from an earlier start than those present.
PeerStart* AgentPeers::startOf(const std::string& name, std::int64_t epoch, std::int64_t now) {
    if (name == self_.name || !plausible(name, epoch)) return nullptr;
    Peer* peer = place(name);
    if (peer == nullptr) return nullptr;
    if (peer->current && epoch == peer->epoch()) return &*peer->current;
    std::optional<PeerStart>& other = peer->other;
    if (!other || other->model.epoch() < epoch || now - other->spoke > shortestPatience) {
        if (!other || other->model.epoch() != epoch) {
            other.emplace(name, epoch, identity_ != nullptr);
        }
    }
    if (other->model.epoch() != epoch) return nullptr;
    other->spoke = now;
    return &*other;
}

void AgentPeers::becameComplete(PeerStart& start) {
    changed_ = true;
    if (identity_ == nullptr) return;
    start.rights = identity_->shownBy(start.model.agent(), start.model.authority());
}

void AgentPeers::take(const Model& model, std::int64_t now) {
    PeerStart* start = startOf(model.agent, model.epoch, now);
    if (start == nullptr) return;
    const bool complete = start->model.complete();
    if (!start->model.add(model)) {
        self_.rejections.add("a sample of the model of " + model.agent + " that cannot be");
    }
    if (complete || !start->model.complete()) return;
    becameComplete(*start);
    const Peer& peer = peers_.at(model.agent);
    if (peer.current && start == &*peer.current) sayIfKnown(peer);
}

void AgentPeers::take(const Interest& interest, std::int64_t now) {
    if (interest.agent != agentId(interest.name) || pathsIn(interest) > mostPaths) {
        return self_.rejections.add("an interest of " + interest.name + " that cannot be");
    }
    PeerStart* start = startOf(interest.name, interest.epoch, now);
    if (start == nullptr) return;
    start->interest = interest;
    changed_ = true;
}

bool AgentPeers::isOther(const std::string& name, std::int64_t epoch) const {
    const auto found = peers_.find(name);
    return found != peers_.end() && found->second.heard && found->second.epoch() != epoch;
}

bool AgentPeers::missesAny(std::int64_t now) const {
    return std::ranges::any_of(peers_, [&](const auto& each) {
        return each.second.missed && now - each.second.lastHeard < longestAbsence;
    });
}

std::uint32_t AgentPeers::heard() const {
    const auto others =
        std::ranges::count_if(peers_, [](const auto& each) { return each.second.heard; });
    return static_cast<std::uint32_t>(others) + name_.heard();
}

std::uint32_t AgentPeers::agents() const {
    const auto heard = std::ranges::count_if(
        peers_, [](const auto& each) { return each.second.heard && each.second.agent; });
    return static_cast<std::uint32_t>(heard);
}

}  // namespace cortex::comms
