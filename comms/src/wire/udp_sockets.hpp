// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// The UDP sockets of this machine, of whichever process.
namespace cortex::comms {

struct UdpSocket {
    std::uint32_t address = 0;  // in the order of the network; 0: all interfaces
    std::uint32_t port = 0;
};

// From a file as Linux lists them; empty where it cannot be read.
std::vector<UdpSocket> udpSockets(const std::string& file = "/proc/thread-self/net/udp");

// Whether participants of a domain keep to the loopback interface, and whether others are not on
// it. Neither counts those that are on both, as they meet everybody.
struct Sides {
    bool loopback = false, others = false;
};
Sides sidesOf(int domain, const std::string& file = "/proc/thread-self/net/udp");

// The domain of the participant that has this socket; none: its port is not of one.
std::optional<int> domainOf(const UdpSocket& socket);

// Those of participants, which have two ports side by side each. The system gives single ports of
// high domains to whoever sends.
std::vector<UdpSocket> participantSockets(const std::string& file = "/proc/thread-self/net/udp");

}  // namespace cortex::comms
