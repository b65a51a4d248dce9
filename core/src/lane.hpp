// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/mailbox.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <vector>

namespace cortex {

class CommandPort;

// How a command ended; words only where there is something to say.
struct Verdict {
    Outcome outcome = Outcome::Done;
    Reason reason = Reason::None;
    std::optional<EventText> why;

    bool good() const { return outcome == Outcome::Done || outcome == Outcome::Running; }
};

// Of what a handler returned and said; what only the framework may answer counts as Failed.
Verdict verdictOf(Outcome outcome, const Call& call) CORTEX_REALTIME;

// Head of a command in a lane; its request, then its response follow. Answered in place, so that
// a command of few parameters and its answer share one cache line.
struct LaneSlot {
    std::int64_t cycles = 0;  // sent in that cycle; once answered, the latency
    std::int64_t time = 0;    // ns, likewise
    std::uint16_t command = 0;
    std::uint16_t handle = 0;  // of the sender, on this lane
    Outcome outcome = Outcome::None;
    Reason reason = Reason::None;
    bool worded = false;
};

// Records are multiples of 8 octets, mostly one or two.
inline void copyRecord(std::byte* to, const std::byte* from, std::uint32_t size) {
    for (std::uint32_t i = 0; i < size; i += 8) std::memcpy(to + i, from + i, 8);
}

// Bounded single-producer single-consumer lane from one sender to one receiver and its answers
// back. The schedule orders both ends, so nothing in it is atomic; where no order exists (delayed
// relationships) each end works on counters latched at the start of the cycle.
class alignas(64) Lane {
public:
    struct Shape {
        std::uint32_t sender = noSimplex, receiver = noSimplex;
        std::uint32_t capacity = 16;
        std::uint32_t requestSize = 0, responseSize = 0;  // the largest on this lane
        bool delayed = false;
        bool hasLong = false;
    };
    Lane(const Shape& shape, std::vector<CommandSender::State*> handles);

    const Shape& shape() const { return shape_; }

    // Sender's end. `post` returns 0 when the lane is full, else the command's number.
    std::uint64_t post(std::uint16_t command, std::uint16_t handle, const std::byte* request,
                       std::uint32_t size, const ChunkClock& clock) CORTEX_REALTIME;
    void takeAnswers() CORTEX_REALTIME;  // into the states of the handles

    // Receiver's end: a pending command is answered, then popped.
    bool pending() const CORTEX_REALTIME { return head_ != (delayed_ ? latchedTail_ : tail_); }
    std::uint64_t number() const CORTEX_REALTIME { return head_ + 1; }
    LaneSlot& front() CORTEX_REALTIME { return slot(head_); }
    const std::byte* request() CORTEX_REALTIME { return record(head_); }
    std::byte* response() CORTEX_REALTIME { return place(head_) + responseOffset_; }
    void answer(const Verdict& verdict, const ChunkClock& clock) CORTEX_REALTIME;
    void pop() CORTEX_REALTIME { ++head_; }
    // The last answer to a command that was answered Running and popped.
    void finish(const AnswerHead& answer, std::uint16_t handle, const std::byte* response,
                std::uint32_t size) CORTEX_REALTIME;

    void latch() CORTEX_REALTIME;  // start of cycle, delayed lanes only

    // Whether this is a refusal after none: only such a one is an event.
    bool startsRefusing(bool refused) CORTEX_REALTIME;

private:
    struct Final {
        AnswerHead answer;
        std::uint16_t handle = 0;
    };
    std::uint32_t indexOf(std::uint64_t position) const {
        return (static_cast<std::uint32_t>(position) - first_) & mask_;
    }
    std::byte* place(std::uint64_t position) const {
        return slots_ + std::size_t{indexOf(position)} * stride_;
    }
    LaneSlot& slot(std::uint64_t position) const {
        return *reinterpret_cast<LaneSlot*>(place(position));
    }
    std::byte* record(std::uint64_t position) const { return place(position) + sizeof(LaneSlot); }
    void takeFinals() CORTEX_REALTIME;
    CommandSender::State& handle(std::uint16_t index) const {
        return onlyHandle_ != nullptr ? *onlyHandle_ : *handles_[index];
    }

    // One cache line. Sender writes tail_, taken_, first_; receiver head_, refusing_. An empty lane
    // starts again at its first slot, so that light traffic stays in one more cache line.
    std::uint64_t tail_ = 0, taken_ = 0, head_ = 0;
    std::byte* slots_ = nullptr;
    CommandSender::State* onlyHandle_ = nullptr;  // where there is one
    std::uint32_t first_ = 0;                     // the command in the first slot, modulo 2^32
    std::uint32_t mask_ = 0, capacity_ = 0;
    std::uint32_t stride_ = 0, responseOffset_ = 0;
    bool delayed_ = false, hasLong_ = false, refusing_ = false;

    std::uint64_t latchedTail_ = 0, latchedHead_ = 0, latchedFinalTail_ = 0;
    std::uint64_t finalTail_ = 0, finalTaken_ = 0;
    Shape shape_;
    std::vector<CommandSender::State*> handles_;
    std::vector<EventText> whys_;
    std::vector<Final> finals_;  // one more than commands: what runs, and all that wait
    std::unique_ptr<std::byte[]> finalResponses_;
    struct Line {
        alignas(64) std::byte octets[64];
    };
    std::vector<Line> memory_;
};

// What a handle owns: the records that the sender's task fills and reads. Its first two cache lines
// are all that a command of few parameters and its answer touch.
struct alignas(64) CommandSender::State {
    State(const CommandTable& commands, std::uint32_t entry, std::uint32_t edgeIndex,
          std::uint32_t room);
    void storeFinal(const AnswerHead& head, const std::byte* record) CORTEX_REALTIME;

    Lane* lane = nullptr;           // from start() on
    CommandPort* sender = nullptr;  // likewise
    std::byte* request = nullptr;
    std::byte* response = nullptr;
    std::uint64_t sent = 0, answered = 0;
    std::uint32_t requestSize = 0, responseSize = 0;
    std::uint16_t command = 0, handle = 0;
    bool full = false;    // the last send() found no room
    bool worded = false;  // answer.why is not empty

    std::array<std::uint64_t, 4> smallRecords{};  // request, then response, where they fit
    AnswerHead answer;

    const CommandTable* table = nullptr;
    std::uint32_t edge = noSimplex, capacity = 0;
    std::vector<std::uint64_t> records;  // where they do not
};

}  // namespace cortex
