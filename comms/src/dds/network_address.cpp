// SPDX-License-Identifier: Apache-2.0
#include "dds/network_address.hpp"

#include "cortex/core/error.hpp"

#include "dds/network_interfaces.hpp"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string_view>

#include <netdb.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <arpa/inet.h>
#include <netinet/in.h>

namespace cortex::comms {
namespace {

constexpr rlim_t filesOfParticipant = 32;  // sockets and what a thread opens now and then

std::string listed(const std::vector<NetworkInterface>& interfaces) {
    std::string list;
    for (const NetworkInterface& one : interfaces) {
        if (!one.up) continue;
        std::string ips;
        for (const std::string& ip : one.ips) ips += (ips.empty() ? "" : ", ") + ip;
        list += (list.empty() ? "" : ", ") + one.name + " (" +
                (ips.empty() ? "no IPv4 address" : ips) + ")";
    }
    return list.empty() ? "none" : list;
}

// Tries the port as Fast DDS would. Fast DDS itself does not report a failure, and then receives
// nothing.
bool canBind(int port) {
    const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (descriptor < 0) {
        throw Error{
            std::string{"no UDP socket can be opened: "} + std::strerror(errno) +
            (errno == EMFILE ? "; allow this process more open files (ulimit -n 1024)" : "")};
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    const int result =
        bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    close(descriptor);
    return result == 0;
}

}  // namespace

std::vector<std::string> interfaceAddresses(const std::vector<std::string>& interfaces) {
    std::vector<std::string> addresses;
    if (interfaces.empty()) return addresses;
    const std::vector<NetworkInterface> all = networkInterfaces();
    std::string unknown;
    for (const std::string& wanted : interfaces) {
        const std::size_t before = addresses.size();
        for (const NetworkInterface& one : all) {
            for (const std::string& ip : one.ips) {
                if (one.up && (one.name == wanted || ip == wanted)) addresses.push_back(ip);
            }
        }
        if (addresses.size() == before) unknown += (unknown.empty() ? "'" : ", '") + wanted + "'";
    }
    for (const NetworkInterface& one : chosen(all, interfaces)) {
        if (!one.up) throw Error{downText(one)};
    }
    if (!unknown.empty()) {
        throw Error{"no active network interface has the name or IPv4 address " + unknown +
                    "; this machine has " + listed(all)};
    }
    return addresses;
}

void requireFiles() {
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
    std::error_code none;
    const auto open = std::distance(std::filesystem::directory_iterator{"/proc/self/fd", none},
                                    std::filesystem::directory_iterator{});
    const auto needed = static_cast<rlim_t>(open) + filesOfParticipant;
    if (none || limit.rlim_cur >= needed) return;  // without /proc nobody can tell
    throw Error{"this process may open " + std::to_string(limit.rlim_cur) +
                " files, and needs at least " + std::to_string(needed) +
                " to join the network: allow more (ulimit -n 1024)"};
}

int freeParticipant(int domain) {
    const int first = 7410 + 250 * domain;  // as RTPS defines it: 2 for each participant
    const int end = first + 2 * participantsOfDomain;
    for (int port = first; port < end; port += 2) {
        if (canBind(port)) return (port - first) / 2;
    }
    throw Error{"no UDP port is free for domain " + std::to_string(domain) + " (every other from " +
                std::to_string(first) + " to " + std::to_string(end - 2) + "): a host has " +
                std::to_string(participantsOfDomain) +
                " participants of a domain at most, as the next ports are those of the next "
                "domain; join another domain, or end programs that hold them (`ss -ulpn` lists "
                "them)"};
}

Address addressOf(const std::string& text, const std::string& option) {
    const std::size_t colon = text.find(':');
    const std::string host = text.substr(0, colon);
    Address address;
    if (colon != std::string::npos) {
        const std::string_view digits = std::string_view{text}.substr(colon + 1);
        const auto [end, error] = std::from_chars(digits.begin(), digits.end(), address.port);
        if (error != std::errc{} || end != digits.end() || address.port == 0) {
            throw Error{option + " '" + text + "': the port must be a number from 1 to 65535"};
        }
    }
    addrinfo hints{}, *first = nullptr;
    hints.ai_family = AF_INET;
    hints.ai_socktype = SOCK_DGRAM;
    if (host.empty() || getaddrinfo(host.c_str(), nullptr, &hints, &first) != 0) {
        throw Error{option + " '" + text + "': no IPv4 address is known for this host; " +
                    "give an address such as 192.168.1.10, or a name that resolves"};
    }
    const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owner{first, &freeaddrinfo};
    char ip[INET_ADDRSTRLEN] = {};
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(first->ai_addr)->sin_addr, ip,
              sizeof ip);
    address.ip = ip;
    return address;
}

}  // namespace cortex::comms
