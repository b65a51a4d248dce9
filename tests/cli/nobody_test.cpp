// SPDX-License-Identifier: Apache-2.0
// What a tool says where it hears no agent, by what it knows.
#include "live/nobody.hpp"

#include <gtest/gtest.h>

namespace cortex::cli {
namespace {

using namespace std::chrono_literals;

std::string said(const Nobody& nobody) {
    const Trouble trouble = troubleOf(nobody);
    return trouble.what + "; " + trouble.remedy;
}

Nobody alone() {
    Nobody nobody;
    nobody.domain = 7;
    nobody.waited = 3s;
    return nobody;
}

const Nobody plain = alone();

TEST(Nobody, NamesTheOtherDomainsOfThisMachine) {
    Nobody nobody = plain;
    nobody.otherDomains = {3, 4};
    EXPECT_EQ(
        said(nobody),
        "no agent on domain 7, while this machine has participants of domains 3, 4; name "
        "their domain (--domain N or CORTEX_DOMAIN), or start one (cortex-agent FILE --domain "
        "7)");
}

TEST(Nobody, LeavesANamedInterfaceOut) {
    Nobody nobody = plain;
    nobody.interfaces = {"eth0"};
    EXPECT_EQ(said(nobody),
              "no agent on domain 7 is heard on interface eth0; leave --interface "
              "(CORTEX_INTERFACE) out, or start one (cortex-agent FILE --domain 7)");
    nobody.otherDomains = {3};
    EXPECT_EQ(
        said(nobody),
        "no agent on domain 7 is heard on interface eth0, while this machine has participants "
        "of domain 3; leave --interface (CORTEX_INTERFACE) out, or name their domain "
        "(--domain N or CORTEX_DOMAIN)");
    EXPECT_EQ(said(plain).find("--interface"), std::string::npos);
    EXPECT_NE(said(plain).find("--peer HOST"), std::string::npos);
}

TEST(Nobody, NamesTheDiscoveryServerThatWasAsked) {
    Nobody nobody = plain;
    nobody.server = "10.0.0.2:11811";
    nobody.otherDomains = {3};
    nobody.interfaces = {"eth0"};
    const std::string none =
        "no agent on domain 7 by way of the Discovery Server 10.0.0.2:11811 is ";
    EXPECT_EQ(said(nobody),
              none +
                  "heard; see that the server runs at 10.0.0.2:11811 (fast-discovery-server -i 0) "
                  "and that the agents name it too, or leave --discovery-server "
                  "(CORTEX_DISCOVERY_SERVER) out: the agents may be found without it");
    nobody.nameless = 2;
    EXPECT_TRUE(said(nobody).starts_with(none + "known yet: 2 participants")) << said(nobody);
}

TEST(Nobody, AShortWaitIsNoReasonToStartAnAgent) {
    Nobody nobody = plain;
    nobody.waited = 1ms;
    EXPECT_EQ(said(nobody),
              "no agent on domain 7 was heard within 0.001 s; wait longer (--timeout)");
}

TEST(Nobody, WhoCannotBeSeenIsAnError) {
    EXPECT_FALSE(troubleOf(plain).isError);
    Nobody open = plain, stranger = plain;
    open.closed = 1;
    open.otherDomains = {3};
    EXPECT_TRUE(troubleOf(open).isError);
    EXPECT_NE(said(open).find("1 participant with security was heard; name a folder"),
              std::string::npos);
    stranger.strangers = 4;
    EXPECT_TRUE(troubleOf(stranger).isError);
    EXPECT_EQ(said(stranger),
              "no agent on domain 7 can be seen: participants without security, or of another "
              "authority than that of this tool's folder, were refused; leave --security "
              "(CORTEX_SECURITY) out if those agents have none, or name a folder of their "
              "authority");
}

}  // namespace
}  // namespace cortex::cli
