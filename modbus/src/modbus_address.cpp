// SPDX-License-Identifier: Apache-2.0
#include "modbus_address.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/printable.hpp"

#include <charconv>

#include <arpa/inet.h>

namespace cortex::modbus {
namespace {

[[noreturn]] void refuse(std::string_view text, const std::string& why) {
    throw Error("address '" + printable(text) + "' " + why + "; write it as in 192.168.1.10:502");
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
    if (isV6 && end == std::string_view::npos) refuse(text, "has no ']' behind its host");
    ModbusAddress address;
    const std::size_t behind = end == std::string_view::npos ? text.size() : end + (isV6 ? 1 : 0);
    address.host_ = text.substr(0, behind);
    const std::uint16_t port = htons(portOf(text, text.substr(behind)));
    const std::string number = isV6                           ? address.host_.substr(1, end - 1)
                               : address.host_ == "localhost" ? "127.0.0.1"
                                                              : address.host_;
    const int family = isV6 ? AF_INET6 : AF_INET;
    void* const into = isV6 ? static_cast<void*>(&address.v6_.sin6_addr) : &address.v4_.sin_addr;
    if (inet_pton(family, number.c_str(), into) != 1) {
        refuse(text, "is no IP address, and a name may take long to look up");
    }
    (isV6 ? address.v6_.sin6_port : address.v4_.sin_port) = port;
    (isV6 ? address.v6_.sin6_family : address.v4_.sin_family) = static_cast<sa_family_t>(family);
    return address;
}

std::string ModbusAddress::text() const {
    const bool isV6 = v6_.sin6_family == AF_INET6;
    return host_ + ":" + std::to_string(ntohs(isV6 ? v6_.sin6_port : v4_.sin_port));
}

const sockaddr* ModbusAddress::socketAddress() const {
    return v6_.sin6_family == AF_INET6 ? reinterpret_cast<const sockaddr*>(&v6_)
                                       : reinterpret_cast<const sockaddr*>(&v4_);
}

socklen_t ModbusAddress::length() const {
    return v6_.sin6_family == AF_INET6 ? sizeof v6_ : sizeof v4_;
}

}  // namespace cortex::modbus
