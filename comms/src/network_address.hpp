// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

// Addresses as people write them, checked against this machine and its resolver.
namespace cortex::comms {

inline constexpr int LastDomain = 230;  // the last whose ports are below 65536

struct Address {
    std::string ip;
    std::uint16_t port = 0;  // 0: not given
};

// IPv4 addresses of interfaces given by name or address; throws Error that lists the valid ones.
std::vector<std::string> interfaceAddresses(const std::vector<std::string>& interfaces);

// Throws Error if none of the ports is free on which so many participants of a domain are asked.
void requireFreePort(int domain, int participants);

// "host" or "host:port"; throws Error that names `option`.
Address addressOf(const std::string& text, const std::string& option);

}  // namespace cortex::comms
