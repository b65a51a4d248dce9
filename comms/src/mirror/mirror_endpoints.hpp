// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dds/participant.hpp"
#include "mirror/mirror_agents.hpp"
#include "mirror/mirror_inbox.hpp"

#include <cstdint>
#include <memory>

namespace cortex::comms {

// What a mirror has on the network: readers of presence and models always, all else from its first
// use on, for discovery costs. The mirror's thread.
class MirrorEndpoints {
public:
    MirrorEndpoints(const NetworkOptions& options, const Sender& tool, MirrorInbox& inbox);
    ~MirrorEndpoints();

    void view(const MirrorView& view);  // the stream of its class or none, and tells agents so
    void command();
    void listen();
    void tell(const MirrorAgents& agents, Moment now);  // that we are here
    bool write(const Command& command);

    // Agents and tools; with security also those that are to prove that they are.
    std::uint32_t speakers() const { return presences_->writers() + participant_.pending(); }
    std::uint64_t malformed() const { return participant_.malformed() + participant_.refused(); }

private:
    void speak();

    const Sender tool_;
    MirrorInbox& inbox_;
    Participant participant_;
    std::unique_ptr<Reader<Presence>> presences_;
    std::unique_ptr<Reader<Model>> models_;
    std::unique_ptr<Writer<Presence>> presence_;
    std::unique_ptr<Writer<Interest>> interests_;
    std::unique_ptr<Reader<Block>> blocks_;
    std::unique_ptr<Writer<Command>> commands_;
    std::unique_ptr<Reader<Answer>> answers_;
    std::unique_ptr<Reader<EventMessage>> events_;
    Presence self_;
    Moment spoke_{};
    MirrorView view_;  // that agents were told of
};

}  // namespace cortex::comms
