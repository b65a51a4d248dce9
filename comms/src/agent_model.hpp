// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent_self.hpp"
#include "messages.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace cortex::comms {

// What this agent tells of itself: its types and simplexes, one sample each, and their counts and
// hashes in its presence. Made by announce(); throws Error while all images are held.
class AgentModel {
public:
    explicit AgentModel(const AgentSelf& self, std::string_view security = {});

    const std::vector<Model>& samples() const { return samples_; }
    const Id& structureHash() const { return presence_.structureHash; }
    Presence presence(const char* state, std::uint32_t agents) const;  // heard, this one too
    Model sampleOf(Interest interest) const;

private:
    Model sample(const char* kind, std::string_view name) const;
    void addTypes();
    void addSimplexes();

    const AgentSelf& self_;
    std::vector<Model> samples_;
    Presence presence_;
};

}  // namespace cortex::comms
