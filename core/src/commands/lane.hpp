// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"
#include "cortex/core/mailbox.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <concepts>
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

// Records are multiples of 8 octets, mostly one.
inline void copyRecord(std::byte* to, const std::byte* from, std::uint32_t size) {
    if (size == 8) {
        std::memcpy(to, from, 8);
        return;
    }
    for (std::uint32_t i = 0; i < size; i += 8) std::memcpy(to + i, from + i, 8);
}

// Bounded single-producer single-consumer lane from one sender to one receiver and its answers
// back. Each end moves its own position. Where the schedule orders the two, the other sees it at
// once; along a delayed relationship it sees where it was at the start of the cycle, which each end
// notes before it moves. No load or store here is more than a plain one on x86-64.
class alignas(64) Lane {
public:
    static constexpr std::uint32_t lineSize = 64;
    static constexpr std::uint32_t mostRequest = 0xffffU * 8U;  // octets

    struct Shape {
        std::uint32_t sender = noSimplex, receiver = noSimplex;
        std::uint32_t capacity = 16;
        std::uint32_t requestSize = 0, responseSize = 0;  // the largest on this lane
        bool delayed = false;
        bool hasLong = false;
    };
    // Lanes are made in the memory of a LaneBlock, with their slots behind them.
    Lane(const Shape& shape, std::vector<CommandSender::State*> handles);
    static std::size_t octets(const Shape& shape);  // with slots

    const Shape& shape() const { return rest_->shape; }
    void setSender(CommandPort& sender) { sender_ = &sender; }
    CommandPort& sender() const CORTEX_REALTIME { return *sender_; }
    std::uint64_t sent(std::uint16_t handle) const;
    std::uint64_t answered(std::uint16_t handle) const;

    // Before an end does anything in a cycle; again does no harm.
    void beginSending(std::int64_t cycle) CORTEX_REALTIME {
        if (delayed_) note(cycle, tail_, tailStart_);
    }
    void beginReceiving(std::int64_t cycle) CORTEX_REALTIME {
        if (delayed_) note(cycle, head_, headStart_);
    }

    // Sender's end. False: the lane is full.
    bool post(std::uint16_t command, std::uint16_t handle, const std::byte* request,
              std::uint32_t size, const ChunkClock& clock) CORTEX_REALTIME;
    void takeAnswers(std::int64_t cycle) CORTEX_REALTIME;  // into the states of the handles

    // Receiver's end: how many commands wait; each is answered, then popped.
    std::int32_t pending(std::int64_t cycle) const CORTEX_REALTIME {
        return distance(now(head_), seen(cycle, tail_, tailStart_));
    }
    std::uint32_t number() const CORTEX_REALTIME { return now(head_) + 1U; }  // modulo 2^32
    LaneSlot& front() CORTEX_REALTIME { return slot(now(head_)); }
    std::byte* requestOf(LaneSlot& head) const CORTEX_REALTIME {
        return reinterpret_cast<std::byte*>(&head + 1);
    }
    std::byte* responseOf(LaneSlot& head) const CORTEX_REALTIME {
        return requestOf(head) + std::size_t{requestWords_} * 8U;
    }
    void answer(LaneSlot& head, const Verdict& verdict, const ChunkClock& clock) CORTEX_REALTIME;
    void answerDone(LaneSlot& head, const ChunkClock& clock) CORTEX_REALTIME;  // and popped
    void pop() CORTEX_REALTIME { advance(head_); }
    // The last answer to a command that was answered Running and popped.
    void finish(const AnswerHead& answer, std::uint16_t handle, const std::byte* response,
                std::uint32_t size, std::int64_t cycle) CORTEX_REALTIME;

    // Whether this is a refusal after none: only such a one is an event.
    bool startsRefusing(bool refused) CORTEX_REALTIME {
        return !std::exchange(refusing_, refused) && refused;
    }

private:
    // Where an end is, modulo 2^32; it alone moves it. A start is where it was at the start of a
    // cycle, above it that cycle, modulo 2^32 as well: an end that rested for just as many cycles
    // is seen where it was before it moved last, never beyond (distance).
    using Position = std::atomic<std::uint32_t>;
    using Start = std::atomic<std::uint64_t>;
    static std::uint32_t now(const Position& position) CORTEX_REALTIME {
        return position.load(std::memory_order_acquire);
    }
    static void advance(Position& position) CORTEX_REALTIME {
        position.store(position.load(std::memory_order_relaxed) + 1U, std::memory_order_release);
    }
    static bool isOf(std::int64_t cycle, std::uint64_t start) CORTEX_REALTIME {
        return low(start >> 32U) == low(cycle);
    }
    static void note(std::int64_t cycle, const Position& position, Start& start) CORTEX_REALTIME {
        if (isOf(cycle, start.load(std::memory_order_relaxed))) return;
        start.store(std::uint64_t{low(cycle)} << 32U | now(position), std::memory_order_relaxed);
    }
    // By the other end. If a position has moved in this cycle, its start was noted before.
    std::uint32_t seen(std::int64_t cycle, const Position& position, const Start& start) const
        CORTEX_REALTIME {
        const std::uint32_t at = now(position);
        if (!delayed_) return at;
        const std::uint64_t noted = start.load(std::memory_order_relaxed);
        return isOf(cycle, noted) ? low(noted) : at;
    }
    static std::int32_t distance(std::uint32_t from, std::uint32_t to) {
        return static_cast<std::int32_t>(to - from);
    }
    struct Final {
        AnswerHead answer;
        std::uint16_t handle = 0;
    };
    struct Counts {
        std::uint64_t sent = 0, answered = 0;
    };
    // What a usual command does not touch.
    struct Rest {
        Shape shape;
        std::vector<CommandSender::State*> handles;
        std::vector<Counts> counts;  // by handle, where there are several
        std::vector<EventText> whys;
        std::vector<Final> finals;  // at least one more than commands: what runs, and all that wait
        std::unique_ptr<std::byte[]> finalResponses;
    };
    template <std::integral T>
    static std::uint32_t low(T number) {
        return static_cast<std::uint32_t>(number);
    }
    std::uint32_t indexOf(std::uint32_t position) const {
        return (position - first_) & ((1U << bits_) - 1U);
    }
    std::byte* place(std::uint32_t position) const {
        auto* slots = const_cast<std::byte*>(reinterpret_cast<const std::byte*>(this + 1));
        if (position == first_) return slots;  // with light traffic mostly
        return slots + std::size_t{indexOf(position)} * lines_ * lineSize;
    }
    LaneSlot& slot(std::uint32_t position) const {
        return *reinterpret_cast<LaneSlot*>(place(position));
    }
    void takeAnswer() CORTEX_REALTIME;
    void takeFinals(std::int64_t cycle) CORTEX_REALTIME;
    CommandSender::State& handle(std::uint16_t index) const {
        return onlyHandle_ != nullptr ? *onlyHandle_ : *rest_->handles[index];
    }

    // One cache line. Sender writes tail_, taken_, first_; receiver head_, refusing_. An empty lane
    // starts again at its first slot, so that light traffic stays in one more cache line.
    Position tail_{0}, head_{0};
    Start tailStart_{0}, headStart_{0};
    std::uint64_t taken_ = 0;  // answers
    std::uint32_t first_ = 0;  // the command in the first slot
    std::uint32_t capacity_ = 0;
    CommandPort* sender_ = nullptr;
    CommandSender::State* onlyHandle_ = nullptr;  // where there is one

    std::uint16_t lines_ = 0, requestWords_ = 0;  // of a slot, of the request in it
    std::uint8_t bits_ = 0;                       // there are 2^bits slots
    bool delayed_ = false, hasLong_ = false, refusing_ = false;

    Position finalTail_{0};
    Start finalStart_{0};
    std::uint32_t finalTaken_ = 0;
    std::unique_ptr<Rest> rest_;
};

static_assert(sizeof(Lane) == 2 * Lane::lineSize);

// All lanes of an agent, one behind the other with their slots, in the order given.
class LaneBlock {
public:
    struct Plan {
        Lane::Shape shape;
        std::vector<CommandSender::State*> handles;  // told their lane
    };
    explicit LaneBlock(std::vector<Plan> plans);
    ~LaneBlock();
    LaneBlock(const LaneBlock&) = delete;
    LaneBlock& operator=(const LaneBlock&) = delete;

    std::span<Lane* const> lanes() const { return lanes_; }

private:
    struct Line {
        alignas(64) std::byte octets[64];
    };
    std::vector<Line> memory_;
    std::vector<Lane*> lanes_;
};

// What a handle owns: the records that the sender's task fills and reads. Its first cache line is
// all that a command of few parameters and its answer touch.
struct alignas(64) CommandSender::State {
    State(const CommandTable& commands, std::uint32_t entry, std::uint32_t edgeIndex,
          std::uint32_t room);
    bool apart() const CORTEX_REALTIME { return requestWords == recordsApart; }
    std::byte* request() CORTEX_REALTIME {
        return reinterpret_cast<std::byte*>(apart() ? records.data() : smallRecords.data());
    }
    std::uint32_t requestSize() const CORTEX_REALTIME {
        return apart() ? sizes.first : requestWords * 8U;
    }
    std::byte* response() CORTEX_REALTIME { return request() + requestSize(); }
    std::uint32_t responseSize() const CORTEX_REALTIME {
        return apart() ? sizes.second : responseWords * 8U;
    }
    void storeFinal(const AnswerHead& head, const std::byte* record) CORTEX_REALTIME;

    static constexpr std::uint8_t recordsApart = 0xff;

    Lane* lane = nullptr;                         // from start() on
    std::array<std::uint64_t, 2> smallRecords{};  // request, then response, where they fit
    std::uint8_t requestWords = 0, responseWords = 0;
    std::uint16_t command = 0, handle = 0;
    bool full = false;    // the last send() found no room
    bool worded = false;  // answer.why is not empty
    AnswerHead answer;

    const CommandTable* table = nullptr;
    std::uint32_t edge = noSimplex, capacity = 0;
    std::pair<std::uint32_t, std::uint32_t> sizes;  // of request and response, octets
    std::vector<std::uint64_t> records;             // where they do not fit
};

inline bool Lane::post(std::uint16_t command, std::uint16_t handle, const std::byte* request,
                       std::uint32_t size, const ChunkClock& clock) {
    const std::uint32_t tail = now(tail_);
    const std::uint32_t onTheirWay = tail - low(taken_);
    if (onTheirWay >= capacity_) return false;
    if (onTheirWay == 0) first_ = tail;
    LaneSlot& head = slot(tail);
    head.cycles = clock.cycle;
    head.time = clock.nanoseconds;
    head.command = command;
    head.handle = handle;
    copyRecord(requestOf(head), request, size);
    if (onlyHandle_ == nullptr) ++rest_->counts[handle].sent;
    advance(tail_);
    return true;
}

inline void Lane::answerDone(LaneSlot& head, const ChunkClock& clock) {
    head.cycles = clock.cycle - head.cycles;
    head.time = std::max(clock.nanoseconds - head.time, std::int64_t{0});
    head.outcome = Outcome::Done;
    head.reason = Reason::None;
    head.worded = false;
    refusing_ = false;
    pop();
}

inline void Lane::answer(LaneSlot& head, const Verdict& verdict, const ChunkClock& clock) {
    head.cycles = clock.cycle - head.cycles;
    head.time = std::max(clock.nanoseconds - head.time, std::int64_t{0});
    head.outcome = verdict.outcome;
    head.reason = verdict.reason;
    head.worded = verdict.why.has_value();
    if (head.worded) rest_->whys[indexOf(now(head_))] = *verdict.why;
}

inline void Lane::takeAnswers(std::int64_t cycle) {
    const std::uint32_t end = seen(cycle, head_, headStart_);
    for (std::int32_t left = distance(low(taken_), end); left > 0; --left) takeAnswer();
    if (hasLong_) takeFinals(cycle);
}

inline void Lane::takeAnswer() {
    const std::uint32_t position = low(taken_);
    LaneSlot& head = slot(position);
    CommandSender::State& state = handle(head.handle);
    AnswerHead& answer = state.answer;
    answer.number = ++taken_;
    answer.latencyCycles = head.cycles;
    answer.latency = head.time;
    answer.reason = head.reason;
    answer.outcome = head.outcome;
    if (head.worded || state.worded) {
        state.worded = head.worded;
        answer.why = head.worded ? rest_->whys[indexOf(position)] : EventText{};
    }
    copyRecord(state.response(), responseOf(head), state.responseSize());
    if (onlyHandle_ == nullptr) ++rest_->counts[head.handle].answered;
}

}  // namespace cortex
