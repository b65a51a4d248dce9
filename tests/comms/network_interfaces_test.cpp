// SPDX-License-Identifier: Apache-2.0
#include "dds/network_interfaces.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using Interfaces = std::vector<NetworkInterface>;

const NetworkInterface lo{"lo", {"127.0.0.1"}, false, true, true, true, false};
const NetworkInterface eth0{"eth0", {"10.0.0.1"}, true, true, true, false, true};

TEST(NetworkInterfaces, HaveNoTroubleWhereOneCanBeUsed) {
    EXPECT_TRUE(troublesOf({lo, eth0}).empty());
    EXPECT_TRUE(troublesOf({lo}).empty()) << "it was asked for";
    NetworkInterface down = eth0;
    down.up = false;
    EXPECT_TRUE(troublesOf({eth0, down}).empty()) << "another one works";
    EXPECT_EQ(troublesOf({lo, down}),
              std::vector<std::string>{"interface eth0 is down: ip link set eth0 up"});
    NetworkInterface dead = lo;
    dead.up = false;
    EXPECT_EQ(troublesOf({dead}),
              std::vector<std::string>{
                  "no network interface is up, so nobody is heard: ip link set lo up"});
}

TEST(NetworkInterfaces, SayWhyNobodyCanBeHeard) {
    NetworkInterface late = eth0, ipv6 = eth0, loose = eth0;
    late.ips.clear();
    late.hasIpv6 = false;
    ipv6.ips.clear();
    loose.running = false;
    EXPECT_EQ(troublesOf({lo, late}),
              std::vector<std::string>{
                  "interface eth0 has no address yet; it is used as soon as it has one"});
    EXPECT_EQ(troublesOf({lo, ipv6}).front(),
              "interface eth0 has IPv6 addresses only; agents meet over IPv4: give it an IPv4 "
              "address, which is then used at once");
    EXPECT_EQ(
        troublesOf({lo, loose}),
        std::vector<std::string>{"interface eth0 has no carrier: look at its cable or its link"});
}

TEST(NetworkInterfaces, SayNothingOfABridgeWithoutCarrierBesideACardThatWorks) {
    NetworkInterface bridge = eth0, loose = eth0;
    bridge.card = bridge.running = loose.running = false;
    EXPECT_TRUE(troublesOf({lo, eth0, bridge}).empty());
    EXPECT_EQ(troublesOf({lo, eth0, loose}).size(), 1U) << "a cable that is loose is told";
}

TEST(NetworkInterfaces, AreChosenByNameOrAddress) {
    EXPECT_EQ(chosen({lo, eth0}, {}), (Interfaces{lo, eth0}));
    EXPECT_EQ(chosen({lo, eth0}, {"eth0"}), (Interfaces{eth0}));
    EXPECT_EQ(chosen({lo, eth0}, {"127.0.0.1", "wlan0"}), (Interfaces{lo}));
    EXPECT_EQ(namesOfUsed({lo, eth0}), "lo, eth0");
    EXPECT_EQ(namesOfUsed({}), "none");
    NetworkInterface loose = eth0;
    loose.running = false;
    EXPECT_EQ(namesOfUsed({lo, loose}), "lo") << "Fast DDS takes none without a carrier";
}

TEST(NetworkInterfaces, OfThisMachineAreListed) {
    EXPECT_TRUE(std::ranges::any_of(networkInterfaces(), &NetworkInterface::loopback));
}

}  // namespace
}  // namespace cortex::comms
