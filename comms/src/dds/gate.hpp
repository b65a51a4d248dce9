// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

namespace cortex::comms {

// What a participant receives passes here, once it can take it. Any thread.
class Gate {
public:
    void open();
    // Nothing passes any more.
    void close() { isClosed_ = true; }
    // Waits until it is open, a quarter of a second at most; what is received passes meanwhile, if
    // it owns the lock.
    std::unique_lock<std::mutex> pass();
    // Nothing passes meanwhile. Not by a thread that something is just passed to.
    std::unique_lock<std::mutex> hold() { return std::unique_lock{passing_}; }

private:
    std::atomic<bool> isOpen_{false}, isClosed_{false};
    std::mutex mutex_;
    std::condition_variable opened_;
    static inline std::mutex passing_;  // of all participants of the process
};

// Makes up for faults of Fast DDS 2.9, in the first transport of a participant that is about to be
// made. It announces a participant before it connects its receivers, so answers that come at once
// are lost: what comes waits at the gate. It drops a message of a handshake while another thread
// deals with the same participant, and with security its threads look up participants and endpoints
// that others of them just make or delete: so what comes goes on one by one, and who makes or
// deletes endpoints or changes the participant is to hold the gate. It ends the process where
// somebody leaves just as his lease is looked at: who leaves himself closes the gate first. What is
// lost comes again with the next announcement, and of a handshake after a second.
std::shared_ptr<Gate> addGate(eprosima::fastdds::dds::DomainParticipantQos& qos);

}  // namespace cortex::comms
