// SPDX-License-Identifier: Apache-2.0
#include "agent_peers.hpp"

#include "ids.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::int64_t silence = 1'000'000'000;       // ns until one is lost
constexpr std::int64_t longestLead = 86'400'000'000;  // us that the clock of another may be ahead
constexpr std::size_t mostPeers = 1'024;
constexpr std::size_t longestName = 127;
constexpr std::size_t mostPaths = 100'000;  // in one interest

std::int64_t utcMicroseconds() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

std::size_t pathsIn(const Interest& interest) {
    std::size_t count = interest.links.size();
    for (const View& view : interest.views) count += view.prefixes.size();
    return count;
}

}  // namespace

AgentPeers::AgentPeers(AgentSelf& self, bool keepModels,
                       std::function<void(const std::string&, std::int64_t)> lost)
    : self_{self}, keepModels_{keepModels}, lost_{std::move(lost)} {}

bool AgentPeers::plausible(const std::string& name, std::int64_t epoch) {
    if (name.empty() || name.size() > longestName || epoch <= 0) {
        self_.rejections.add("a name or epoch that cannot be");
        return false;
    }
    if (epoch <= utcMicroseconds() + longestLead) return true;
    self_.rejections.add(name + " started in the future");
    if (std::exchange(early_, name) != name) {
        self_.event(Severity::Warning, self_.simplex,
                    name + " is not heard: its clock is more than a day ahead; set the clocks");
    }
    return false;
}

// A later start of our name outranks us; of an earlier one and of ourselves nothing is wanted.
bool AgentPeers::isOurs(const Presence& presence) {
    if (presence.name != self_.name) return false;
    if (presence.role != "agent") {
        self_.rejections.add("a " + presence.role + " uses our name");
    } else if (presence.epoch > self_.epoch && !std::exchange(outranked_, true)) {
        self_.event(Severity::Error, self_.simplex,
                    "a later start of " + self_.name + " is heard, on " + presence.host +
                        ": this one falls silent on the network");
    }
    return true;
}

void AgentPeers::take(const Presence& presence, std::int64_t now) {
    if (!plausible(presence.name, presence.epoch)) return;
    if (presence.agent != agentId(presence.name)) {
        return self_.rejections.add("the id of " + presence.name + " is not that of its name");
    }
    if (isOurs(presence)) return;
    if (Peer* peer = place(presence.name)) hear(*peer, presence, now);
}

Peer* AgentPeers::place(const std::string& name) {
    const auto found = peers_.find(name);
    if (found != peers_.end()) return &found->second;
    if (peers_.size() >= mostPeers) {
        const auto oldest = std::ranges::min_element(peers_, {}, [](const auto& each) {
            return std::pair{each.second.heard, each.second.lastHeard};
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

// Models come once: what a start has said is kept, it may be alive and the later one a mistake.
void AgentPeers::makeCurrent(Peer& peer, std::int64_t epoch) {
    if (peer.heard) lose(peer, "it started anew");
    if (peer.other && peer.other->model.epoch() == epoch) {
        std::swap(peer.current, peer.other);
    } else {
        if (peer.current && peer.current->model.complete()) peer.other = std::move(peer.current);
        peer.current.emplace(peer.name, epoch);
    }
    changed_ = true;
}

// An earlier start is outranked, but only by one that is heard: clocks are set back too.
void AgentPeers::hear(Peer& peer, const Presence& presence, std::int64_t now) {
    if (peer.current && presence.epoch < peer.epoch() &&
        (peer.heard || presence.state != "running")) {
        if (peer.other && peer.other->model.epoch() == presence.epoch) peer.other->spoke = now;
        return;
    }
    if (!peer.current || presence.epoch != peer.epoch()) makeCurrent(peer, presence.epoch);
    peer.current->spoke = now;
    const bool complete = peer.model().complete();
    if (!peer.current->model.add(presence)) {
        return self_.rejections.add("a presence of " + peer.name + " that cannot be");
    }
    changed_ = changed_ || peer.model().complete() != complete;
    if (presence.state == "stopping") return lose(peer, "it stopped");
    if (presence.state == "silent") return lose(peer, "it fell silent");
    peer.lastHeard = now;
    const bool agent = presence.role == "agent";
    changed_ = changed_ || agent != peer.agent || !peer.heard;
    peer.agent = agent;
    if (std::exchange(peer.heard, true)) return;
    if (peer.agent) {
        self_.event(Severity::Info, self_.simplex,
                    "agent " + peer.name + " is heard, from " + presence.host);
    }
}

void AgentPeers::lose(Peer& peer, const char* why) {
    if (!std::exchange(peer.heard, false)) return;
    changed_ = true;
    if (peer.agent) {
        self_.event(Severity::Warning, self_.simplex, "agent " + peer.name + " is lost: " + why);
    }
    lost_(peer.name, peer.epoch());
}

void AgentPeers::expire(std::int64_t now) {
    for (auto& [name, peer] : peers_) {
        if (peer.heard && now - peer.lastHeard > silence) lose(peer, "not heard for 1 s");
    }
}

void AgentPeers::take(const Model& model, std::int64_t now) {
    if (model.agent == self_.name) return;
    if (!plausible(model.agent, model.epoch)) return;
    Peer* peer = place(model.agent);
    if (peer == nullptr) return;
    if (peer->current && model.epoch == peer->epoch()) return takeInto(*peer->current, model);
    std::optional<PeerStart>& other = peer->other;
    if (!other || other->model.epoch() < model.epoch || now - other->spoke > silence) {
        if (!other || other->model.epoch() != model.epoch) other.emplace(peer->name, model.epoch);
    }
    if (other->model.epoch() != model.epoch) return;
    other->spoke = now;
    takeInto(*other, model);
}

void AgentPeers::takeInto(PeerStart& start, const Model& model) {
    if (model.interests.empty()) {
        if (!keepModels_) return;
        const bool complete = start.model.complete();
        if (!start.model.add(model)) {
            self_.rejections.add("a sample of the model of " + model.agent + " that cannot be");
        }
        changed_ = changed_ || start.model.complete() != complete;
        return;
    }
    const Interest& interest = model.interests.front();
    if (model.interests.size() != 1 || !model.types.empty() || !model.simplexes.empty() ||
        model.id != modelId(model.agent, "interest", interest.target) ||
        pathsIn(interest) > mostPaths) {
        return self_.rejections.add("an interest of " + model.agent + " that cannot be");
    }
    if (interest.target != self_.name) return;
    const bool ours = interest.targetEpoch == 0 || interest.targetEpoch == self_.epoch;
    start.interest = ours ? interest : Interest{};
    changed_ = true;
}

std::uint32_t AgentPeers::agents() const {
    const auto heard = std::ranges::count_if(
        peers_, [](const auto& each) { return each.second.heard && each.second.agent; });
    return static_cast<std::uint32_t>(heard);
}

}  // namespace cortex::comms
