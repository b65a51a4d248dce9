// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"

#include "modbus_address.hpp"

#include <string>

#include <gtest/gtest.h>
#include <net/if.h>

namespace cortex::modbus::test {
namespace {

std::string refusalOfAddress(const std::string& text) {
    try {
        ModbusAddress::parse(text);
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

TEST(ModbusAddress, HasOneNumericTextHoweverItIsSpelled) {
    for (const char* text : {"localhost:1502", "LOCALHOST:1502", "127.0.0.1:001502", "0.0.0.0:1502",
                             "[::ffff:127.0.0.1]:1502", "[::FFFF:7f00:1]:1502"})
        EXPECT_EQ(ModbusAddress::parse(text).numericText(), "127.0.0.1:1502") << text;
    for (const char* text : {"[::1]", "[0:0:0:0:0:0:0:1]:502", "[::]:0502"})
        EXPECT_EQ(ModbusAddress::parse(text).numericText(), "[::1]:502") << text;
    EXPECT_EQ(ModbusAddress::parse("[2001:DB8:0::7]").numericText(), "[2001:db8::7]:502");
    EXPECT_EQ(ModbusAddress::parse("[::ffff:192.168.1.10]").numericText(), "192.168.1.10:502");
    EXPECT_EQ(ModbusAddress::parse("[fe80::1%lo]").numericText(),
              "[fe80::1%" + std::to_string(if_nametoindex("lo")) + "]:502");
}

TEST(ModbusAddress, IsAHostAndAPortOr502) {
    EXPECT_EQ(ModbusAddress::parse("192.168.1.10").text(), "192.168.1.10:502");
    EXPECT_EQ(ModbusAddress::parse("192.168.1.10:1502").text(), "192.168.1.10:1502");
    EXPECT_EQ(ModbusAddress::parse("localhost").text(), "localhost:502");
    EXPECT_EQ(ModbusAddress::parse("[fe80::1]").text(), "[fe80::1]:502");
    EXPECT_EQ(ModbusAddress::parse("[::1]:65535").text(), "[::1]:65535");
    EXPECT_EQ(ModbusAddress::parse("LocalHost:1502").text(), "localhost:1502");

    const ModbusAddress v4 = ModbusAddress::parse("localhost:1502");
    EXPECT_EQ(v4.socketAddress()->sa_family, AF_INET);
    EXPECT_EQ(v4.length(), sizeof(sockaddr_in));
    const auto* const place = reinterpret_cast<const sockaddr_in*>(v4.socketAddress());
    EXPECT_EQ(ntohl(place->sin_addr.s_addr), INADDR_LOOPBACK);
    EXPECT_EQ(ntohs(place->sin_port), 1502);
    EXPECT_EQ(ModbusAddress::parse("[::1]").socketAddress()->sa_family, AF_INET6);
}

TEST(ModbusAddress, OfALinkNamesANetworkInterface) {
    const ModbusAddress address = ModbusAddress::parse("[fe80::1%lo]:1502");
    EXPECT_EQ(address.text(), "[fe80::1%lo]:1502");
    const auto* const place = reinterpret_cast<const sockaddr_in6*>(address.socketAddress());
    EXPECT_EQ(place->sin6_scope_id, if_nametoindex("lo"));
    EXPECT_EQ(place->sin6_addr.s6_addr[0], 0xFE);
    EXPECT_EQ(place->sin6_addr.s6_addr[15], 1);
    EXPECT_EQ(refusalOfAddress("[fe80::1%nowhere]"),
              "address '[fe80::1%nowhere]' names the network interface 'nowhere', which this "
              "machine does not have (`ip link` lists those it has); write it as in "
              "[fe80::1%eth0]:502");
    EXPECT_NE(refusalOfAddress("[fe80::1%]").find("the network interface ''"), std::string::npos);
    EXPECT_NE(refusalOfAddress("[%lo]").find("is no IP address"), std::string::npos);
}

TEST(ModbusAddress, OfNonsenseIsRefusedInWords) {
    EXPECT_EQ(refusalOfAddress(""), "address '' names no device; write it as in 192.168.1.10:502");
    EXPECT_EQ(refusalOfAddress(":502"),
              "address ':502' names no device; write it as in 192.168.1.10:502");
    EXPECT_EQ(refusalOfAddress("coupler:502"),
              "address 'coupler:502' is no IP address, and a name may take long to look up; write "
              "it as in 192.168.1.10:502");
    for (const char* port : {"1.2.3.4:", "1.2.3.4:0", "1.2.3.4:65536", "1.2.3.4:502x", "1.2.3.4:-1",
                             "1.2.3.4:99999999999999", "[::1]502"}) {
        EXPECT_NE(refusalOfAddress(port).find("has no port from 1 to 65535 behind its host"),
                  std::string::npos)
            << port << ": " << refusalOfAddress(port);
    }
    EXPECT_NE(refusalOfAddress("[::1").find("has no ']'"), std::string::npos);
    EXPECT_EQ(refusalOfAddress("fe80::1%eth0"),
              "address 'fe80::1%eth0' has several colons, and an IPv6 address stands in brackets; "
              "write it as in [2001:db8::7]:502");
    for (const char* host : {"1.2.3", "1.2.3.4.5", "256.1.1.1", "[1.2.3.4]", "[]", " 1.2.3.4"})
        EXPECT_NE(refusalOfAddress(host).find("is no IP address"), std::string::npos) << host;
    EXPECT_EQ(refusalOfAddress("a\x1b[2J").find('\x1b'), std::string::npos)
        << "what a terminal obeys";
}

}  // namespace
}  // namespace cortex::modbus::test
