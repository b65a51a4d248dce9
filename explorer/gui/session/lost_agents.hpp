// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <chrono>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace cortex::gui {

// What became of agents: one that was lost stays, with its last values, until a person dismisses
// it or it is heard again. That it was lost, ended, came back or started anew is told once.
class LostAgents {
public:
    using Moment = std::chrono::steady_clock::time_point;

    // Adds what is kept to the agents that are known now, takes away what was dismissed, and
    // returns what has happened since the last call.
    std::vector<comms::AgentEvent> update(std::vector<AgentFrame>& agents, Moment now);
    void dismiss(const std::string& agent);  // until it is heard again
    // Those that ended, or were dismissed, and are not heard again: what they had is not forgotten.
    const std::vector<GoneAgent>& gone() const { return gone_; }

private:
    struct Known {
        AgentFrame frame;
        Moment when;
    };
    void tell(const AgentFrame& agent, std::vector<comms::AgentEvent>& events) const;
    void keep(std::vector<AgentFrame>& agents, Moment now);
    void note(const AgentFrame& agent);

    std::map<std::string, Known> known_;                        // as of the last call
    std::set<std::pair<std::string, std::int64_t>> dismissed_;  // name and start
    std::vector<GoneAgent> gone_;
};

}  // namespace cortex::gui
