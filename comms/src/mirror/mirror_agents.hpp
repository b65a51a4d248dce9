// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"
#include "cortex/core/command_exchange.hpp"

#include "mirror/mirror_tables.hpp"
#include "peers/peer_model.hpp"
#include "peers/sent_commands.hpp"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace cortex::comms {

// One start of one agent.
struct MirrorAgent {
    MirrorAgent(const std::string& name, std::int64_t epoch, Moment now)
        : model{name, epoch}, heard{now} {}

    PeerModel model;
    Moment heard;                       // last
    Moment since{};                     // it is heard; none: it was there before
    bool lost = false, missed = false;  // missed: lost without saying so
    std::int64_t cycle = 0;             // newest
    std::int64_t clock = 0;             // its own, ns; 0: not said
    Moment clockHeard{};
    Moment moved{};                                 // when its newest cycle ended
    std::shared_ptr<const Structure> structure;     // once it is complete
    std::shared_ptr<const CommandTables> commands;  // once one was sent
    std::shared_ptr<MirrorTables> tables;           // once it is viewed, and from then on
    bool viewed = false;                            // at present
    std::uint64_t lastEvent = 0, eventLoss = 0;

    bool present() const { return model.presence().has_value(); }
    // It speaks no version of the protocol that this mirror does, so only its presence is known.
    bool foreign() const;
    // Whether it keeps its name although another start of it is heard.
    bool holdsName(Moment now) const;
    bool settled() const { return lost || foreign() || (present() && model.complete()); }
    std::chrono::nanoseconds patience() const;  // how long it may be silent
    AgentStatus status(Moment now) const;
    AgentImage image() const;                      // empty: nothing of it is viewed
    CommandTarget target();                        // throws Error where its structure has not come
    std::string standstillText(Moment now) const;  // empty: its loop runs
};

// The agents of the domain. Of several starts of one name the one that was heard first counts. An
// agent that is silent for longer than it announced is lost, and forgotten after a minute. Used
// under the mutex of the mirror.
class MirrorAgents {
public:
    using Map = std::map<std::string, MirrorAgent, std::less<>>;
    // Called for each start of an agent that is lost, withdrawn or replaced.
    using OnLost = std::function<void(const MirrorAgent& agent, const char* why)>;

    explicit MirrorAgents(OnLost onLost) : onLost_{std::move(onLost)} {}

    void take(const Presence& presence, Moment now);
    void take(const Model& model, Moment now);
    // The agent that has a new image now. Null: the block was refused.
    const MirrorAgent* take(const Block& block, const MirrorView& view, Moment now);
    // The event for the listeners. None: it was refused.
    std::optional<AgentEvent> take(const EventMessage& message);
    void withdraw(const Id& agent);
    void tick(const MirrorView& view, Moment now);
    void view(const MirrorView& view);  // another one from now on

    Map& all() { return agents_; }
    const Map& all() const { return agents_; }
    MirrorAgent* find(std::string_view name);
    MirrorAgent* ownerOf(std::string_view path);  // null: nobody owns it
    std::uint32_t present() const;                // number of agents and tools
    bool missesAny() const;                       // lost without saying so
    bool complete() const;                        // at least one agent, and everything of all
    std::uint32_t unheard() const;                // agents that only another agent hears
    bool eventsComplete() const;                  // all events of the present agents have come
    bool valuesComplete(const MirrorView& view) const;
    std::uint64_t images() const;  // published, of all together
    std::uint64_t refused() const;

private:
    MirrorAgent* at(const std::string& name, std::int64_t epoch, Moment now);
    Moment sinceAt(Moment now);
    std::optional<PeerModel> takeAside(const std::string& name, std::int64_t epoch);
    void setAside(const Model& model);
    void forget(MirrorAgent& agent);
    void lose(MirrorAgent& agent, const char* why);
    void finish(MirrorAgent& agent);

    OnLost onLost_;
    Moment began_{};
    Map agents_;
    std::map<std::string, PeerModel, std::less<>> aside_;  // of a start that may be alive
    std::map<Id, Moment> tools_;
    std::map<Id, std::string> names_;
    std::map<std::string, std::pair<std::int64_t, std::uint64_t>, std::less<>>
        newestEvents_;  // epoch and number, by agent
    std::uint64_t refused_ = 0, forgottenImages_ = 0;
};

}  // namespace cortex::comms
