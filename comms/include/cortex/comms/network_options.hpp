// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace cortex::comms {

inline constexpr int lastDomain = 230;  // the last whose ports are below 65536

// The environment variable CORTEX_DOMAIN, 0 where it is not set; throws Error unless 0 to 230.
int defaultDomain();
// The environment variable CORTEX_SECURITY, empty where it is not set.
std::string defaultSecurity();

// The environment variable CORTEX_DISCOVERY_SERVER, empty where it is not set.
std::string defaultDiscoveryServer();

// The network that an agent or a tool joins. Joining throws Error if an option cannot be fulfilled.
struct NetworkOptions {
    int domain = defaultDomain();
    std::vector<std::string> interfaces;  // names or IPv4 addresses; none: all
    std::vector<std::string> peers;       // "host" or "host:port", where multicast does not reach
    // "host" or "host:port", instead of peers and multicast; several are joined by ";".
    std::string discoveryServer = defaultDiscoveryServer();
    bool sharedMemory = false;  // besides UDP
    std::string security =
        defaultSecurity();  // folder made by `cortex security create-agent`; empty: none
};

}  // namespace cortex::comms
