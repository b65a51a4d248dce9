// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dds/unsent_samples.hpp"
#include "rtps/datagram_filter.hpp"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

namespace cortex::comms {

// Holds back what a participant receives until it can process it, drops what could harm it, and
// passes the rest on one by one.
//
// **Invariants**
// 1. A gate is closed for input at first. open() lets messages pass; it is called once the first
//    endpoints exist. close() drops everything from then on, and is never undone.
// 2. Every thread of Fast DDS that receives on the gated transport calls pass() for each message,
//    and holds the lock that it returns until Fast DDS has processed the message.
// 3. `passing_` is one lock for all participants of the process. So at most one thread processes a
//    received message at a time.
// 4. Whoever makes or deletes an endpoint, or changes the participant, calls hold() and keeps that
//    lock meanwhile. Nothing is received then.
// 5. A callback of DDS runs while its message passes, and so under the lock. It must never call
//    hold(), nor wait for a thread that does.
// 6. Fast DDS takes its own locks after `passing_`, never before it. So the order of locks is the
//    same on every thread.
// 7. pass() waits at most 250 ms for open(). So a participant that never opens its gate
//    receives late, but the threads of Fast DDS never hang. After that time the gate counts as
//    open.
// 8. What the filter drops takes no lock but the filter's own.
// 9. `isOpen_` only changes from false to true, and is written under `mutex_`, so that no waiting
//    thread misses it.
class Gate {
public:
    explicit Gate(const rtps::Prefix& us = {}, int domain = 0, bool isRelayed = false)
        : filter{us, domain, isRelayed} {}

    void open();
    // Drops everything from now on.
    void close() { isClosed_ = true; }
    // Waits until the gate is open. A message passes while the result owns the lock; if it owns
    // none, the message is dropped.
    std::unique_lock<std::mutex> pass();
    // Nothing passes while the result owns the lock. A thread that processes a message must not
    // call it.
    std::unique_lock<std::mutex> hold() { return std::unique_lock{passing_}; }

    rtps::DatagramFilter filter;  // every datagram passes it first
    UnsentSamples unsent;         // of all writers
    // The id of the writer whose samples are sent in fragments of one packet; 0: none.
    std::atomic<std::uint32_t> cutWriter{0};
    // Whether what is said of endpoints is sent three times. Fast DDS repeats it once a second.
    std::atomic<bool> repeatsEndpoints{true};

private:
    std::atomic<bool> isOpen_{false}, isClosed_{false};
    std::mutex mutex_;
    std::condition_variable opened_;
    static inline std::mutex passing_;  // for all participants of the process
};

// Works around faults of Fast DDS 2.9, in the first transport of a participant that is about to be
// made:
// 1. It announces a participant before it connects its receivers, and loses early answers. They
//    wait at the gate.
// 2. It drops a message of a handshake while another thread handles the same participant. With
//    security, its threads look up participants and endpoints that other threads make or delete at
//    that moment. So messages pass one by one, and changes hold the gate.
// 3. An assertion ends the process when a participant leaves while its lease is checked. So a
//    participant that leaves closes its gate first.
// What is lost comes again with the next announcement, or after a second in a handshake.
// `isRelayed`: a Discovery Server passes on what participants say.
std::shared_ptr<Gate> addGate(eprosima::fastdds::dds::DomainParticipantQos& qos, int domain,
                              bool isRelayed);

}  // namespace cortex::comms
