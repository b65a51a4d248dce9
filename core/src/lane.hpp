// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/mailbox.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>
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

    const Shape& shape() const { return rest_->shape; }

    // Sender's end. `post` returns 0 when the lane is full, else the command's number.
    std::uint64_t post(std::uint16_t command, std::uint16_t handle, const std::byte* request,
                       std::uint32_t size, const ChunkClock& clock) CORTEX_REALTIME;
    void takeAnswers() CORTEX_REALTIME;  // into the states of the handles

    // Receiver's end: a pending command is answered, then popped.
    bool pending() const CORTEX_REALTIME {
        return low(head_) != (delayed_ ? latchedTail_ : low(tail_));
    }
    std::uint64_t number() const CORTEX_REALTIME { return head_ + 1; }
    LaneSlot& front() CORTEX_REALTIME { return slot(head_); }
    std::byte* requestOf(LaneSlot& head) const CORTEX_REALTIME {
        return reinterpret_cast<std::byte*>(&head + 1);
    }
    std::byte* responseOf(LaneSlot& head) const CORTEX_REALTIME {
        return requestOf(head) + std::size_t{requestWords_} * 8U;
    }
    void answer(LaneSlot& head, const Verdict& verdict, const ChunkClock& clock) CORTEX_REALTIME;
    void pop() CORTEX_REALTIME { ++head_; }
    // The last answer to a command that was answered Running and popped.
    void finish(const AnswerHead& answer, std::uint16_t handle, const std::byte* response,
                std::uint32_t size) CORTEX_REALTIME;

    void latch() CORTEX_REALTIME;  // start of cycle, delayed lanes only
    // Whether this is a refusal after none: only such a one is an event.
    bool startsRefusing(bool refused) CORTEX_REALTIME {
        return !std::exchange(refusing_, refused) && refused;
    }

private:
    struct Final {
        AnswerHead answer;
        std::uint16_t handle = 0;
    };
    struct Line {
        alignas(64) std::byte octets[64];
    };
    // What a usual command does not touch.
    struct Rest {
        Shape shape;
        std::vector<CommandSender::State*> handles;
        std::vector<EventText> whys;
        std::vector<Final> finals;  // one more than commands: what runs, and all that wait
        std::unique_ptr<std::byte[]> finalResponses;
        std::vector<Line> memory;
    };
    static std::uint32_t low(std::uint64_t position) {
        return static_cast<std::uint32_t>(position);
    }
    std::uint32_t indexOf(std::uint64_t position) const {
        return (low(position) - first_) & ((1U << bits_) - 1U);
    }
    std::byte* place(std::uint64_t position) const {
        return slots_ + std::size_t{indexOf(position)} * lines_ * lineSize;
    }
    LaneSlot& slot(std::uint64_t position) const {
        return *reinterpret_cast<LaneSlot*>(place(position));
    }
    void takeAnswer() CORTEX_REALTIME;
    void takeFinals() CORTEX_REALTIME;
    CommandSender::State& handle(std::uint16_t index) const {
        return onlyHandle_ != nullptr ? *onlyHandle_ : *rest_->handles[index];
    }

    static constexpr std::uint32_t lineSize = 64;

    // One cache line. Sender writes tail_, taken_, first_; receiver head_, refusing_. An empty lane
    // starts again at its first slot, so that light traffic stays in one more cache line. Positions
    // of 32 bits are those of 64 modulo 2^32.
    std::uint64_t tail_ = 0, head_ = 0;
    std::uint32_t taken_ = 0, latchedTail_ = 0, latchedHead_ = 0;
    std::uint32_t first_ = 0;  // the command in the first slot
    std::byte* slots_ = nullptr;
    CommandSender::State* onlyHandle_ = nullptr;  // where there is one
    std::uint32_t capacity_ = 0;
    std::uint16_t lines_ = 0, requestWords_ = 0;  // of a slot, of the request in it
    std::uint8_t bits_ = 0;                       // there are 2^bits slots
    bool delayed_ = false, hasLong_ = false, refusing_ = false;

    std::uint64_t finalTail_ = 0, finalTaken_ = 0, latchedFinalTail_ = 0;
    std::unique_ptr<Rest> rest_;
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

inline std::uint64_t Lane::post(std::uint16_t command, std::uint16_t handle,
                                const std::byte* request, std::uint32_t size,
                                const ChunkClock& clock) {
    const std::uint32_t onTheirWay = low(tail_) - taken_;
    if (onTheirWay >= capacity_) return 0;
    if (onTheirWay == 0) first_ = low(tail_);
    LaneSlot& head = slot(tail_);
    head.cycles = clock.cycle;
    head.time = clock.nanoseconds;
    head.command = command;
    head.handle = handle;
    copyRecord(requestOf(head), request, size);
    return ++tail_;
}

inline void Lane::answer(LaneSlot& head, const Verdict& verdict, const ChunkClock& clock) {
    head.cycles = clock.cycle - head.cycles;
    head.time = std::max(clock.nanoseconds - head.time, std::int64_t{0});
    head.outcome = verdict.outcome;
    head.reason = verdict.reason;
    head.worded = verdict.why.has_value();
    if (head.worded) rest_->whys[indexOf(head_)] = *verdict.why;
}

inline void Lane::takeAnswers() {
    const std::uint32_t end = delayed_ ? latchedHead_ : low(head_);
    while (taken_ != end) takeAnswer();
    if (hasLong_) takeFinals();
}

inline void Lane::takeAnswer() {
    const std::uint64_t position = tail_ - (low(tail_) - taken_);
    LaneSlot& head = slot(position);
    CommandSender::State& state = handle(head.handle);
    AnswerHead& answer = state.answer;
    answer.number = position + 1;
    answer.latencyCycles = head.cycles;
    answer.latency = head.time;
    answer.reason = head.reason;
    answer.outcome = head.outcome;
    if (head.worded)
        answer.why = rest_->whys[indexOf(position)];
    else if (state.worded)
        answer.why = {};
    state.worded = head.worded;
    copyRecord(state.response, responseOf(head), state.responseSize);
    ++state.answered;
    ++taken_;
}

}  // namespace cortex
