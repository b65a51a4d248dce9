// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/connection.hpp"
#include "sim/listener.hpp"
#include "sim/simulated_drive.hpp"

#include <chrono>
#include <list>

#include <poll.h>

namespace cortex::modbus::sim {

// The drive behind its socket, in the time of the monotonic clock. One connection commands it: the
// first that writes below F000, until it is closed. One thread.
class Server {
public:
    using Clock = Connection::Clock;

    // A pause of the process that is longer than `longestPause` is told to the drive; 0: none is.
    Server(Listener listener, SimulatedDrive& drive, std::chrono::nanoseconds longestPause)
        : listener_{std::move(listener)}, drive_{drive}, longestPause_{longestPause} {}

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
    SimulatedDrive& drive_;
    std::chrono::nanoseconds longestPause_;
    std::list<Connection> connections_;
    const Connection* commander_ = nullptr;
    Clock::time_point now_ = Clock::now();
    Octets lastImage_;  // the last answer to FC 23
};

}  // namespace cortex::modbus::sim
