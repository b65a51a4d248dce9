// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent/agent_self.hpp"
#include "agent/first_of_name.hpp"
#include "peers/owners.hpp"
#include "peers/peer_model.hpp"
#include "wire/messages.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace cortex::comms {

class SecurityIdentity;

// One start of an agent or a tool: what it has, and what it wants of us.
struct PeerStart {
    PeerStart(const std::string& name, std::int64_t epoch, bool withSecurity = false)
        : model{name, epoch}, secured{withSecurity} {}

    Claimant claimTo(std::string_view path) const {
        const Rank rank = rankOf(model.agent(), path, secured, rights.get());
        return {model.agent(), rank, seniority};
    }

    PeerModel model;
    Interest interest;
    Seniority seniority;
    std::shared_ptr<const AgentRights> rights;  // that it shows; null: none, or not yet
    bool secured;
    std::int64_t spoke = 0;  // monotonicNow()
    bool reported = false;   // whether an event has said what is wrong with it
};

struct Peer {
    const PeerModel& model() const { return current->model; }
    std::int64_t epoch() const { return current->model.epoch(); }

    std::string name;
    bool heard = false;                // not long ago
    bool agent = false;                // or a tool
    bool missed = false;               // lost without a word
    std::string goodbye;               // why it ends, as it or somebody in its name says; or empty
    std::int64_t lastHeard = 0;        // monotonicNow()
    std::optional<PeerStart> current;  // its presence has come
    std::optional<PeerStart> other;  // another start of the name, or its presence has not come yet
};

using Peers = std::map<std::string, Peer, std::less<>>;  // by name

// The agents and tools of the domain from which presences arrive. Of several starts of one name the
// one that was heard first counts, until it is silent while another speaks. A participant that is
// silent for longer than it announced is lost. Everything that others send is checked.
// Communication thread only.
class AgentPeers {
public:
    // `lost` is called for each participant that is lost.
    AgentPeers(AgentSelf& self,
               std::function<void(const std::string& name, std::int64_t epoch)> lost,
               SecurityIdentity* identity = nullptr);

    void take(const Presence& presence, std::int64_t now);
    void take(const Model& model, std::int64_t now);
    void take(const Interest& interest, std::int64_t now);
    void expire(std::int64_t now);
    // Whether this process stood still. Again and again, before anything is taken.
    void look(std::int64_t now);

    // Whether anything became known or lost since the last call.
    bool takeChanged() { return std::exchange(changed_, false); }
    // Whether this process stood still since the last call, so long that others may soon forget it.
    bool takeStood() { return std::exchange(stood_, false); }
    bool isSecond() const { return name_.isSecond(); }  // another start of our name was first
    // Who else speaks in our name, in words; empty: nobody of late.
    std::string otherSelf(std::int64_t now) const { return name_.otherSelf(now); }
    // Whether a participant that is present has this name and another epoch.
    bool isOther(const std::string& name, std::int64_t epoch) const;
    Peers& all() { return peers_; }
    std::uint32_t agents() const;            // number of agents that are present
    std::uint32_t heard() const;             // agents and tools, this one included
    bool missesAny(std::int64_t now) const;  // agents that fell silent without a word, not long ago

private:
    bool plausible(const std::string& name, std::int64_t epoch);
    Peer* place(const std::string& name);
    void makeCurrent(Peer& peer, std::int64_t epoch);
    void hear(Peer& peer, const Presence& presence, std::int64_t now);
    void becameComplete(PeerStart& start);
    void sayIfKnown(const Peer& peer) const;
    void lose(Peer& peer, const std::string& why);
    PeerStart* startOf(const std::string& name, std::int64_t epoch, std::int64_t now);

    AgentSelf& self_;
    std::function<void(const std::string&, std::int64_t)> lost_;
    Peers peers_;
    SecurityIdentity* identity_;
    FirstOfName name_{self_};
    std::int64_t looked_ = 0;    // look() was called last
    std::int64_t stoodFor_ = 0;  // ns, since the last expire()
    bool changed_ = false, stood_ = false;
    std::string early_;  // whose clock was last said to be ahead
};

}  // namespace cortex::comms
