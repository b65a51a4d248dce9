// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QString>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cortex::gui {

// Since when simplexes are in their states, from the events of state changes.
class StateTimes {
public:
    StateTimes();

    void add(const std::vector<comms::AgentEvent>& events);
    // "since 12:03:22 UTC, 12 min", in the zone that is shown; "since before 12:03 UTC" where no
    // event told.
    QString text(const Frame& frame, Place place) const;
    QString longest() const;  // no text is wider, of a state that began within the last 99 minutes
    // What the event said of the fault in which it is; empty: none is known.
    std::string fault(const Frame& frame, Place place) const;
    // That event, but for its cycle.
    std::optional<comms::AgentEvent> faultEvent(const Frame& frame, Place place) const;

private:
    struct Change {
        std::int64_t epoch = 0, when = 0;  // start of the agent; UTC ns
        std::uint64_t number = 0;          // of the event
        std::string fault;                 // its text, of a fault
    };
    const Change* last(const Frame& frame, Place place) const;  // null: none is known

    std::map<std::pair<std::string, std::string>, Change> changes_;  // agent and path
    std::int64_t begin_;                                             // UTC ns
};

}  // namespace cortex::gui
