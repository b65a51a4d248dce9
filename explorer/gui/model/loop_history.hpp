// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>

namespace cortex::gui {

// What an agent counts. The last one is counted by this program: samples that did not come.
enum class Counter { Overflows, Commands, Rejected, Conflicts, Limits, Dropped, Loss };
inline constexpr std::size_t counterCount = 7;

// The item of the agent's own simplex that has the count; null: it is no item.
const char* itemOf(Counter counter);
// None: the agent does not count it, or nothing has come.
std::optional<std::int64_t> countOf(const AgentFrame& agent, Counter counter);

// What was seen of the loops of all agents in the last ten minutes, four times a second.
class LoopHistory {
public:
    static constexpr double span = 600;  // s

    struct Moment {
        double time = 0;  // s, Frame::seconds
        std::array<std::optional<std::int64_t>, counterCount> counts;
        std::optional<double> duty, jitter;  // % of the last cycle, µs p99; none: not live
    };
    struct Change {
        std::int64_t more = 0;
        double seconds = 0;  // over which it was seen, 60 at most
    };

    void add(const Frame& frame);
    // How a counter has changed in the last minute. None: not counted, or not seen for a second.
    std::optional<Change> change(const AgentFrame& agent, Counter counter) const;
    const std::deque<Moment>& of(const AgentFrame& agent) const;  // the oldest first

private:
    struct Seen {
        std::int64_t epoch = 0;
        std::deque<Moment> moments;
    };
    std::map<std::string, Seen> seen_;  // by agent
};

}  // namespace cortex::gui
