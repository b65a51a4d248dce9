// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"
#include "cortex/core/command_exchange.hpp"

#include "mirror/mirror_summary.hpp"
#include "mirror/mirror_tables.hpp"
#include "peers/owners.hpp"
#include "peers/peer_model.hpp"
#include "peers/sent_commands.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace cortex::comms {

class SecurityIdentity;

// One start of one agent.
struct MirrorAgent {
    MirrorAgent(const std::string& name, std::int64_t epoch, Moment now)
        : model{name, epoch}, heard{now} {}

    PeerModel model;
    Moment heard;                       // last
    Moment since{};                     // it is heard; none: it was there before
    bool lost = false, missed = false;  // missed: lost without saying so
    const char* goodbye = nullptr;      // why it ends, as it or somebody in its name says
    Seniority seniority;
    Moment known{};                             // its structure
    std::shared_ptr<const AgentRights> rights;  // that it shows; null: none
    std::int64_t cycle = 0;                     // newest
    std::int64_t clock = 0;                     // its own, ns; 0: not said
    Moment clockHeard{};
    Moment moved{};                                 // when its newest cycle ended
    std::shared_ptr<const Structure> structure;     // once it is complete
    std::shared_ptr<const CommandTables> commands;  // once one was sent
    std::shared_ptr<MirrorTables> tables;           // once it is viewed, and from then on
    bool viewed = false;                            // at present
    MirrorSummary summary;                          // empty: none has come
    std::uint64_t lastEvent = 0, eventLoss = 0;

    bool present() const { return model.presence().has_value(); }
    // It speaks no version of the protocol that this mirror does, so only its presence is known.
    bool foreign() const;
    // Whether it keeps its name although another start of it is heard.
    bool holdsName(Moment now) const;
    bool settled() const { return lost || foreign() || (present() && model.complete()); }
    bool isGone(Moment now) const;
    std::chrono::nanoseconds patience() const;  // how long it may be silent
    AgentStatus status(Moment now) const;
    AgentImage image() const;  // empty: nothing of it is viewed
    bool summarises() const;
    bool remembers() const;
    std::vector<SimplexMark> marks(Moment now) const;
    CommandTarget target();                        // throws Error where its structure has not come
    std::string standstillText(Moment now) const;  // empty: its loop runs
};

// The agents of the domain. Of several starts of one name the one that was heard first counts. An
// agent that is silent for longer than it announced is lost, and forgotten after a minute. Used
// under the mutex of the mirror.
class MirrorAgents {
public:
    using Map = std::map<std::string, MirrorAgent, std::less<>>;
    // Called for each start of an agent that has ended, was replaced or is forgotten.
    using OnLost = std::function<void(const MirrorAgent& agent, const char* why)>;

    explicit MirrorAgents(OnLost onLost) : onLost_{std::move(onLost)} {}

    void judgeBy(SecurityIdentity* identity) { identity_ = identity; }  // null: without security

    void take(const Presence& presence, Moment now);
    void take(const Model& model, Moment now);
    // The agent that has a new image now. Null: the block was refused.
    const MirrorAgent* take(const Block& block, std::size_t stream, Moment now);
    // False: the summary was refused.
    bool take(const Summary& summary, Moment now);
    // The event for the listeners. None: it was refused.
    std::optional<AgentEvent> take(const EventMessage& message);
    void withdraw(const Id& agent);
    void tick(const MirrorView& view, Moment now);
    // This process stood still for so long until now. It heard nobody meanwhile.
    void excuse(std::chrono::nanoseconds still, Moment now);
    void view(const MirrorView& view);  // another one from now on
    void forgetSummaries();

    Map& all() { return agents_; }
    const Map& all() const { return agents_; }
    MirrorAgent* find(std::string_view name);
    MirrorAgent* ownerOf(std::string_view path);  // null: nobody owns it
    // Whether its owner is there and nobody else who was found may be it. Others do not count when
    // everything of it is there for that time. `allKnown`: whether all that were found have said
    // who they are.
    bool isOwned(std::string_view path, Moment now, bool allKnown,
                 std::chrono::nanoseconds others = Mirror::timeToMeet);
    // Paths of several agents, or of one without a right to them.
    std::vector<Contested> contested();
    bool missesAny() const;  // lost without saying so
    bool hearsAny() const;
    bool awaitsAny(Moment now) const;  // missed so shortly that it may only stand still
    bool complete() const;             // at least one agent, and everything of all
    std::uint32_t unheard() const;     // agents that only another agent hears
    bool eventsComplete() const;       // all events of the present agents have come
    bool valuesComplete(const MirrorView& view) const;
    std::uint64_t images() const;  // published, of all together
    std::uint64_t refused() const;

private:
    MirrorAgent* at(const std::string& name, std::int64_t epoch, Moment now);
    Moment sinceAt(Moment now);
    std::optional<PeerModel> takeAside(const std::string& name, std::int64_t epoch);
    void setAside(const Model& model);
    void hear(MirrorAgent& agent, std::int64_t cycle, Moment now);
    void forget(MirrorAgent& agent);
    void miss(MirrorAgent& agent);
    void lose(MirrorAgent& agent, const char* why);
    void finish(MirrorAgent& agent);
    void findShared();
    Claimant claim(const MirrorAgent& agent, std::string_view path) const;
    std::vector<Claimant> claimants(std::string_view path, bool lost) const;

    OnLost onLost_;
    SecurityIdentity* identity_ = nullptr;
    bool structuresChanged_ = true;
    std::vector<std::string> shared_;  // paths of several, or of one without a right
    Moment began_{};
    Map agents_;
    std::map<std::string, PeerModel, std::less<>> aside_;  // of a start that may be alive
    std::map<Id, std::string> names_;
    std::map<std::string, std::pair<std::int64_t, std::uint64_t>, std::less<>>
        newestEvents_;  // epoch and number, by agent
    std::uint64_t refused_ = 0, forgottenImages_ = 0;
};

}  // namespace cortex::comms
