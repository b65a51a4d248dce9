// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"

#include "commands/lane.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace cortex {

// Whether the time of a command is over. The counter alone would not do: it stands still with the
// loop, while the sender's time goes on.
inline bool isOver(std::int64_t notAfter, std::int64_t until, const ChunkClock& now)
    CORTEX_REALTIME {
    return now.cycle > notAfter || (until != 0 && now.nanoseconds > until);
}

// A command from outside on its way through the agent: from the router's pool into the queue of one
// simplex, whose task answers it in place; the router collects the answer at the end of the cycle.
struct OutsideEntry {
    Sender sender;
    std::array<char, 32> onBehalfOf{};
    std::uint64_t sequence = 0;
    std::int64_t notAfter = 0, until = 0;
    std::uint32_t interface = 0, senderRecord = 0;  // indexes in the router
    std::uint32_t simplex = noSimplex, command = CommandTable::none;
    std::int64_t readCycle = 0, readTime = 0;
    std::byte* request = nullptr;
    std::byte* response = nullptr;
    // In the list of its sender while it waits, then in the queue of the simplex.
    OutsideEntry* next = nullptr;
    std::int64_t waitUntil = 0;  // cycle; then it goes on without what is missing below it
    bool queued = false;         // on its way to a queue or in one, not begun
    // The later command of its sender that went first; with a name it does not run.
    std::string_view withdrawnBy{};

    AnswerHead answer;
    bool fresh = false;  // the router has not seen this answer
    bool ran = false;    // it was answered Running before

    // A life-cycle command is watched by the router instead of queued.
    LifeCycle watched = LifeCycle::None;
    std::int64_t deadline = 0;    // nominal time
    std::int64_t takenCycle = 0;  // when the pending word was first seen taken
    State stateBefore = State::Standby;
    bool moved = false;  // the state has left where it was

    bool final() const { return answer.outcome != Outcome::Running; }
    void tellOrigin(Call& call) const CORTEX_REALTIME {
        call.setSender(&sender);
        call.setOnBehalfOf(onBehalfOf.data());
    }
    void settle(const Verdict& verdict, const ChunkClock& clock) CORTEX_REALTIME {
        answer.number = sequence;
        answer.outcome = verdict.outcome;
        answer.reason = verdict.reason;
        if (verdict.why) answer.why = *verdict.why;
        answer.latencyCycles = clock.cycle - readCycle;
        answer.latency = clock.nanoseconds > readTime ? clock.nanoseconds - readTime : 0;
        fresh = true;
    }
    // Of the same sender: `other` was sent later, maybe by a later start.
    bool earlier(const OutsideEntry& other) const CORTEX_REALTIME {
        if (senderRecord != other.senderRecord || sender.name != other.sender.name) return false;
        if (sender.epoch != other.sender.epoch) return sender.epoch < other.sender.epoch;
        return sequence < other.sequence;
    }
    // Canonical order of commands from outside.
    bool before(const OutsideEntry& other) const CORTEX_REALTIME {
        if (interface != other.interface) return interface < other.interface;
        const int names = sender.nameText().compare(other.sender.nameText());
        if (names != 0) return names < 0;
        if (sender.epoch != other.sender.epoch) return sender.epoch < other.sender.epoch;
        return sequence < other.sequence;
    }
};

}  // namespace cortex
