// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/error.hpp"

#include <functional>
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

// How many participants of the domain on this machine keep to the loopback interface, where one
// that uses the other interfaces does not meet them. `sockets`: as Linux lists them.
enum class OnLoopback { None, Some, All };
OnLoopback onLoopback(int domain, const std::string& sockets = "/proc/thread-self/net/udp");

// Domains of which this machine has participants, from its UDP sockets, as Linux lists them.
std::vector<int> domainsHere(const std::string& sockets = "/proc/thread-self/net/udp");

struct NetworkOptions;
// For a tool that is told no interface, peer or server: all interfaces, that of the loopback named
// with them, so that it meets who keeps to it. Throws Error if the
// interfaces cannot be listed.
void alsoOnLoopback(NetworkOptions& options);
// The same where all participants of the domain on this machine keep to named interfaces, none of
// them the loopback: all interfaces but that one. Otherwise Fast DDS sends to addresses of its own
// machine over the loopback interface, where they do not listen. `sockets`: as Linux lists them.
void onNamedInterfaces(NetworkOptions& options,
                       const std::string& sockets = "/proc/thread-self/net/udp");
// Why nobody at all can be heard with these options, with the remedy; empty: somebody may be.
std::string networkTrouble(const NetworkOptions& options);

// What an agent does where another start of its name was there first.
enum class OnSecondStart {
    Silent,   // it runs, and says nothing until the other has ended
    Refused,  // it does not start: SecondStart
    Waits     // it starts when the other has ended
};

// Another start of the agent's name is there.
class SecondStart : public Error {
public:
    using Error::Error;
};

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
    // Of an agent. Refused and Waits first listen for 0.1 to 2 s, before devices are opened.
    OnSecondStart onSecondStart = OnSecondStart::Silent;
    // Of Waits, on the thread that starts: waits until `ended` is true. False: it waits no longer,
    // which throws SecondStart. None given: the wait has no other end.
    std::function<bool(const std::function<bool()>& ended)> waitForFirst;
};

}  // namespace cortex::comms
