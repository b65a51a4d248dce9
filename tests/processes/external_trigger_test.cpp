// SPDX-License-Identifier: Apache-2.0
// An agent whose cycles come from a UDP port: a system file says so, and this test sends the ticks.
#include "core/model_folder.hpp"
#include "processes/agent_process.hpp"
#include "support/own_domain.hpp"
#include "support/waiting.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>

namespace cortex::test {
namespace {

// The last of the 250 ports of this test's domain, which nobody else uses: the agent takes the
// first.
int ownPort() { return 7400 + 250 * (ownDomain() + 1) - 1; }

void sendTick(int port) {
    const int sender = socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    place.sin_port = htons(static_cast<std::uint16_t>(port));
    sendto(sender, nullptr, 0, 0, reinterpret_cast<const sockaddr*>(&place), sizeof place);
    close(sender);
}

std::filesystem::path plant(const ModelFolder& folder, const std::string& trigger) {
    return folder.write("plant.xml",
                        "<system name='s'><ontology file='base.xml'/>\n"
                        "<cluster name='plant' frequency='50' trigger='external' " +
                            trigger + "/></system>");
}

// Once it has had so many ticks as it takes.
testing::AssertionResult isStarted(const AgentProcess& agent, const std::function<void()>& tick) {
    return comesTrue(
        "the start-up",
        [&] {
            if (contains(agent.output(), "all active simplexes are started")) return true;
            if (agent.hasEnded()) throw std::runtime_error("the agent has ended");
            tick();
            return false;
        },
        [&] { return agent.output(); });
}

TEST(ExternallyTriggeredAgent, RunsByTheDatagramsOfAPortAndEndsInOrder) {
    const ModelFolder folder;
    const int port = ownPort();
    AgentProcess agent{
        folder, plant(folder, "triggerFrom='udp:" + std::to_string(port) + "'"), {"--startup"}};

    // Without cycles nothing answers the startup; who sends ticks makes it answer.
    ASSERT_TRUE(isStarted(agent, [&] { sendTick(port); }));

    EXPECT_EQ(agent.endInOrder(), 0);
    EXPECT_TRUE(contains(agent.output(), "1 simplexes at 50 Hz as /plant")) << agent.output();
}

// Its seconds count from the end of the start-up, which is over after a minute in any case.
TEST(ExternallyTriggeredAgent, EndsWithFourWhereNoTickComesForItsStartUp) {
    const ModelFolder folder;
    AgentProcess agent{folder,
                       plant(folder, "triggerFrom='udp:" + std::to_string(ownPort()) + "'"),
                       {"--startup", "--seconds", "0.001"}};

    EXPECT_EQ(agent.waitForEnd(), 4);

    EXPECT_TRUE(contains(agent.output(), "startup: did not come to its end in 60 s"))
        << agent.output();
}

TEST(ExternallyTriggeredAgent, SaysWithFileAndLineWhatItCannotOpen) {
    const ModelFolder folder;
    AgentProcess agent{folder, plant(folder, "triggerFrom='fd:77'")};

    EXPECT_EQ(agent.waitForEnd(), 1);

    EXPECT_TRUE(contains(agent.output(),
                         "plant.xml:2: triggerFrom=\"fd:77\": descriptor 77 for ticks: Bad file "
                         "descriptor"))
        << agent.output();
}

TEST(ExternallyTriggeredAgent, RefusesToSpinWithoutAClock) {
    const ModelFolder folder;
    AgentProcess agent{folder, plant(folder, "triggerFrom='udp:5005'"), {"--spin", "10"}};

    EXPECT_EQ(agent.waitForEnd(), 1);

    EXPECT_TRUE(contains(agent.output(),
                         "plant.xml:2: ticks come from udp:5005, and only a clock "
                         "can spin: leave --spin out"))
        << agent.output();
}

TEST(ExternallyTriggeredAgent, RunsByAnInheritedPipeAndEndsWithThreeWhenItsSenderIsGone) {
    constexpr int inherited = 60;
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
    dup2(ends[0], inherited);
    const ModelFolder folder;
    AgentProcess agent{folder, plant(folder, "triggerFrom='fd:60'"), {"--startup"}};
    close(inherited);
    ASSERT_TRUE(isStarted(agent, [&] { EXPECT_EQ(write(ends[1], "x", 1), 1); }));

    close(ends[1]);

    EXPECT_EQ(agent.waitForEnd(), 3);
    EXPECT_TRUE(contains(agent.output(), "whoever sent the ticks has closed its end"))
        << agent.output();
    close(ends[0]);
}

}  // namespace
}  // namespace cortex::test
