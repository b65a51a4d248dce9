// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/listener.hpp"
#include "sim/modbus_frames.hpp"

#include <chrono>
#include <deque>
#include <optional>
#include <utility>

namespace cortex::modbus::sim {

// One client: requests that came, answers that wait for their time or for room in the socket. It
// never blocks. Answers go out in the order of their requests.
class Connection {
public:
    using Clock = std::chrono::steady_clock;

    explicit Connection(Descriptor socket) : socket_{std::move(socket)} {}

    int descriptor() const { return socket_.number(); }
    // False: it is at its end, by the client or as it does not speak Modbus/TCP.
    bool isOpen() const { return isOpen_; }
    void hangUp() { isOpen_ = false; }

    void receive();
    // The next request, in the order in which they came.
    std::optional<Frame> next();
    void answer(Octets octets, Clock::time_point due) {
        waiting_.push_back({std::move(octets), due});
    }
    void send(Clock::time_point now);

    // A client that takes no answers is not asked for requests.
    bool wantsToReceive() const { return waiting_.size() < mostWaiting; }
    bool waitsForRoom() const { return isFull_; }
    // When send() is to be called next, apart from room; never: max().
    Clock::time_point due() const {
        return waiting_.empty() || isFull_ ? Clock::time_point::max() : waiting_.front().due;
    }

private:
    static constexpr std::size_t mostWaiting = 64;
    struct Waiting {
        Octets octets;
        Clock::time_point due;
    };

    Descriptor socket_;
    Inbox inbox_;
    std::deque<Waiting> waiting_;
    std::size_t sent_ = 0;  // octets of the first that waits
    bool isOpen_ = true, isFull_ = false;
};

}  // namespace cortex::modbus::sim
