// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

// Addresses as people write them, checked against this machine and its resolver.
namespace cortex::comms {

struct Address {
    std::string ip;
    std::uint16_t port = 0;  // 0: not given
};

// IPv4 addresses of interfaces given by name or address; throws Error that lists the valid ones.
std::vector<std::string> interfaceAddresses(const std::vector<std::string>& interfaces);

// Throws Error if this process may not open as many files as a participant needs.
void requireFiles();

// The participants of a domain that a host has at most: the ports behind theirs are those of the
// next domain, whose participants they would meet.
inline constexpr int participantsOfDomain = 120;

// The lowest participant number of a domain whose port is free. Throws Error if all are taken. Fast
// DDS itself never uses a number twice in a process.
int freeParticipant(int domain);

// "host" or "host:port"; throws Error that names `option`.
Address addressOf(const std::string& text, const std::string& option);

}  // namespace cortex::comms
