// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror_data.hpp"
#include "cortex/core/event_memory.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

namespace cortex::gui {

// What tells an event from all others, also where it comes a second time, from memory. Of what has
// no number, such as a value that changed, it is all that it says. It refers to the event.
using EventKey = std::tuple<std::string_view, std::int64_t, std::uint64_t, std::int64_t,
                            std::string_view, std::string_view>;

inline EventKey eventKeyOf(const comms::AgentEvent& event) {
    if (event.number > 0) return {event.agent, event.epoch, event.number, 0, {}, {}};
    return {event.agent, event.epoch, 0, event.wallClock, event.path, event.text};
}

// Whether agents keep such an event; all else is chatter. Of messages they keep errors alone.
inline bool isKept(const comms::AgentEvent& event) {
    return event.severity == Severity::Error ||
           std::ranges::any_of(EventMemory::kinds, [&](EventKind each) {
               return each != EventKind::Message && event.kind == name(each);
           });
}

}  // namespace cortex::gui
