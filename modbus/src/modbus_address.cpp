// SPDX-License-Identifier: Apache-2.0
#include "modbus_address.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/printable.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>

#include <arpa/inet.h>
#include <net/if.h>

namespace cortex::modbus {
namespace {

[[noreturn]] void refuse(std::string_view text, const std::string& why,
                         const char* example = "192.168.1.10:502") {
    throw Error("address '" + printable(text) + "' " + why + "; write it as in " + example);
}

constexpr const char* exampleOfV6 = "[2001:db8::7]:502";

bool isLocalhost(std::string_view host) {
    constexpr std::string_view name = "localhost";
    return std::ranges::equal(host, name, {}, [](char c) { return static_cast<char>(c | 0x20); });
}

// The number of the network interface behind '%', which an address of a link needs; 0: none.
std::uint32_t zoneOf(std::string_view text, const std::string& host) {
    const std::size_t at = host.find('%');
    if (at == std::string::npos) return 0;
    const std::string zone = host.substr(at + 1);
    const std::uint32_t number = if_nametoindex(zone.c_str());
    if (number == 0) {
        refuse(text,
               "names the network interface '" + printable(zone) +
                   "', which this machine does not have (`ip link` lists those it has)",
               "[fe80::1%eth0]:502");
    }
    return number;
}

// What follows the host: nothing, or a colon and a number.
std::uint16_t portOf(std::string_view text, std::string_view rest) {
    if (rest.empty()) return defaultPort;
    unsigned port = 0;
    const char* const end = rest.data() + rest.size();
    const auto [read, error] = std::from_chars(rest.data() + 1, end, port);
    if (rest.front() != ':' || error != std::errc{} || read != end || port < 1 || port > 65535)
        refuse(text, "has no port from 1 to 65535 behind its host");
    return static_cast<std::uint16_t>(port);
}

}  // namespace

ModbusAddress ModbusAddress::parse(std::string_view text) {
    const bool isV6 = text.starts_with('[');
    const std::size_t end = text.find(isV6 ? ']' : ':');
    if (text.empty() || end == 0) refuse(text, "names no device");
    if (isV6 && end == std::string_view::npos)
        refuse(text, "has no ']' behind its host", exampleOfV6);
    if (!isV6 && text.find(':') != text.rfind(':'))
        refuse(text, "has several colons, and an IPv6 address stands in brackets", exampleOfV6);
    ModbusAddress address;
    const std::size_t behind = end == std::string_view::npos ? text.size() : end + (isV6 ? 1 : 0);
    address.host_ = text.substr(0, behind);
    const std::uint16_t port = htons(portOf(text, text.substr(behind)));
    if (isV6)
        address.takeV6(text, port);
    else
        address.takeV4(text, port);
    return address;
}

void ModbusAddress::takeV4(std::string_view text, std::uint16_t port) {
    if (isLocalhost(host_)) host_ = "localhost";
    const std::string number = host_ == "localhost" ? "127.0.0.1" : host_;
    if (inet_pton(AF_INET, number.c_str(), &v4_.sin_addr) != 1)
        refuse(text, "is no IP address, and a name may take long to look up");
    v4_.sin_port = port;
    v4_.sin_family = AF_INET;
}

void ModbusAddress::takeV6(std::string_view text, std::uint16_t port) {
    const std::string number = host_.substr(1, host_.find_first_of("%]") - 1);
    if (inet_pton(AF_INET6, number.c_str(), &v6_.sin6_addr) != 1)
        refuse(text, "is no IP address, and a name may take long to look up", exampleOfV6);
    v6_.sin6_scope_id = zoneOf(text, host_.substr(1, host_.size() - 2));
    v6_.sin6_port = port;
    v6_.sin6_family = AF_INET6;
}

std::string ModbusAddress::text() const {
    const bool isV6 = v6_.sin6_family == AF_INET6;
    return host_ + ":" + std::to_string(ntohs(isV6 ? v6_.sin6_port : v4_.sin_port));
}

// An address of all interfaces leads to this host, and an IPv4 one may stand within an IPv6 one.
std::string ModbusAddress::numericText() const {
    const bool isMapped = IN6_IS_ADDR_V4MAPPED(&v6_.sin6_addr);
    const bool isV6 = v6_.sin6_family == AF_INET6;
    const std::string port = ":" + std::to_string(ntohs(isV6 ? v6_.sin6_port : v4_.sin_port));
    std::array<char, INET6_ADDRSTRLEN> number{};
    if (isV6 && !isMapped) {
        const in6_addr& address =
            IN6_IS_ADDR_UNSPECIFIED(&v6_.sin6_addr) ? in6addr_loopback : v6_.sin6_addr;
        inet_ntop(AF_INET6, &address, number.data(), number.size());
        const std::uint32_t zone = v6_.sin6_scope_id;
        return "[" + std::string{number.data()} + (zone == 0 ? "" : "%" + std::to_string(zone)) +
               "]" + port;
    }
    in_addr address = v4_.sin_addr;
    if (isMapped) std::memcpy(&address, v6_.sin6_addr.s6_addr + 12, sizeof address);
    if (address.s_addr == htonl(INADDR_ANY)) address.s_addr = htonl(INADDR_LOOPBACK);
    inet_ntop(AF_INET, &address, number.data(), number.size());
    return number.data() + port;
}

const sockaddr* ModbusAddress::socketAddress() const {
    return v6_.sin6_family == AF_INET6 ? reinterpret_cast<const sockaddr*>(&v6_)
                                       : reinterpret_cast<const sockaddr*>(&v4_);
}

socklen_t ModbusAddress::length() const {
    return v6_.sin6_family == AF_INET6 ? sizeof v6_ : sizeof v4_;
}

}  // namespace cortex::modbus
