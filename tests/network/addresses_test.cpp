// SPDX-License-Identifier: Apache-2.0
// Agents whose network cards have no address yet, or get another one, and agents that keep to the
// loopback interface.
#include "network/hand_and_robot.hpp"
#include "network/host.hpp"
#include "support/waiting.hpp"

#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

struct LateAddress : testing::Test {
    void SetUp() override {
        if (const std::string why = whyNoHosts(); !why.empty()) GTEST_SKIP() << why;
        hosts.emplace();
    }
    void begin() {
        hosts->first.within([&] { hand.emplace(network("")); });
        hosts->second.within([&] { robot.emplace(""); });
        hosts->first.within([&] { station.emplace(network("")); });
    }
    testing::AssertionResult becomesWhole() {
        const std::int64_t cycle = station->cycleOfRobot(), written = robot->newest();
        return comesTrue("newer data of the other on both sides",
                         [&] { return robot->newest() > written && station->sees(cycle); });
    }

    std::optional<TwoHosts> hosts;
    std::optional<HandAgent> hand;
    std::optional<RobotProcess> robot;
    std::optional<Station> station;
};

TEST_F(LateAddress, IsUsedWhenItComesAndFollowedWhenItChanges) {
    hosts->second.command("ip address flush dev eth0");
    begin();
    EXPECT_FALSE(station->sees(0));

    hosts->second.command("ip address add 10.77.0.2/24 dev eth0");
    ASSERT_TRUE(becomesWhole());

    hosts->second.command("ip address flush dev eth0 && ip address add 10.77.0.9/24 dev eth0");
    EXPECT_TRUE(becomesWhole());
}

TEST(LoopbackOnly, AnAgentThatKeepsToTheLoopbackInterfaceIsSeenByAToolThatLooksOnAll) {
    if (const std::string why = whyNoHosts(); !why.empty()) GTEST_SKIP() << why;
    TwoHosts hosts;
    std::optional<HandAgent> hand;
    std::optional<RobotProcess> robot;
    std::optional<Station> station;
    hosts.first.within([&] {
        comms::NetworkOptions loopback = network("");
        loopback.interfaces = {"lo"};
        hand.emplace(loopback);
    });
    hosts.second.within([&] { robot.emplace(""); });
    std::vector<comms::AgentStatus> agents;
    hosts.first.within([&] {
        comms::NetworkOptions all = network("");
        comms::alsoOnLoopback(all);
        comms::Mirror mirror{"tool", all};
        EXPECT_TRUE(comesTrue("both agents", [&] {
            agents = mirror.agents();
            return agents.size() == 2 && mirror.structure("hand") && mirror.structure("robot");
        }));
    });
    EXPECT_EQ(agents.size(), 2U);
}

TEST(NamedInterface, AnAgentThatKeepsToItIsSeenByAToolOfItsMachineThatNamesNone) {
    if (const std::string why = whyNoHosts(); !why.empty()) GTEST_SKIP() << why;
    TwoHosts hosts;
    hosts.first.within([&] {
        comms::NetworkOptions named = network("");
        named.interfaces = {"eth0"};
        const HandAgent hand{named};
        comms::NetworkOptions none = network("");
        comms::onNamedInterfaces(none);
        const comms::Mirror mirror{"tool", none};
        EXPECT_TRUE(comesTrue("the hand", [&] { return mirror.structure("hand") != nullptr; }));
    });
}

TEST(LoopbackOnly, AnAgentThatIsToldNoInterfaceMeetsThoseThatKeepToItAndOtherHosts) {
    if (const std::string why = whyNoHosts(); !why.empty()) GTEST_SKIP() << why;
    TwoHosts hosts;
    std::optional<HandAgent> hand;
    std::optional<RobotProcess> robot;
    hosts.first.within([&] {
        comms::NetworkOptions loopback = network("");
        loopback.interfaces = {"lo"};
        hand.emplace(loopback);
    });
    hosts.first.within([&] { robot.emplace(""); });
    const std::int64_t written = robot->newest();
    EXPECT_TRUE(comesTrue("data of the hand", [&] { return robot->newest() > written; }));
    hosts.second.within([&] {
        const comms::Mirror mirror{"tool", network("")};
        EXPECT_TRUE(comesTrue("the robot", [&] { return mirror.structure("robot") != nullptr; }));
    });
}

}  // namespace
}  // namespace cortex::test
