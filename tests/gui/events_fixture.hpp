// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_filter.hpp"

#include <string>
#include <vector>

namespace cortex::test {

// Events of the agent "robot", one a millisecond, in the order of their numbers.
inline comms::AgentEvent eventOf(std::uint64_t number, const std::string& kind,
                                 const std::string& path, const std::string& text,
                                 Severity severity = Severity::Info) {
    comms::AgentEvent event;
    event.agent = "robot";
    event.number = number;
    event.wallClock = static_cast<std::int64_t>(number) * 1'000'000;
    event.cycle = static_cast<std::int64_t>(number);
    event.severity = severity;
    event.kind = kind;
    event.path = path;
    event.text = text;
    return event;
}

// Changes of state, which are never one row.
inline std::vector<comms::AgentEvent> changes(std::uint64_t first, std::size_t count) {
    std::vector<comms::AgentEvent> events;
    for (std::uint64_t i = first; i < first + count; ++i) {
        events.push_back(
            eventOf(i, "state change", "/drives/" + std::to_string(i), "Standby -> Active"));
    }
    return events;
}

inline comms::AgentEvent limit(std::uint64_t number, const std::string& text,
                               Severity severity = Severity::Warning) {
    return eventOf(number, "limit", "/arm/demands/4", text, severity);
}

}  // namespace cortex::test
