// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/live.hpp"
#include "text/output.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::cli {

// What `cortex top` shows of one moment.
struct TopAgent {
    comms::AgentStatus status;
    Json loop;  // items of the agent's own simplex by name; null: not known, or too old
    std::array<std::uint32_t, 5> states{};     // active simplexes by State
    std::array<std::uint32_t, 4> qualities{};  // all simplexes by Quality

    // An item of the loop; none where it is not known, or the agent has none.
    std::optional<double> metric(const char* item) const;
};

// An active simplex and how long its task took when it was last timed.
struct TopTask {
    std::string path, agent;
    double time = 0;  // us
};

struct TopFault {
    std::string path, agent, text;
    std::int64_t code = 0;
};

struct TopFrame {
    std::int64_t time = 0;  // UTC ns
    std::vector<TopAgent> agents;
    std::vector<TopTask> tasks;  // the longest first
    std::vector<TopFault> faults;
    std::vector<comms::Contested> contested;  // paths of several agents that are shown
    std::vector<comms::AgentEvent> events;    // the newest last

    bool anyAgent() const;  // that is not lost
};

// Looks at all agents, and views what is at and below a path of them, and of each its own simplex.
class TopView {
public:
    TopView(Live& live, std::string prefix, std::uint32_t rate);

    TopFrame frame();  // without events
    bool shows(std::string_view path) const;

private:
    void view();
    void add(TopFrame& frame, const comms::AgentStatus& status) const;

    Live& live_;
    std::string prefix_;
    std::uint32_t rate_;
    std::vector<std::string> viewed_;
};

// The simplex of the agent itself, which has the metrics of its loop; noSimplex: it has none.
std::uint32_t ownSimplex(const Structure& structure);

Json topJson(const TopFrame& frame);  // schemas/top.json; its events are new since the last

}  // namespace cortex::cli
