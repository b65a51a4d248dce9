// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent/agent_peers.hpp"
#include "dds/participant.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::comms {

// The values of our simplexes that others ask for: one stream for links, one for each rate at which
// somebody looks. A stream has a writer only while somebody asks. Communication thread only.
class AgentStreams {
public:
    AgentStreams(AgentSelf& self, const Id& structureHash, Participant& participant);

    void update(const Peers& peers);  // after a change of them
    bool everyCycle() const;          // somebody asks for each
    std::int64_t due() const;         // when the next of the other streams is; far off: never
    void step(std::int64_t now);      // writes what is due of the newest image

private:
    struct Stream {
        Topic topic;
        std::uint32_t rate;  // Hz; 0: every cycle
        std::vector<std::uint32_t> simplexes = {};
        std::unique_ptr<Writer<Block>> writer = {};
        Block block = {};
        std::int64_t due = 0, againDue = 0;
    };

    void addLinks(const Interest& interest, std::vector<bool>& wanted);
    void addView(const View& view);
    void addBelow(const std::string& prefix, std::vector<bool>& wanted);
    void open(Stream& stream, const std::vector<bool>& wanted);
    void sayAgain(Stream& stream, std::int64_t now);
    void write(Stream& stream, const Image& image);

    AgentSelf& self_;
    Participant& participant_;
    Id structureHash_;
    std::uint32_t own_ = 0;  // simplexes that are not remote: they stand first
    std::array<Stream, 5> streams_;
    std::array<std::vector<bool>, 5> wanted_;  // by stream, then simplex
};

}  // namespace cortex::comms
