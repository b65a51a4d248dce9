// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

namespace cortex {

// Time of a loop thread's current chunk, for latencies; ns, monotonic.
struct ChunkClock {
    std::int64_t cycle = 0;
    std::int64_t nanoseconds = 0;
};

// An answer as the sender sees it. The words stand last, so that a Done touches one cache line.
struct AnswerHead {
    std::uint64_t number = 0;  // of the command on its lane, from 1
    std::int64_t latencyCycles = 0;
    std::int64_t latency = 0;  // ns, chunk resolution
    Outcome outcome = Outcome::None;
    Reason reason = Reason::None;
    EventText why;
};

class Lane;

// Sender's handle on one command of a related simplex, got in populate(). Set the arguments through
// their handles, then send(); the answer stands from the sender's next task on. The newest answer
// is kept; sends in a row are answered in order and counted. Getting an argument of `set` means
// that every send() sets that item.
class CommandSender {
public:
    CommandSender() = default;

    template <class T>
    Data<T> argument(std::string_view name) {
        return Data<T>{static_cast<typename StorageOf<T>::type*>(
            argumentCells(name, kindFor<T>(), false).first)};
    }
    template <ArrayElement T>
    std::span<T> arrayArgument(std::string_view name) {
        const auto [first, length] = argumentCells(name, kindFor<T>(), true);
        return {static_cast<T*>(first), length};
    }
    template <class T>
    Data<const T> response(std::string_view name) {
        return Data<const T>{static_cast<typename StorageOf<const T>::type*>(
            responseCells(name, kindFor<T>(), false).first)};
    }
    template <ArrayElement T>
    std::span<const T> arrayResponse(std::string_view name) {
        const auto [first, length] = responseCells(name, kindFor<T>(), true);
        return {static_cast<const T*>(first), length};
    }
    // Returns None if the command is on its way, otherwise MailboxFull; or Rejected, where a
    // parameter without a default was never set: answer() says which.
    Outcome send() CORTEX_REALTIME;
    // The newest answer; outcome None from a send() until the next answer comes.
    const AnswerHead& answer() const;
    std::uint64_t sent() const;
    std::uint64_t answered() const;
    bool bound() const { return state_ != nullptr; }

    struct State;
    explicit CommandSender(std::shared_ptr<State> state) : state_{std::move(state)} {}

private:
    State& boundState() const CORTEX_REALTIME;  // throws UnboundHandle
    std::pair<void*, std::size_t> argumentCells(std::string_view name, Kind kind, bool array);
    std::pair<const void*, std::size_t> responseCells(std::string_view name, Kind kind, bool array);

    std::shared_ptr<State> state_;
};

}  // namespace cortex
