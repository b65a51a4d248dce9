// SPDX-License-Identifier: Apache-2.0
#include "wire/udp_sockets.hpp"

#include "cortex/comms/network_options.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string_view>

namespace cortex::comms {
namespace {

// RTPS: the multicast ports of a domain come first; the last ten are next to those of the next one.
constexpr std::uint32_t firstUnicastPort = 7410, portsOfDomain = 250, notUsed = 10;

std::uint32_t fromHex(std::string_view digits) {
    std::uint32_t number = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
    return number;
}

}  // namespace

// Each line has ADDRESS:PORT in hexadecimal digits behind its number.
std::vector<UdpSocket> udpSockets(const std::string& file) {
    constexpr std::size_t addressDigits = 8;
    std::vector<UdpSocket> sockets;
    std::ifstream in{file};
    std::string line, number, local;
    std::getline(in, line);  // the titles
    while (in >> number >> local && std::getline(in, line)) {
        const std::string_view text{local};
        if (text.find(':') != addressDigits) continue;
        sockets.push_back(
            {fromHex(text.substr(0, addressDigits)), fromHex(text.substr(addressDigits + 1))});
    }
    return sockets;
}

std::vector<UdpSocket> participantSockets(const std::string& file) {
    const std::vector<UdpSocket> all = udpSockets(file);
    std::vector<UdpSocket> found;
    for (const UdpSocket& each : all) {
        if (!domainOf(each)) continue;
        const bool isFirst = (each.port - firstUnicastPort) % 2 == 0;
        const std::uint32_t beside = isFirst ? each.port + 1 : each.port - 1;
        const auto isBeside = [&](const UdpSocket& other) {
            return other.port == beside && other.address == each.address;
        };
        if (std::ranges::any_of(all, isBeside)) found.push_back(each);
    }
    return found;
}

std::optional<int> domainOf(const UdpSocket& socket) {
    if (socket.port < firstUnicastPort) return {};
    const std::uint32_t domain = (socket.port - firstUnicastPort) / portsOfDomain;
    const std::uint32_t within = (socket.port - firstUnicastPort) % portsOfDomain;
    if (domain > lastDomain || within >= portsOfDomain - notUsed) return {};
    return static_cast<int>(domain);
}

}  // namespace cortex::comms
