// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

// The network interfaces of this machine.
namespace cortex::comms {

struct NetworkInterface {
    std::string name;
    std::vector<std::string> ips;  // IPv4 addresses; those of one that is down, too
    bool hasIpv6 = false;          // an address that other hosts may reach
    bool up = false;
    bool running = false;  // it has a carrier
    bool loopback = false;
    bool card = false;  // hardware, not a bridge or a tunnel

    bool isUsed() const { return up && running && !ips.empty(); }
    bool operator==(const NetworkInterface&) const = default;
};

// In the order of the system. Throws Error if they cannot be listed.
std::vector<NetworkInterface> networkInterfaces();

// Those of them that these names or addresses mean; none: all.
std::vector<NetworkInterface> chosen(const std::vector<NetworkInterface>& all,
                                     const std::vector<std::string>& wanted);

// "interface eth0 is down: ip link set eth0 up"
std::string downText(const NetworkInterface& interface);

// Why nobody, or not everybody, can be heard on these, as sentences; none: nothing is amiss.
std::vector<std::string> troublesOf(const std::vector<NetworkInterface>& interfaces);

std::string namesOfUsed(const std::vector<NetworkInterface>& interfaces);  // "lo, eth0"

}  // namespace cortex::comms
