// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace cortex::comms {

inline constexpr int lastDomain = 230;  // the last whose ports are below 65536

// The environment variable CORTEX_DOMAIN, 0 where it is not set; throws Error unless 0 to 230.
int defaultDomain();
// The environment variable CORTEX_INTERFACE: names or addresses with blanks between.
std::vector<std::string> defaultInterfaces();
// The environment variable CORTEX_SECURITY, empty where it is not set.
std::string defaultSecurity();

// The environment variable CORTEX_DISCOVERY_SERVER, empty where it is not set.
std::string defaultDiscoveryServer();

// Whether there are participants of the domain on this machine and all keep to the loopback
// interface, where one that uses the other interfaces does not meet them. `sockets`: as Linux lists
// them.
bool onlyOnLoopback(int domain, const std::string& sockets = "/proc/net/udp");

// The network that an agent or a tool joins. Joining throws Error if an option cannot be fulfilled.
struct NetworkOptions {
    // The DDS domain, 0 to 230. Only agents and tools of one domain meet.
    int domain = defaultDomain();
    // Names ("eth0") or IPv4 addresses of this machine's interfaces to use. None: all.
    std::vector<std::string> interfaces = defaultInterfaces();
    // "host" or "host:port" of agents and tools that multicast does not reach.
    std::vector<std::string> peers;
    // "host" or "host:port" of a Fast DDS Discovery Server, which replaces peers and multicast.
    // Several are joined by ";".
    std::string discoveryServer = defaultDiscoveryServer();
    // Besides UDP, processes of one machine exchange data through shared memory.
    bool sharedMemory = false;
    // A folder made by `cortex security create-agent`. Empty: no security.
    std::string security = defaultSecurity();
};

}  // namespace cortex::comms
