// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dds/participant.hpp"
#include "mirror/mirror_agents.hpp"
#include "mirror/mirror_inbox.hpp"
#include "mirror/mirror_tools.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <memory>

namespace cortex::comms {

// The endpoints of a mirror. Readers of presence and models always exist; the others are made when
// they are first needed, because each costs discovery. Only the mirror's thread uses it.
class MirrorEndpoints {
public:
    MirrorEndpoints(const NetworkOptions& options, const Sender& tool, MirrorInbox& inbox);
    ~MirrorEndpoints();

    void view(const MirrorView& view, bool summarised);  // reads its streams and informs the agents
    void command();  // makes what commands need, and tells the agents to do so
    void listen();
    void hearPast();                                        // what agents have kept
    void say(const ToolWords& words);                       // of this tool, from now on
    void announce(const MirrorAgents& agents, Moment now);  // this tool
    bool write(const Command& command);

    // The number of agents and tools, and with security of those that have yet to prove themselves.
    std::uint32_t speakers() const { return presences_->writers() + participant_.pending(); }
    // Of those, the ones that did not say who they are.
    std::uint32_t nameless() const { return presences_->unheard() + participant_.pending(); }
    // The number of participants with security, of which this tool without it learns nothing more.
    std::uint32_t closed() const {
        return participant_.identity() == nullptr ? participant_.secured() : 0;
    }
    bool findsUnproven() const { return participant_.findsUnproven(); }
    bool isDeaf() const { return presences_->isDeaf(); }
    SecurityIdentity* identity() const { return participant_.identity(); }
    std::uint64_t malformed() const { return participant_.malformed() + participant_.refused(); }
    std::map<std::string, Refused> refusals() const {
        std::map<std::string, Refused> all;
        for (const auto& [reason, each] : participant_.refusals()) {
            all[reason] = {each.count, each.lastFrom};
        }
        return all;
    }

private:
    void speak();
    void renewExtras();
    void viewSummaries(bool wanted);

    const Sender tool_;
    MirrorInbox& inbox_;
    Participant participant_;
    std::unique_ptr<Reader<Presence>> presences_;
    std::unique_ptr<Reader<Model>> models_;
    std::unique_ptr<Writer<Presence>> presence_;
    std::unique_ptr<Writer<Interest>> interests_;
    std::array<std::unique_ptr<Reader<Block>>, viewRates.size()> blocks_;  // by stream
    std::unique_ptr<Writer<Command>> commands_;
    std::unique_ptr<Reader<Answer>> answers_;
    std::unique_ptr<Reader<EventMessage>> events_;
    std::unique_ptr<Reader<PastMessage>> past_;
    std::unique_ptr<Reader<Summary>> summaries_;
    Presence self_;
    ToolWords words_;  // that the others know
    Moment spoke_{}, announced_ = std::chrono::steady_clock::now();
    MirrorView view_;  // the one that the agents know
};

}  // namespace cortex::comms
