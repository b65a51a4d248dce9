// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include "model/event_text.hpp"

#include <QString>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace cortex::gui {

// A row among the events: one event, the same again and again, or how many did not come.
struct EventRow {
    static constexpr std::size_t mostOthers = 1'000;
    static constexpr const char* missingKind = "missing";

    explicit EventRow(comms::AgentEvent first);
    // After `last` of its agent so many events did not come.
    static EventRow gap(const comms::AgentEvent& last, std::uint64_t missing);

    bool isGap() const { return missing > 0; }
    bool mayFold() const;     // never faults, errors, changes of state, commands, losses
    bool isFault() const;     // or another error: what was before it can be asked for
    bool isRoutine() const;   // a jog command, of which ten come a second
    std::string key() const;  // alike for rows that fold
    bool takes(const comms::AgentEvent& next) const;  // ten seconds after the last it ends
    void take(comms::AgentEvent next);
    QString text() const;  // with ranges of the numbers that differ
    const comms::AgentEvent& newest() const { return others.empty() ? event : others.back(); }

    comms::AgentEvent event;  // the first; of a gap the one before it
    std::uint64_t times = 1, missing = 0;
    std::string words;
    std::vector<NumberRange> numbers;
    std::deque<comms::AgentEvent> others;  // after the first, the newest of them
    bool matches = true;                   // what is typed into the filter
    std::size_t kind = 0;                  // index of its kind in the model
    bool late = false;                     // what stands above it is of a later time
    bool kept = false;                     // agents keep such events; all else is chatter
};

// "alice (cortex@desk.4711-5e1f0a): jog(speed=0.5): Done": of a command, on whose behalf first.
std::string saidText(const comms::AgentEvent& event);

}  // namespace cortex::gui
