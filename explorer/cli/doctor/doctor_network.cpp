// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/machine.hpp"

#include "doctor/doctor.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <string_view>

#include <ifaddrs.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <arpa/inet.h>
#include <net/if.h>
#include <netinet/in.h>

namespace cortex::cli {
namespace {

using Level = Diagnosis::Level;

constexpr const char* discoveryGroup = "239.255.0.1";  // as RTPS has it
constexpr int participants = 120;  // of one host: the ports behind are those of the next domain
constexpr long enoughBuffer = 1 << 20;

class Socket {
public:
    Socket() : handle_{socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)} {}
    ~Socket() {
        if (handle_ >= 0) close(handle_);
    }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;

    int handle() const { return handle_; }
    template <class T>
    bool set(int level, int option, const T& value) const {
        return setsockopt(handle_, level, option, &value, sizeof value) == 0;
    }
    bool bindTo(int port) const {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        return bind(handle_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    }
    sockaddr_in address() const {
        sockaddr_in address{};
        socklen_t size = sizeof address;
        getsockname(handle_, reinterpret_cast<sockaddr*>(&address), &size);
        return address;
    }

private:
    int handle_;
};

struct Interface {
    std::string name;
    in_addr address{};
    bool loopback = false, multicast = false;

    std::string text() const {
        char ip[INET_ADDRSTRLEN] = {};
        inet_ntop(AF_INET, &address, ip, sizeof ip);
        return name + " (" + ip + ")";
    }
};

std::vector<Interface> interfaces() {
    ifaddrs* first = nullptr;
    if (getifaddrs(&first) != 0) return {};
    const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner{first, &freeifaddrs};
    std::vector<Interface> found;
    for (const ifaddrs* each = first; each != nullptr; each = each->ifa_next) {
        const bool usable = each->ifa_addr != nullptr && each->ifa_addr->sa_family == AF_INET &&
                            (each->ifa_flags & IFF_UP) != 0;
        if (!usable) continue;
        found.push_back(
            {each->ifa_name, reinterpret_cast<const sockaddr_in*>(each->ifa_addr)->sin_addr,
             (each->ifa_flags & IFF_LOOPBACK) != 0, (each->ifa_flags & IFF_MULTICAST) != 0});
    }
    return found;
}

// Sends a short text to the group of discovery, at a port of its own, and waits for it. The text
// does not leave the host. Empty: it came.
std::string multicastTrouble(const Interface& interface) {
    const Socket receiver, sender;
    ip_mreqn group{};
    inet_pton(AF_INET, discoveryGroup, &group.imr_multiaddr);
    group.imr_address = interface.address;
    group.imr_ifindex = static_cast<int>(if_nametoindex(interface.name.c_str()));
    const unsigned char hops = 0, loop = 1;
    const bool ready = receiver.bindTo(0) && receiver.set(IPPROTO_IP, IP_ADD_MEMBERSHIP, group) &&
                       sender.set(IPPROTO_IP, IP_MULTICAST_IF, group) &&
                       sender.set(IPPROTO_IP, IP_MULTICAST_TTL, hops) &&
                       sender.set(IPPROTO_IP, IP_MULTICAST_LOOP, loop);
    if (!ready) return std::strerror(errno);
    sockaddr_in target = receiver.address();
    target.sin_addr = group.imr_multiaddr;
    const std::string_view text = "cortex doctor";
    if (sendto(sender.handle(), text.data(), text.size(), 0,
               reinterpret_cast<const sockaddr*>(&target), sizeof target) < 0) {
        return std::strerror(errno);
    }
    pollfd file{receiver.handle(), POLLIN, 0};
    return poll(&file, 1, 500) == 1 ? "" : "it does not come back";
}

void examineInterfaces(Diagnoses& found) {
    std::size_t outward = 0;
    const std::vector<Interface> all = interfaces();
    if (all.empty()) {
        found.push_back({Level::Error, "interface", "no network interface is up",
                         "ip link set lo up reaches this host, and another one other hosts"});
        return;
    }
    for (const Interface& each : all) {
        if (each.loopback) {
            found.push_back({Level::Ok, "interface", each.text() + ": this host only", ""});
            continue;
        }
        ++outward;
        const std::string trouble =
            each.multicast ? multicastTrouble(each) : "the interface has none";
        if (trouble.empty()) {
            found.push_back({Level::Ok, "interface", each.text() + ": multicast works", ""});
        } else {
            found.push_back({Level::Warning, "interface",
                             each.text() + ": no multicast: " + trouble,
                             "allow UDP to " + std::string{discoveryGroup} +
                                 " in the firewall, or name other hosts with --peer HOST"});
        }
    }
    if (outward > 0) return;
    found.push_back(
        {Level::Warning, "interface", "no network but this host itself",
         "for other hosts bring a card up: ip link set NAME up, with a name from ip -brief link"});
}

bool canBind(int port, bool shared) {
    const Socket socket;
    const int yes = 1;
    if (shared) socket.set(SOL_SOCKET, SO_REUSEADDR, yes);
    return socket.bindTo(port);
}

void examinePorts(int domain, Diagnoses& found) {
    const int base = 7400 + 250 * domain;
    const std::string subject = "ports";
    if (!canBind(base, true)) {
        found.push_back({Level::Error, subject,
                         "UDP port " + std::to_string(base) + " of domain " +
                             std::to_string(domain) +
                             " is held by a program that does not share it",
                         "end that program (ss -ulpn names it), or use another domain"});
    }
    int used = 0;
    for (int i = 0; i < participants; ++i) used += canBind(base + 10 + 2 * i, false) ? 0 : 1;
    const std::string text = "domain " + std::to_string(domain) + " begins at UDP port " +
                             std::to_string(base) + ", " + std::to_string(used) + " of " +
                             std::to_string(participants) +
                             " places for participants of this host are used";
    if (used == participants) {
        found.push_back(
            {Level::Error, subject, text,
             "end programs that hold them (ss -ulpn lists them), or use another domain"});
    } else {
        found.push_back({Level::Ok, subject, text, ""});
    }
    std::istringstream range{firstLineOf("/proc/sys/net/ipv4/ip_local_port_range")};
    int first = 0, last = 0;
    const bool known = static_cast<bool>(range >> first >> last);
    if (known && base + 249 >= first && base <= last) {
        found.push_back({Level::Warning, subject,
                         "the system gives ports of domain " + std::to_string(domain) +
                             " to other programs too (" + std::to_string(first) + " to " +
                             std::to_string(last) + ")",
                         "use a domain up to " + std::to_string((first - 7400) / 250 - 1)});
    }
}

void examineBuffers(Diagnoses& found) {
    for (const std::string each : {"rmem_max", "wmem_max"}) {
        const std::string text = firstLineOf("/proc/sys/net/core/" + each);
        if (text.empty()) continue;
        if (std::strtol(text.c_str(), nullptr, 10) >= enoughBuffer) {
            found.push_back({Level::Ok, "buffers", each + " " + text + " bytes", ""});
        } else {
            found.push_back({Level::Warning, "buffers",
                             each + " " + text + " bytes: many agents at once lose messages",
                             "sudo sysctl net.core." + each + "=4194304"});
        }
    }
}

// Rules of a firewall can be read by root only; that one is on can be seen.
void examineFirewall(int domain, Diagnoses& found) {
    const std::string ports =
        std::to_string(7400 + 250 * domain) + ":" + std::to_string(7649 + 250 * domain);
    const bool firewalld = access("/run/firewalld", F_OK) == 0;
    std::string ufw;
    for (const char* each : {"yes", "YES"}) {
        std::ifstream stream{"/etc/ufw/ufw.conf"};
        for (std::string line; std::getline(stream, line);) {
            if (line == std::string{"ENABLED="} + each) ufw = "ufw";
        }
    }
    if (!ufw.empty()) {
        found.push_back({Level::Warning, "firewall", "ufw is on: it may keep other hosts out",
                         "sudo ufw allow proto udp to any port " + ports});
    } else if (firewalld) {
        std::string range = ports;
        std::ranges::replace(range, ':', '-');
        found.push_back({Level::Warning, "firewall", "firewalld is on: it may keep other hosts out",
                         "sudo firewall-cmd --add-port=" + range + "/udp"});
    } else {
        found.push_back({Level::Ok, "firewall",
                         "neither ufw nor firewalld is on; agents need UDP ports " + ports, ""});
    }
}

}  // namespace

void examineNetwork(int domain, Diagnoses& found) {
    examineInterfaces(found);
    examinePorts(domain, found);
    examineBuffers(found);
    examineFirewall(domain, found);
}

}  // namespace cortex::cli
