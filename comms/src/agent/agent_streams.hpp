// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent/agent_peers.hpp"
#include "agent/kept_images.hpp"
#include "dds/participant.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::comms {

// Sends the values of this agent's simplexes that others ask for: one stream for links, and one for
// each rate of views. A link is the input of another agent, a view is what a tool wants to see;
// both ask with the message Interest. A stream has a writer from when somebody first asks for it;
// an asker that comes back after a cut then has no endpoint to discover. Links and slow views get
// the newest cycle; the view of every cycle gets those before it, too, as far as they were kept.
// Communication thread only, but for keep(). Times are ns of monotonicNow().
class AgentStreams {
public:
    AgentStreams(AgentSelf& self, const Id& structureHash, Participant& participant);

    void update(const Peers& peers);  // after the peers have changed
    bool everyCycle() const;          // whether somebody asks for every cycle
    std::int64_t due() const;         // of the other streams; far in the future: never
    void step(std::int64_t now);      // sends what is due
    bool repeatLinks();               // sends their last block again; false: nobody has links
    void renew();  // before its participant is replaced; update() makes the writers anew
    void keep() CORTEX_REALTIME { kept_.keep(); }  // loop thread, after each cycle

private:
    struct Stream {
        bool isWanted() const { return writer != nullptr && !simplexes.empty(); }

        Topic topic;
        std::uint32_t rate;  // Hz; 0: every cycle
        std::vector<std::uint32_t> simplexes = {};
        std::unique_ptr<Writer<Block>> writer = {};
        Block block = {};
        std::int64_t due = 0;       // when its next values are to be sent
        std::int64_t againDue = 0;  // when its last block is to be sent again if nothing is newer
    };

    // These mark the simplexes that one asker wants.
    void addLinks(const Interest& interest, std::vector<bool>& wanted);
    void addView(const View& view);
    void addBelow(const std::string& prefix, std::vector<bool>& wanted);
    // Makes the writer if there is none, and gives the stream what is wanted.
    void open(Stream& stream, const std::vector<bool>& wanted);
    // Sends what was kept, in order. False: there may be more, for the next step.
    bool sendKept(std::int64_t now);
    // Sends the last block again.
    void sayAgain(Stream& stream, std::int64_t now);
    void write(Stream& stream, const Image& image, std::int64_t now);

    AgentSelf& self_;
    Participant& participant_;
    Id structureHash_;
    std::uint32_t own_ = 0;  // number of simplexes that are not remote; they come first
    KeptImages kept_;
    std::array<Stream, 5> streams_;            // the last one: the view of every cycle
    std::array<std::vector<bool>, 5> wanted_;  // by stream, then simplex
};

}  // namespace cortex::comms
