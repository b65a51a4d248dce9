// SPDX-License-Identifier: Apache-2.0
#include "cortex/comms/network_options.hpp"

#include <charconv>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

#include <netinet/in.h>

namespace cortex::comms {
namespace {

constexpr std::uint32_t firstUnicastPort = 7410, portsOfDomain = 250;

std::uint32_t fromHex(std::string_view digits) {
    std::uint32_t number = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
    return number;
}

}  // namespace

// The kernel lists the sockets of this machine as ADDRESS:PORT in hexadecimal digits; those of
// participants are at ports of the domain.
bool onlyOnLoopback(int domain, const std::string& sockets) {
    constexpr std::size_t addressDigits = 8;
    const std::uint32_t first =
        firstUnicastPort + portsOfDomain * static_cast<std::uint32_t>(domain);
    const std::uint32_t end = first + portsOfDomain - 10;  // the next domain's multicast is there
    std::ifstream file{sockets};
    std::string line, number, local;
    std::getline(file, line);  // the titles
    bool any = false;
    while (file >> number >> local && std::getline(file, line)) {
        const std::string_view text{local};
        if (text.find(':') != addressDigits) continue;
        const std::uint32_t port = fromHex(text.substr(addressDigits + 1));
        if (port < first || port >= end) continue;
        if (fromHex(text.substr(0, addressDigits)) != htonl(INADDR_LOOPBACK)) return false;
        any = true;
    }
    return any;
}

}  // namespace cortex::comms
