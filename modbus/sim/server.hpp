// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/connection.hpp"
#include "sim/listener.hpp"
#include "sim/simulated_device.hpp"

#include <chrono>
#include <list>
#include <utility>

#include <poll.h>

namespace cortex::modbus::sim {

// A device behind its socket, in the time of the monotonic clock. One connection commands it: the
// first that writes below F000, until it is closed. One thread.
class Server {
public:
    using Clock = Connection::Clock;

    // A pause of the process that is longer than `longestPause` is told to the device; 0: none is.
    Server(Listener listener, SimulatedDevice& device, std::chrono::nanoseconds longestPause)
        : listener_{std::move(listener)}, device_{device}, longestPause_{longestPause} {}

    // Until there is something to read from this descriptor.
    void run(int end);

private:
    class Access;
    bool wait(int end);
    void goOn();
    void serve(Connection& connection);
    void answer(Connection& connection, const Frame& asked);
    Octets spoilt(Frame answer, WrongWay way) const;
    void lookAtRefusal();
    void removeClosed();

    Listener listener_;
    SimulatedDevice& device_;
    std::chrono::nanoseconds longestPause_;
    std::list<Connection> connections_;
    const Connection* commander_ = nullptr;
    Clock::time_point now_ = Clock::now();
    Octets lastImage_;  // the last answer to an exchange
};

}  // namespace cortex::modbus::sim
