// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include "processes/agent_process.hpp"

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace cortex::test {

using comms::AgentEvent;

// What a test sees of the agents on its network: everything, as any tool does.
class Station {
public:
    Station();

    // Waits for it; false when patience is over.
    bool waitFor(const std::function<bool()>& condition);
    bool hears(const std::string& agent) const {
        const std::string state = stateOf(agent);
        return state == "running" || state == "overloaded";
    }
    std::string stateOf(const std::string& agent) const;  // "": never heard
    std::int64_t epochOf(const std::string& agent) const;
    std::int64_t cycleOf(const std::string& agent) const;  // of what is seen of it
    // The cycle of the oldest measurement in what is seen there; -1: it has not come.
    std::int64_t stampOf(const std::string& path) const;

    // Items as they came last.
    std::optional<std::int64_t> number(const std::string& path, const std::string& item) const;
    double real(const std::string& path, const std::string& item) const;
    std::vector<double> reals(const std::string& path, const std::string& item) const;
    std::vector<double> demands() const;  // positions of the arm's axes

    // Events from now on are those after mark().
    void mark();
    std::optional<AgentEvent> event(const std::string& path, const std::string& part) const;
    bool hasEvent(const std::string& path, const std::string& part) const {
        return event(path, part).has_value();
    }
    std::vector<AgentEvent> events() const;

    comms::Mirror& mirror() { return mirror_; }

private:
    comms::AgentImage imageOf(const std::string& path) const;

    mutable std::mutex mutex_;
    std::vector<AgentEvent> events_;
    std::size_t marked_ = 0;
    std::uint64_t images_ = 0;
    comms::Mirror mirror_;  // ends first: its thread calls our listener
};

}  // namespace cortex::test
