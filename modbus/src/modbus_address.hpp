// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <sys/socket.h>

#include <netinet/in.h>

namespace cortex::modbus {

inline constexpr std::uint16_t defaultPort = 502;

// Where a Modbus/TCP server listens: an IPv4 or IPv6 address or "localhost", and a port. A name is
// none, as nobody can say how long looking it up takes.
class ModbusAddress {
public:
    // "192.168.1.10", "192.168.1.10:502", "[2001:db8::7]:502", "[fe80::1%eth0]", "localhost:1502".
    // Throws Error, also for an interface behind '%' that this machine does not have.
    static ModbusAddress parse(std::string_view text);

    std::string text() const;  // with the port
    // The same text for every spelling of what is connected to.
    std::string numericText() const;
    const sockaddr* socketAddress() const;
    socklen_t length() const;

private:
    void takeV4(std::string_view text, std::uint16_t port);  // in the order of the network
    void takeV6(std::string_view text, std::uint16_t port);

    std::string host_;
    sockaddr_in v4_{};
    sockaddr_in6 v6_{};
};

}  // namespace cortex::modbus
