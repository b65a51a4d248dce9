// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace cortex {

// Time of a loop thread's current chunk, for latencies; ns, monotonic.
struct ChunkClock {
    std::int64_t cycle = 0;
    std::int64_t nanoseconds = 0;
};

struct CommandHead {
    std::uint64_t number = 0;  // per lane, from 1
    std::int64_t sentCycle = 0;
    std::int64_t sentTime = 0;  // ns, chunk resolution
    std::uint32_t command = 0;
};
struct AnswerHead {
    std::uint64_t number = 0;
    std::int64_t latencyCycles = 0;
    std::int64_t latency = 0;  // ns
    Outcome outcome = Outcome::None;
    Reason reason = Reason::None;
    EventText why;
};

// Bounded single-producer single-consumer lane from one sender to one receiver, and its answers
// back. The schedule orders both ends, so nothing in it is atomic; where no order exists (delayed
// relationships) each end works on counters latched at the start of the cycle.
class Lane {
public:
    Lane(const CommandTable& table, std::uint32_t capacity, bool delayed, std::uint32_t sender,
         std::uint32_t receiver);

    std::uint32_t sender() const { return sender_; }
    std::uint32_t receiver() const { return receiver_; }
    bool delayed() const { return delayed_; }
    std::uint32_t capacity() const { return capacity_; }
    const CommandTable& table() const { return *table_; }

    // Sender's end. `post` returns 0 when the lane is full, else the command's number.
    std::uint64_t post(std::uint32_t command, const std::byte* request, std::uint32_t size,
                       const ChunkClock& clock) CORTEX_REALTIME;
    bool takeAnswer(AnswerHead& head, std::byte* response, std::uint32_t size) CORTEX_REALTIME;

    // Receiver's end.
    bool pending() const CORTEX_REALTIME { return head_ != visibleTail(); }
    const CommandHead& front() const CORTEX_REALTIME;
    const std::byte* frontRequest() const CORTEX_REALTIME;
    void pop() CORTEX_REALTIME { ++head_; }
    // Room for the answer is kept from the moment a command is posted.
    void answer(const AnswerHead& head, const std::byte* response, std::uint32_t size)
        CORTEX_REALTIME;

    void latch() CORTEX_REALTIME;  // start of cycle, delayed lanes only

private:
    std::uint64_t visibleTail() const { return delayed_ ? latchedTail_ : tail_; }

    const CommandTable* table_;
    std::uint32_t capacity_, sender_, receiver_;
    bool delayed_;
    std::uint32_t requestSize_, responseSize_;
    std::vector<CommandHead> commands_;
    std::vector<AnswerHead> answers_;
    std::unique_ptr<std::byte[]> requests_, responses_;
    // Sender writes tail_ and answerHead_, receiver head_ and answerTail_.
    alignas(64) std::uint64_t tail_ = 0;
    std::uint64_t answerHead_ = 0;
    alignas(64) std::uint64_t head_ = 0;
    std::uint64_t answerTail_ = 0;
    alignas(64) std::uint64_t latchedTail_ = 0, latchedHead_ = 0, latchedAnswerTail_ = 0,
                              latchedAnswerHead_ = 0;
};

// Sender's handle on one command of a related simplex, got in populate().
// Set the arguments through their handles, then send(); the answer stands from the sender's next
// task on. One command of this handle at a time has its answer kept; sends in a row are answered
// in order and counted.
class CommandSender {
public:
    CommandSender() = default;

    template <class T>
    Data<T> argument(std::string_view name) {
        return Data<T>{static_cast<typename StorageOf<T>::type*>(argumentCell(name, kindFor<T>()))};
    }
    template <class T>
    Data<const T> response(std::string_view name) {
        return Data<const T>{
            static_cast<typename StorageOf<const T>::type*>(responseCell(name, kindFor<T>()))};
    }
    // Returns None when it is on its way, else MailboxFull.
    Outcome send() CORTEX_REALTIME;
    // The newest answer: outcome None while there is none for the last send().
    const AnswerHead& answer() const;
    std::uint64_t sent() const;
    std::uint64_t answered() const;
    bool bound() const { return state_ != nullptr; }

    struct State;
    explicit CommandSender(std::shared_ptr<State> state) : state_{std::move(state)} {}

private:
    void* argumentCell(std::string_view name, Kind kind);
    const void* responseCell(std::string_view name, Kind kind);

    std::shared_ptr<State> state_;
};

}  // namespace cortex
