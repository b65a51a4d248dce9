// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mirror_agents.hpp"
#include "mirror_inbox.hpp"
#include "participant.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace cortex::comms {

// What a mirror has on the network: readers of presence and models always, all else from its first
// use on, for discovery costs. The mirror's thread.
class MirrorEndpoints {
public:
    MirrorEndpoints(const NetworkOptions& options, const Sender& tool, MirrorInbox& inbox);
    ~MirrorEndpoints();

    void view(const MirrorView& view);  // the stream of its class, or none
    void command();
    void listen();
    // Tells each agent what we want of it, where that has changed, and that we are here.
    void tell(const MirrorAgents& agents, const MirrorView& view, Moment now);
    bool write(const Command& command);

    // Agents and tools; with security also those that are to prove that they are.
    std::uint32_t speakers() const { return presences_->writers() + participant_.pending(); }
    std::uint32_t eventSources() const { return events_ ? events_->writers() : 0; }
    std::uint64_t malformed() const { return participant_.malformed() + participant_.refused(); }

private:
    void speak();
    void want(const std::string& agent, Interest interest);

    const Sender tool_;
    MirrorInbox& inbox_;
    Participant participant_;
    std::unique_ptr<Reader<Presence>> presences_;
    std::unique_ptr<Reader<Model>> models_;
    std::unique_ptr<Writer<Presence>> presence_;
    std::unique_ptr<Writer<Model>> model_;
    std::unique_ptr<Reader<Block>> blocks_;
    std::unique_ptr<Writer<Command>> commands_;
    std::unique_ptr<Reader<Answer>> answers_;
    std::unique_ptr<Reader<EventMessage>> events_;
    Presence self_;
    Moment spoke_{};
    std::optional<std::uint32_t> viewRate_;
    std::map<std::string, Interest> told_;  // by agent
};

}  // namespace cortex::comms
