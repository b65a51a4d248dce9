// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"
#include "cortex/core/event.hpp"
#include "cortex/core/realtime.hpp"

#include <cstdint>
#include <optional>

namespace cortex {

// How a command ended; words only where there is something to say.
struct Verdict {
    Outcome outcome = Outcome::Done;
    Reason reason = Reason::None;
    std::optional<EventText> why;

    bool good() const { return outcome == Outcome::Done || outcome == Outcome::Running; }
};

// Of what a handler returned and said; what only the framework may answer counts as Failed.
Verdict verdictOf(Outcome outcome, const Call& call) CORTEX_REALTIME;
// Of a handler that said Done. A response that is no number is not sent: that is Failed, and the
// response is empty.
Verdict doneVerdict(const CommandTable::Entry& entry, std::byte* response) CORTEX_REALTIME;

// Head of a command in a lane; its request, then its response follow. Answered in place, so that
// a command of few parameters and its answer share one cache line.
struct LaneSlot {
    std::int64_t cycles = 0;  // sent in that cycle; once answered, the latency
    std::int64_t time = 0;    // ns; as `cycles`
    std::uint16_t command = 0;
    std::uint16_t handle = 0;  // of the sender, on this lane
    Outcome outcome = Outcome::None;
    Reason reason = Reason::None;
    bool hasReason = false;
};

}  // namespace cortex
