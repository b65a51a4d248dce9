// SPDX-License-Identifier: Apache-2.0
#include "cortex/comms/network_options.hpp"

#include "cortex/core/error.hpp"

#include "comms/inbox.hpp"
#include "comms/raw_dds.hpp"
#include "comms/secured_plant.hpp"
#include "dds/participant.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

std::string refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "not refused";
}

std::string joinRefusal(const NetworkOptions& options) {
    return refusal([&] { Participant{options, "arm"}; });
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// As /proc/net/udp of a machine with one participant of domain 0 on each of these addresses.
OnLoopback loopbackAmong(int domain, const std::string& addresses) {
    const std::string file = testing::TempDir() + "cortex-udp-" + std::to_string(::getpid());
    {
        std::ofstream out{file};
        out << "   sl  local_address rem_address   st tx_queue rx_queue\n";
        std::istringstream words{addresses};
        for (std::string each; words >> each;) out << "  26: " << each << " 00000000:0000 07 0:0\n";
    }
    const OnLoopback found = onLoopback(domain, file);
    std::remove(file.c_str());
    return found;
}

TEST(NetworkOptions, KnowHowManyParticipantsOfADomainKeepToTheLoopbackInterface) {
    const std::string agent = "0100007F:1CF2 0100007F:1CF3 ";  // 127.0.0.1:7410, 7411
    const std::string all = "00000000:1CF4 00000000:1CF5 ";
    EXPECT_EQ(loopbackAmong(0, agent), OnLoopback::All);
    EXPECT_EQ(loopbackAmong(0, ""), OnLoopback::None) << "nobody is there";
    EXPECT_EQ(loopbackAmong(0, agent + all), OnLoopback::Some) << "one uses all";
    EXPECT_EQ(loopbackAmong(0, all), OnLoopback::None);
    EXPECT_EQ(loopbackAmong(0, "0100007F:1CF4 0100007F:1CF9"), OnLoopback::None)
        << "single ports are of who sends";
    EXPECT_EQ(loopbackAmong(0, agent + "00000000:0035 0200000A:BEEF"), OnLoopback::All)
        << "no participants";
    EXPECT_EQ(loopbackAmong(1, agent), OnLoopback::None) << "those of domain 0 do not count";
}

TEST(NetworkOptions, RefusesUnknownInterfacesAndListsThoseThatThereAre) {
    NetworkOptions options = loopback();
    options.interfaces = {"192.0.2.77", "127.0.0.1", "ethernet9"};

    const std::string text = joinRefusal(options);

    EXPECT_TRUE(contains(text, "'192.0.2.77', 'ethernet9'")) << text;
    EXPECT_TRUE(contains(text, "lo (127.0.0.1)")) << text;
}

TEST(NetworkOptions, RefusesPeersAndServersThatAreNoAddress) {
    for (const char* wrong :
         {"", "127.0.0.1:", "127.0.0.1:0", "127.0.0.1:70000", "no host", ":5"}) {
        NetworkOptions options = loopback();
        options.peers = {wrong};
        EXPECT_TRUE(contains(joinRefusal(options), "peer '" + std::string{wrong} + "'")) << wrong;
    }
    NetworkOptions options = loopback();
    options.discoveryServer = "127.0.0.1:11811;127.0.0.1:x";
    EXPECT_TRUE(contains(joinRefusal(options), "discovery server '127.0.0.1:x'"));
}

// The server has no certificate: it would be joined, and nobody found.
TEST(NetworkOptions, RefusesADiscoveryServerWithSecurity) {
    const SecuredPlant plant;
    NetworkOptions options = loopback();
    options.security = plant.make("arm");
    EXPECT_EQ(joinRefusal(options), "not refused");
    options.discoveryServer = "127.0.0.1:11811";
    const std::string text = joinRefusal(options);
    EXPECT_TRUE(contains(text, "'127.0.0.1:11811') and security exclude each other")) << text;
    EXPECT_TRUE(contains(text, "--peer")) << text;
}

TEST(NetworkOptions, RefusesADomainThatDoesNotExist) {
    for (int domain : {-1, 231}) {
        NetworkOptions options = loopback();
        options.domain = domain;
        EXPECT_TRUE(contains(joinRefusal(options), "from 0 to 230")) << domain;
    }
}

TEST(NetworkOptions, RefusesADomainWhosePortsAreTaken) {
    const TakenPorts ports{7410 + 250 * loopback().domain, 120};

    const std::string text = joinRefusal(loopback());

    EXPECT_TRUE(contains(text, "no UDP port is free")) << text;
    EXPECT_TRUE(contains(text, "120 participants of a domain at most")) << text;
}

TEST(NetworkOptions, TakesItsDomainFromTheEnvironment) {
    unsetenv("CORTEX_DOMAIN");
    EXPECT_EQ(NetworkOptions{}.domain, 0);
    setenv("CORTEX_DOMAIN", "230", 1);
    EXPECT_EQ(NetworkOptions{}.domain, 230);
    for (const char* wrong : {"", "231", "-1", "7 ", "seven", "99999999999"}) {
        setenv("CORTEX_DOMAIN", wrong, 1);
        const std::string text = refusal([] { const NetworkOptions options; });
        EXPECT_TRUE(contains(text, "CORTEX_DOMAIN is '" + std::string{wrong} + "'")) << text;
        EXPECT_TRUE(contains(text, "from 0 to 230")) << text;
    }
    unsetenv("CORTEX_DOMAIN");
}

}  // namespace
}  // namespace cortex::comms
