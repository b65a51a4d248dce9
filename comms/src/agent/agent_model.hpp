// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent/agent_self.hpp"
#include "wire/messages.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace cortex::comms {

// What this agent publishes of itself: its types and simplexes, several in a sample, and their
// counts and hashes in its presence. announce() makes it. Throws Error while all images are held.
class AgentModel {
public:
    explicit AgentModel(const AgentSelf& self, std::string_view security = {});

    // The first sample shows this signed list from now on.
    void show(const std::string& list);

    const std::vector<Model>& samples() const { return samples_; }
    const Id& structureHash() const { return presence_.structureHash; }
    // `agents`: how many are present, this one included. `events`: the number of the last event
    // that was written.
    Presence presence(const char* state, std::uint32_t agents, std::uint64_t events) const;

private:
    template <class Message>
    void pack(std::vector<Message>&& messages, std::vector<Message> Model::* list);
    void addTypes();
    void addSimplexes();

    const AgentSelf& self_;
    std::vector<Model> samples_;
    Presence presence_;
};

}  // namespace cortex::comms
