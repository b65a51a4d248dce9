// SPDX-License-Identifier: Apache-2.0
#include "dds/network_interfaces.hpp"

#include "cortex/comms/network_options.hpp"
#include "cortex/core/error.hpp"

#include "wire/udp_sockets.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <set>

#include <ifaddrs.h>
#include <sys/socket.h>

#include <arpa/inet.h>
#include <net/if.h>
#include <netinet/in.h>

namespace cortex::comms {
namespace {

std::string ipOf(const sockaddr* address) {
    char ip[INET_ADDRSTRLEN] = {};
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(address)->sin_addr, ip, sizeof ip);
    return ip;
}

void add(const ifaddrs& entry, NetworkInterface& to) {
    to.up = (entry.ifa_flags & IFF_UP) != 0;
    to.running = (entry.ifa_flags & IFF_RUNNING) != 0;
    to.loopback = (entry.ifa_flags & IFF_LOOPBACK) != 0;
    if (entry.ifa_addr == nullptr) return;
    if (entry.ifa_addr->sa_family == AF_INET) to.ips.push_back(ipOf(entry.ifa_addr));
    if (entry.ifa_addr->sa_family != AF_INET6) return;
    const auto& ip = reinterpret_cast<const sockaddr_in6*>(entry.ifa_addr)->sin6_addr;
    if (IN6_IS_ADDR_LOOPBACK(&ip) == 0 && IN6_IS_ADDR_LINKLOCAL(&ip) == 0) to.hasIpv6 = true;
}

bool isTold(const NetworkOptions& options) {
    return !options.interfaces.empty() || !options.peers.empty() ||
           !options.discoveryServer.empty();
}

void addAddresses(NetworkOptions& options, bool loopbackToo) {
    for (const NetworkInterface& each : networkInterfaces()) {
        if (!each.isUsed() || (each.loopback && !loopbackToo)) continue;
        options.interfaces.insert(options.interfaces.end(), each.ips.begin(), each.ips.end());
    }
}

}  // namespace

std::vector<NetworkInterface> networkInterfaces() {
    ifaddrs* first = nullptr;
    if (getifaddrs(&first) != 0) {
        throw Error{std::string{"the network interfaces cannot be listed: "} +
                    std::strerror(errno)};
    }
    const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner{first, &freeifaddrs};
    std::vector<NetworkInterface> all;
    for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
        auto known = std::ranges::find(all, entry->ifa_name, &NetworkInterface::name);
        if (known == all.end()) {
            known = all.insert(all.end(), NetworkInterface{});
            known->name = entry->ifa_name;
            std::error_code none;
            known->card =
                std::filesystem::exists("/sys/class/net/" + known->name + "/device", none);
        }
        add(*entry, *known);
    }
    return all;
}

std::vector<NetworkInterface> chosen(const std::vector<NetworkInterface>& all,
                                     const std::vector<std::string>& wanted) {
    std::vector<NetworkInterface> found;
    for (const NetworkInterface& each : all) {
        const bool isWanted = std::ranges::any_of(wanted, [&](const std::string& one) {
            return one == each.name || std::ranges::count(each.ips, one) > 0;
        });
        if (wanted.empty() || isWanted) found.push_back(each);
    }
    return found;
}

std::string downText(const NetworkInterface& interface) {
    return "interface " + interface.name + " is down: ip link set " + interface.name + " up";
}

std::vector<std::string> troublesOf(const std::vector<NetworkInterface>& interfaces) {
    std::vector<std::string> troubles;
    const bool any = std::ranges::any_of(
        interfaces, [](const NetworkInterface& each) { return !each.loopback && each.isUsed(); });
    for (const NetworkInterface& each : interfaces) {
        if (each.loopback || (any && !each.card)) continue;
        const std::string name = "interface " + each.name;
        if (!each.up) {
            if (!any) troubles.push_back(downText(each));
        } else if (each.ips.empty() && each.hasIpv6) {
            troubles.push_back(name +
                               " has IPv6 addresses only; agents meet over IPv4: give it an "
                               "IPv4 address, which is then used at once");
        } else if (each.ips.empty() && !any) {
            troubles.push_back(name + " has no address yet; it is used as soon as it has one");
        } else if (!each.ips.empty() && !each.running) {
            troubles.push_back(name + " has no carrier: look at its cable or its link");
        }
    }
    if (troubles.empty() && std::ranges::none_of(interfaces, &NetworkInterface::isUsed)) {
        troubles.emplace_back("no network interface is up, so nobody is heard: ip link set lo up");
    }
    return troubles;
}

std::string namesOfUsed(const std::vector<NetworkInterface>& interfaces) {
    std::string names;
    for (const NetworkInterface& each : interfaces) {
        if (each.isUsed()) names += (names.empty() ? "" : ", ") + each.name;
    }
    return names.empty() ? "none" : names;
}

void alsoOnLoopback(NetworkOptions& options) {
    if (!isTold(options)) addAddresses(options, true);
}

void onNamedInterfaces(NetworkOptions& options, const std::string& sockets) {
    bool any = false, others = false;
    for (const UdpSocket& each : participantSockets(sockets)) {
        if (domainOf(each) != options.domain) continue;
        const bool named = each.address != INADDR_ANY && each.address != htonl(INADDR_LOOPBACK);
        (named ? any : others) = true;
    }
    if (any && !others && !isTold(options)) addAddresses(options, false);
}

std::string networkTrouble(const NetworkOptions& options) {
    const std::vector<NetworkInterface> picked = chosen(networkInterfaces(), options.interfaces);
    if (picked.empty() || std::ranges::any_of(picked, &NetworkInterface::isUsed)) return {};
    if (picked.size() == 1 && !picked.front().up && !options.interfaces.empty())
        return downText(picked.front());
    std::string text;
    for (const std::string& each : troublesOf(picked)) text += (text.empty() ? "" : "; ") + each;
    return text;
}

std::vector<int> domainsHere(const std::string& sockets) {
    std::set<int> domains;
    for (const UdpSocket& each : participantSockets(sockets)) {
        if (const auto domain = domainOf(each)) domains.insert(*domain);
    }
    return {domains.begin(), domains.end()};
}

}  // namespace cortex::comms
