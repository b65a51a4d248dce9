// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/past_events.hpp"
#include "live/live.hpp"
#include "live/live_events.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace cortex::cli {

// The last 1,000 events of each agent, and what has come since. Waits until nothing more comes for
// a while in which the agents said, of all that has happened by now, what they have written, and
// that is here.
common::AgentEvents arrived(Live& live, Arrivals& arrivals);

// What agents keep of the past, as far as they tell it.
class KeptPast {
public:
    explicit KeptPast(Live& live) : live_{live} {}

    // Of those that have something at or below the prefix. Times are UTC ns, both included. An
    // agent that had trouble is not asked again.
    common::AgentEvents ask(const std::string& prefix, std::int64_t from, std::int64_t until);
    // What is not kept as long as that, of these kinds or all, and what troubles agents had: on
    // standard error, a line for each agent.
    void printNotes(std::int64_t from, const std::vector<std::string>& kinds = {}) const;
    bool complete() const { return troubles_.empty() && live_.incomplete().empty(); }

private:
    bool concerns(const std::string& agent, const std::string& prefix) const;

    Live& live_;
    std::map<std::string, std::string> troubles_;                         // by agent
    std::map<std::string, std::vector<comms::PastEvents::Since>> since_;  // by agent
};

}  // namespace cortex::cli
