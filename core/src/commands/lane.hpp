// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/loop_thread.hpp"
#include "cortex/core/mailbox.hpp"
#include "cortex/core/record.hpp"

#include "commands/final_answers.hpp"
#include "commands/lane_position.hpp"
#include "commands/lane_slot.hpp"
#include "commands/sender_state.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

namespace cortex {

class CommandPort;

// Bounded single-producer single-consumer lane from one sender to one receiver, with its answers
// back in the same slots.
//
// **Invariants**
// 1. Three positions follow each other: taken (answers that the sender took) <= head (commands that
//    the receiver answered) <= tail (commands that were sent) <= taken + capacity.
// 2. The sender alone moves tail and taken, the receiver alone moves head. Nothing here is locked,
//    and no load or store is more than a plain one on x86-64.
// 3. A slot belongs to the sender from taken to the next tail, and to the receiver from tail to
//    head. Each position is moved with release and read with acquire, so a slot is complete before
//    it changes hands.
// 4. Where the schedule orders the two tasks, an end sees the position of the other at once.
// 5. Along a delayed relationship it sees where the other was at the start of the cycle. For that
//    an end notes its position before it moves in a cycle. So neither sees what the other does in
//    the same cycle, whichever of the two runs first.
// 6. An empty lane starts again at its first slot (first_), so that light traffic stays in one more
//    cache line.
// 7. A command is answered in its slot. A command that was answered Running gets its last answer
//    through FinalAnswers, which has a position and a start of its own and obeys 2 to 5.
class alignas(64) Lane {
public:
    static constexpr std::uint32_t lineSize = 64;
    static constexpr std::uint32_t mostRequest = 0xffffU * 8U;  // bytes

    struct Shape {
        std::uint32_t sender = noSimplex, receiver = noSimplex;
        std::uint32_t capacity = 16;
        std::uint32_t requestSize = 0, responseSize = 0;  // the largest on this lane
        bool delayed = false;
        bool hasLong = false;
        // Commands that were answered Running and whose end was not taken: one in this agent, more
        // where ends come late, over a network.
        std::uint32_t running = 1;
        std::uint32_t kept = 0;  // places of `capacity` that only life-cycle commands take

        std::uint32_t underWay() const { return capacity + running; }
    };
    // Lanes are made in the memory of a LaneBlock, with their slots behind them.
    Lane(const Shape& shape, std::vector<CommandSender::State*> handles);
    static std::size_t octets(const Shape& shape);  // with slots

    const Shape& shape() const { return rest_->shape; }
    void setSender(CommandPort& sender) { sender_ = &sender; }
    CommandPort& sender() const CORTEX_REALTIME { return *sender_; }
    bool hasLong() const CORTEX_REALTIME { return hasLong_; }
    bool hasOneHandle() const CORTEX_REALTIME { return onlyHandle_ != nullptr; }
    // Of all handles.
    std::uint64_t sent() const { return taken_ + lowHalf(now(tail_) - taken_); }
    std::uint64_t answered() const { return taken_; }

    // Before an end does anything in a cycle; again does no harm.
    void beginSending(std::int64_t cycle) CORTEX_REALTIME {
        if (delayed_) noteStart(cycle, tail_, tailStart_);
    }
    void beginReceiving(std::int64_t cycle) CORTEX_REALTIME {
        if (delayed_) noteStart(cycle, head_, headStart_);
    }

    // Sender's end. False: the lane is full. `beyond`: how many of the kept places it may take.
    bool post(std::uint16_t command, std::uint16_t handle, const std::byte* request,
              std::uint32_t size, const ChunkClock& clock, std::uint32_t beyond = 0)
        CORTEX_REALTIME;
    void takeAnswers(std::int64_t cycle) CORTEX_REALTIME;  // into the states of the handles

    // Receiver's end: how many commands wait; each is answered, then popped.
    std::int32_t pending(std::int64_t cycle) const CORTEX_REALTIME {
        return distance(now(head_), seen(cycle, tail_, tailStart_));
    }
    std::uint32_t number() const CORTEX_REALTIME { return now(head_) + 1U; }  // modulo 2^32
    LaneSlot& front() CORTEX_REALTIME { return slot(now(head_)); }
    LaneSlot& waiting(std::uint32_t behind) CORTEX_REALTIME { return slot(now(head_) + behind); }
    std::byte* requestOf(LaneSlot& head) const CORTEX_REALTIME {
        return reinterpret_cast<std::byte*>(&head + 1);
    }
    std::byte* responseOf(LaneSlot& head) const CORTEX_REALTIME {
        return requestOf(head) + std::size_t{requestWords_} * 8U;
    }
    void answer(LaneSlot& head, const Verdict& verdict, const ChunkClock& clock) CORTEX_REALTIME;
    void answerDone(LaneSlot& head, const ChunkClock& clock) CORTEX_REALTIME;  // and popped
    void pop() CORTEX_REALTIME { advance(head_); }
    FinalAnswers& finals() CORTEX_REALTIME { return *finals_; }  // where it has long commands

    // Whether this is a refusal after none: only such a one is an event.
    bool startsRefusing(bool refused) CORTEX_REALTIME {
        return !std::exchange(refusing_, refused) && refused;
    }

private:
    // What a usual command does not touch.
    struct Rest {
        Shape shape;
        std::vector<CommandSender::State*> handles;
        std::vector<EventText> reasons;  // by slot
    };
    // By the other end.
    std::uint32_t seen(std::int64_t cycle, const LanePosition& position,
                       const LaneStart& start) const CORTEX_REALTIME {
        return delayed_ ? seenDelayed(cycle, position, start) : now(position);
    }
    std::uint32_t indexOf(std::uint32_t position) const {
        return (position - first_) & ((1U << bits_) - 1U);
    }
    std::byte* place(std::uint32_t position) const {
        auto* slots = const_cast<std::byte*>(reinterpret_cast<const std::byte*>(this + 1));
        if (position == first_) return slots;  // nearly always, with light traffic
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

    // One cache line. Sender writes tail_, taken_, first_; receiver head_, refusing_.
    LanePosition tail_{0}, head_{0};
    LaneStart tailStart_{0}, headStart_{0};
    std::uint64_t taken_ = 0;     // answers
    std::uint32_t first_ = 0;     // the command in the first slot
    std::uint32_t capacity_ = 0;  // without the kept places
    CommandPort* sender_ = nullptr;
    CommandSender::State* onlyHandle_ = nullptr;  // where there is one

    std::uint16_t lines_ = 0, requestWords_ = 0;  // of a slot, of the request in it
    std::uint8_t bits_ = 0;                       // there are 2^bits slots
    bool delayed_ = false, hasLong_ = false, refusing_ = false;

    std::unique_ptr<FinalAnswers> finals_;  // null: no long command
    std::unique_ptr<Rest> rest_;
};

static_assert(sizeof(Lane) == 2 * Lane::lineSize);

inline bool Lane::post(std::uint16_t command, std::uint16_t handle, const std::byte* request,
                       std::uint32_t size, const ChunkClock& clock, std::uint32_t beyond) {
    const std::uint32_t tail = now(tail_);
    const std::uint32_t onTheirWay = tail - lowHalf(taken_);
    if (onTheirWay >= capacity_ + beyond) return false;
    if (onTheirWay == 0) first_ = tail;
    LaneSlot& head = slot(tail);
    head.cycles = clock.cycle;
    head.time = clock.nanoseconds;
    head.command = command;
    head.handle = handle;
    copyRecord(requestOf(head), request, size);
    advance(tail_);
    return true;
}

inline void Lane::answerDone(LaneSlot& head, const ChunkClock& clock) {
    head.cycles = clock.cycle - head.cycles;
    head.time = std::max(clock.nanoseconds - head.time, std::int64_t{0});
    head.outcome = Outcome::Done;
    head.reason = Reason::None;
    head.hasReason = false;
    refusing_ = false;
    pop();
}

inline void Lane::answer(LaneSlot& head, const Verdict& verdict, const ChunkClock& clock) {
    head.cycles = clock.cycle - head.cycles;
    head.time = std::max(clock.nanoseconds - head.time, std::int64_t{0});
    head.outcome = verdict.outcome;
    head.reason = verdict.reason;
    head.hasReason = verdict.why.has_value();
    if (head.hasReason) rest_->reasons[indexOf(now(head_))] = *verdict.why;
}

inline void Lane::takeAnswers(std::int64_t cycle) {
    const std::uint32_t end = seen(cycle, head_, headStart_);
    for (std::int32_t left = distance(lowHalf(taken_), end); left > 0; --left) takeAnswer();
    if (hasLong_) takeFinals(cycle);
}

inline void Lane::takeAnswer() {
    const std::uint32_t position = lowHalf(taken_);
    LaneSlot& head = slot(position);
    CommandSender::State& state = handle(head.handle);
    AnswerHead& answer = state.answer;
    answer.number = ++taken_;
    answer.latencyCycles = head.cycles;
    answer.latency = head.time;
    answer.reason = head.reason;
    answer.outcome = head.outcome;
    if (head.hasReason || state.hasReason) {
        state.hasReason = head.hasReason;
        answer.why = head.hasReason ? rest_->reasons[indexOf(position)] : EventText{};
    }
    copyRecord(state.response(), responseOf(head), state.responseSize());
    if (!hasOneHandle()) ++state.answered;
}

}  // namespace cortex
