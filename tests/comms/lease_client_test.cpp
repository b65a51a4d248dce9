// SPDX-License-Identifier: Apache-2.0
#include "cortex/comms/lease_client.hpp"

#include "comms/stepped_agent.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using namespace std::chrono_literals;

// Two agents, and two tools that want control of them.
struct Leases : testing::Test {
    struct Tool {
        explicit Tool(const std::string& name) : mirror{name, loopback()}, leases{mirror} {
            EXPECT_TRUE(comesTrue([this] {
                return mirror.structure("robot") != nullptr &&
                       mirror.structure("station") != nullptr;
            }));
            mirror.view({"/robot", "/station"}, 100);
        }
        bool takes(const std::string& prefix, const std::vector<std::string>& agents) {
            const auto answers = leases.wait(leases.take(prefix, agents));
            return std::ranges::all_of(answers,
                                       [](const auto& each) { return each.answer.done(); });
        }
        Mirror mirror;
        LeaseClient leases;
    };

    Leases() {
        robot->rig.hand("/arm");
        station->rig.hand("/stick");
        robot->run();
        station->run();
    }
    // What an agent says of itself.
    static std::vector<ShownLease> shown(const Tool& tool, const std::string& agent) {
        for (const AgentStatus& each : tool.mirror.agents()) {
            if (each.name == agent) return leasesOf(each, tool.mirror.image(agent));
        }
        return {};
    }
    std::int64_t cycleOf(const Tool& tool) const { return tool.mirror.agents().front().cycle; }

    std::unique_ptr<SteppedAgent> robot = std::make_unique<SteppedAgent>("robot");
    std::unique_ptr<SteppedAgent> station = std::make_unique<SteppedAgent>("station");
};

TEST_F(Leases, AreTakenFromAllAgentsOrFromNone) {
    Tool first{"first"}, second{"second"};
    ASSERT_TRUE(first.takes("/stick", {"station"}));
    EXPECT_TRUE(first.leases.covers("station", "/stick"));

    const auto answers = second.leases.wait(second.leases.take("/", {"robot", "station"}));

    ASSERT_EQ(answers.size(), 2U);
    EXPECT_TRUE(answers[0].answer.done());
    EXPECT_EQ(answers[1].answer.outcome, Outcome::Rejected);
    EXPECT_TRUE(second.leases.held().empty());
    EXPECT_TRUE(comesTrue([&] { return shown(first, "robot").empty(); })) << "it is given back";
    EXPECT_TRUE(comesTrue([&] { return shown(first, "station").size() == 1; }));
}

TEST_F(Leases, AreRenewedUntilTheProgramSaysThatItDoesNotAnswer) {
    Tool tool{"tool"};
    ASSERT_TRUE(tool.takes("/arm", {"robot"}));
    const std::int64_t then = cycleOf(tool);
    ASSERT_TRUE(comesTrue([&] { return cycleOf(tool) > then + 3000; })) << "longer than 2 s";
    EXPECT_EQ(tool.leases.held().size(), 1U);

    tool.leases.renew(false);

    EXPECT_TRUE(comesTrue([&] { return tool.leases.held().empty(); }));
    EXPECT_EQ(tool.leases.news(),
              std::vector<std::string>{"control of /arm of agent robot was lost: the agent has "
                                       "confirmed no renewal for 2 s"});
}

TEST_F(Leases, AreKeptByWhoeverTheyAreHandedOverTo) {
    Tool first{"first"}, second{"second"};
    second.leases.acceptOffers([] {});
    ASSERT_TRUE(first.takes("/arm", {"robot"}));

    const auto answers = first.leases.wait(first.leases.handOver("/arm", second.mirror.name()));

    ASSERT_EQ(answers.size(), 1U);
    EXPECT_TRUE(answers[0].answer.done()) << answers[0].answer.text();
    EXPECT_TRUE(first.leases.held().empty());
    EXPECT_TRUE(comesTrue([&] { return second.leases.covers("robot", "/arm"); }));
    EXPECT_EQ(second.leases.news(),
              std::vector<std::string>{"control of /arm of agent robot is yours now"});
}

TEST_F(Leases, OfAnAgentThatEndedAreLostInWords) {
    Tool tool{"tool"};
    ASSERT_TRUE(tool.takes("/", {"robot", "station"}));
    EXPECT_EQ(tool.leases.held().size(), 2U);

    station.reset();

    EXPECT_TRUE(comesTrue([&] { return tool.leases.held().size() == 1; }));
    EXPECT_EQ(tool.leases.held().front().agent, "robot");
    const auto news = tool.leases.news();
    ASSERT_EQ(news.size(), 1U);
    EXPECT_EQ(news.front(), "control of / of agent station was lost: the agent has ended");
}

TEST_F(Leases, AreReleasedAtTheEndOfTheirClient) {
    Tool other{"other"};
    {
        Tool tool{"tool"};
        ASSERT_TRUE(tool.takes("/", {"robot", "station"}));
        ASSERT_TRUE(comesTrue([&] { return shown(other, "robot").size() == 1; }));
    }
    EXPECT_TRUE(other.takes("/", {"robot", "station"})) << "at once";
}

}  // namespace
}  // namespace cortex::comms
