// SPDX-License-Identifier: Apache-2.0
// What is counted as abnormal, and what is kept of lost agents, of agents made by hand.
#include "gui/made_agent.hpp"
#include "model/abnormal.hpp"
#include "session/lost_agents.hpp"

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;
using namespace std::chrono_literals;

const LostAgents::Moment begin{1h};

class Troubles : public testing::Test {
protected:
    Troubles() {
        robot.put("/b", "state", std::int64_t{4});
        robot.put("/seen", "level", 3.0);
        robot.put("/old", "level", 3.0);
        robot.degrade("/old", Quality::Stale);
    }
    std::vector<std::string> textsOf(std::vector<AgentFrame> agents, LostAgents::Moment now) {
        std::vector<std::string> texts;
        for (const auto& event : lost.update(agents, now)) texts.push_back(event.text);
        names.clear();
        for (const auto& agent : agents) names.push_back(agent.status.name);
        last = agents;
        return texts;
    }

    MadeAgent robot{"robot", [](SimplexTree& tree) {
                        tree.add("/a", "Probe");
                        tree.add("/b", "Probe");
                        tree.add("/old", "Seen");
                        tree.add("/seen", "Seen");
                    }};
    MadeAgent other{"other", [](SimplexTree& tree) {
                        tree.add("/x", "Probe");
                        tree.add("/y", "Probe");
                    }};
    LostAgents lost;
    std::vector<std::string> names;
    std::vector<AgentFrame> last;
};

TEST_F(Troubles, AreFaultsWhatIsOutsideOfItsLimitsNowAndWhatIsLost) {
    Abnormal abnormal;
    abnormal.update(*frameOf({robot.now(), other.now("lost")}));
    EXPECT_EQ(abnormal.count(Abnormal::Fault), 1);
    EXPECT_EQ(abnormal.count(Abnormal::Outside), 1) << "a stale value may be within by now";
    EXPECT_EQ(abnormal.count(Abnormal::Lost), 2);
}

TEST_F(Troubles, AreCountedInTheFrameInWhichTheirValuesCome) {
    AgentFrame early = robot.now();
    early.image = {};
    Abnormal abnormal;
    abnormal.update(*frameOf({early}));
    EXPECT_EQ(abnormal.count(Abnormal::Fault), 0);
    abnormal.update(*frameOf({robot.now()}));
    EXPECT_EQ(abnormal.count(Abnormal::Fault), 1);
    EXPECT_EQ(abnormal.count(Abnormal::Outside), 1);
}

TEST_F(Troubles, AreGoneThroughInTurnForwardAndBack) {
    Abnormal abnormal;
    abnormal.update(*frameOf({robot.now(), other.now("lost")}));
    EXPECT_EQ(abnormal.next(""), "/b");
    EXPECT_EQ(abnormal.next("/b"), "/seen");
    EXPECT_EQ(abnormal.next("/seen"), "/x") << "one of a lost agent stands for all";
    EXPECT_EQ(abnormal.next("/x"), "/b");
    EXPECT_EQ(abnormal.next("/b", true), "/x");
    EXPECT_EQ(abnormal.next("/b", false, Abnormal::Lost), "/x");
    EXPECT_EQ(Abnormal{}.next("/b"), "");
}

TEST_F(Troubles, AreNotWhatEndedInAnOrderlyWay) {
    AgentFrame ended = robot.now("lost");
    ended.status.ended = true;
    Abnormal abnormal;
    abnormal.update(*frameOf({ended}));
    EXPECT_EQ(abnormal.count(Abnormal::Lost), 0);
    EXPECT_EQ(abnormal.next(""), "");
}

TEST_F(Troubles, AreNotWhatReadAnAgentThatEndedInAnOrderlyWay) {
    MadeAgent desk{"desk", [](SimplexTree& tree) {
                       Simplex& reader = tree.add("/reader", "Probe");
                       tree.relateRemote(reader, "in", "/order", "Order", false);
                   }};
    MadeAgent source{"source", [](SimplexTree& tree) { tree.add("/order", "Order"); }};
    desk.put("/reader", "state", std::int64_t{4});
    desk.degrade("/reader", Quality::Lost, "/order");
    const auto lostOf = [&](std::vector<AgentFrame> agents, std::vector<GoneAgent> gone) {
        auto frame = frameOf(std::move(agents));
        frame->gone = std::move(gone);
        Abnormal abnormal;
        abnormal.update(*frame);
        return abnormal.count(Abnormal::Lost);
    };
    AgentFrame ended = source.now("lost");
    ended.status.ended = true;
    const GoneAgent gone{"source", true, 1, source.structure};
    EXPECT_EQ(lostOf({desk.now(), ended}, {gone}), 0);
    EXPECT_EQ(lostOf({desk.now()}, {gone}), 0) << "the mirror has forgotten it";
    EXPECT_EQ(lostOf({desk.now(), source.now("lost")}, {}), 2);
    EXPECT_EQ(lostOf({desk.now()}, {{"source", false, 1, source.structure}}), 1)
        << "a loss that was dismissed";
    desk.put("/reader", "state", std::int64_t{2});
    EXPECT_EQ(lostOf({desk.now(), ended}, {gone}), 1) << "what is Active needs its input";
    desk.put("/reader", "state", std::int64_t{0});
    EXPECT_EQ(lostOf({desk.now(), ended}, {gone}), 0);
    EXPECT_EQ(lostOf({desk.now(), source.now("lost")}, {}), 1)
        << "what is in Standby reads nothing";
    desk.degrade("/reader", Quality::Lost, "/reader");
    EXPECT_EQ(lostOf({desk.now(), ended}, {gone}), 1) << "its own loss";
}

TEST_F(Troubles, OfGoneAgentsAreRememberedUntilTheyAreHeardAgain) {
    AgentFrame ended = other.now("lost");
    ended.status.ended = true;
    (void)textsOf({robot.now(), other.now()}, begin);
    EXPECT_TRUE(lost.gone().empty());
    (void)textsOf({robot.now("lost"), ended}, begin + 1s);
    lost.dismiss("robot");
    (void)textsOf({robot.now("lost")}, begin + 100s);
    EXPECT_TRUE(names.empty());
    ASSERT_EQ(lost.gone().size(), 2U);
    EXPECT_EQ(lost.gone()[0].name, "other");
    EXPECT_TRUE(lost.gone()[0].ended);
    EXPECT_EQ(lost.gone()[1].name, "robot");
    EXPECT_FALSE(lost.gone()[1].ended);
    (void)textsOf({robot.now(), other.now()}, begin + 101s);
    EXPECT_TRUE(lost.gone().empty());
}

TEST_F(Troubles, OfAnAgentThatIsDismissedAfterTheMirrorForgotItAreRememberedToo) {
    (void)textsOf({other.now("lost")}, begin);
    (void)textsOf({}, begin + 100s);
    lost.dismiss("other");
    (void)textsOf({}, begin + 101s);
    EXPECT_TRUE(names.empty());
    ASSERT_EQ(lost.gone().size(), 1U);
    EXPECT_EQ(lost.gone()[0].name, "other");
}

TEST_F(Troubles, OfALostAgentStayWhenTheMirrorHasForgottenIt) {
    EXPECT_TRUE(textsOf({robot.now(), other.now()}, begin).empty());
    const auto told = textsOf({robot.now(), other.now("lost")}, begin + 1s);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_TRUE(told.front().starts_with("agent lost"));
    EXPECT_TRUE(textsOf({robot.now()}, begin + 100s).empty()) << "it was told";
    ASSERT_EQ(names, (std::vector<std::string>{"other", "robot"}));
    EXPECT_GE(last.front().status.age, 99);
    EXPECT_GE(last.front().age(0), 99);
    lost.dismiss("other");
    (void)textsOf({robot.now()}, begin + 101s);
    EXPECT_EQ(names, std::vector<std::string>{"robot"});
}

TEST_F(Troubles, OfADismissedAgentStayAwayUntilItIsHeardAgain) {
    (void)textsOf({other.now()}, begin);
    (void)textsOf({other.now("lost")}, begin + 1s);
    lost.dismiss("other");
    (void)textsOf({other.now("lost")}, begin + 2s);
    EXPECT_TRUE(names.empty());
    const auto told = textsOf({other.now()}, begin + 3s);
    EXPECT_EQ(names, std::vector<std::string>{"other"});
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told.front(), "agent heard again");
    (void)textsOf({other.now("lost")}, begin + 4s);
    EXPECT_EQ(names, std::vector<std::string>{"other"}) << "that is another loss";
}

TEST_F(Troubles, AreToldOfAnEndAndOfANewStart) {
    (void)textsOf({other.now()}, begin);
    AgentFrame ended = other.now("lost");
    ended.status.ended = true;
    EXPECT_TRUE(textsOf({ended}, begin + 1s).front().starts_with("agent ended"));
    AgentFrame again = other.now();
    ++again.status.epoch;
    EXPECT_TRUE(textsOf({again}, begin + 2s).front().starts_with("agent restarted"));
    (void)textsOf({}, begin + 3s);
    EXPECT_TRUE(names.empty()) << "only what was lost stays";
}

}  // namespace
}  // namespace cortex::test
