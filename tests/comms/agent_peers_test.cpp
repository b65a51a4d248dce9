// SPDX-License-Identifier: Apache-2.0
// What an agent believes of others, without a network.
#include "agent/agent_peers.hpp"

#include "comms/told_agent.hpp"
#include "wire/ids.hpp"

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

constexpr std::int64_t millisecond = 1'000'000;  // ns

struct Listener {
    Listener() {
        rig.tree.add("/plate", "Plate");
        rig.start();
    }

    test::AgentRig rig{"near"};
};

struct AgentPeersTest : testing::Test {
    void tell(std::int64_t epoch, std::int64_t now, const char* state = "running") {
        for (Model model : told.models) {
            model.epoch = epoch;
            peers.take(model, now);
        }
        hear(epoch, now, state);
    }
    void hear(std::int64_t epoch, std::int64_t now, const char* state = "running") {
        peers.expire(now);
        Presence presence = told.presence;
        presence.epoch = epoch;
        presence.state = state;
        peers.take(presence, now);
    }
    Peer& peer() { return peers.all().at("rig"); }

    Listener listener;
    ToldAgent told;
    std::vector<std::int64_t> lost;
    AgentSelf self{listener.rig.outside.access};
    AgentPeers peers{self,
                     [this](const std::string&, std::int64_t epoch) { lost.push_back(epoch); }};
    const std::int64_t first = told.epoch();
};

TEST_F(AgentPeersTest, OfTwoStartsTheOneThatWasHeardFirstCounts) {
    tell(first, 0);
    for (int tenth = 1; tenth <= 30; ++tenth) {
        hear(first, tenth * 100 * millisecond);
        tell(first + 1, (tenth * 100 + 50) * millisecond);
        hear(first - 1, (tenth * 100 + 50) * millisecond);
    }
    EXPECT_EQ(peer().epoch(), first);
    EXPECT_TRUE(lost.empty());
}

TEST_F(AgentPeersTest, AStartThatIsSilentWhileAnotherSpeaksLeavesItsName) {
    tell(first, 0);
    tell(first + 1, 300 * millisecond);
    EXPECT_EQ(peer().epoch(), first);

    hear(first + 1, 301 * millisecond);

    EXPECT_EQ(peer().epoch(), first + 1);
    EXPECT_EQ(lost, std::vector{first});
    EXPECT_TRUE(peer().current->model.structure());
    hear(first, 302 * millisecond);
    EXPECT_EQ(peer().epoch(), first + 1);
}

TEST_F(AgentPeersTest, AStartThatSaysGoodbyeLeavesItsNameWhenItSaysNothingMore) {
    tell(first, 0);
    hear(first, millisecond, "stopping");
    hear(first - 1, 2 * millisecond);
    EXPECT_EQ(peer().epoch(), first);

    peers.expire(301 * millisecond);
    EXPECT_EQ(lost, std::vector{first});
    hear(first - 1, 302 * millisecond);
    EXPECT_EQ(peer().epoch(), first - 1);
}

TEST_F(AgentPeersTest, AGoodbyeThatSomebodyElseSaysEndsNobody) {
    tell(first, 0);
    for (int tenth = 1; tenth <= 20; ++tenth) {
        hear(first, tenth * 100 * millisecond - 50 * millisecond,
             tenth % 2 == 0 ? "stopping" : "silent");
        peers.expire(tenth * 100 * millisecond - millisecond);
        hear(first, tenth * 100 * millisecond);
    }
    EXPECT_TRUE(lost.empty());
    EXPECT_TRUE(peer().heard);
}

TEST_F(AgentPeersTest, AnAgentIsKnownOnceAllOfItsModelIsThere) {
    const auto known = [&] {
        return listener.rig.hasEvent(
            "agent rig has described itself: " + std::to_string(told.presence.simplexes) +
            " simplexes, " + std::to_string(told.presence.types) + " types");
    };
    hear(first, 0);
    for (const Model& model : told.models) {
        EXPECT_FALSE(known());
        peers.take(model, 0);
    }
    EXPECT_TRUE(known());
}

TEST_F(AgentPeersTest, WhoFallsSilentWithoutAWordIsMissedForTenMinutes) {
    tell(first, 0);
    EXPECT_FALSE(peers.missesAny(0));

    peers.expire(1'001 * millisecond);
    EXPECT_TRUE(peers.missesAny(1'001 * millisecond));
    EXPECT_FALSE(peers.missesAny(601'000 * millisecond));

    hear(first, 2'000 * millisecond);
    EXPECT_FALSE(peers.missesAny(2'000 * millisecond));
}

TEST_F(AgentPeersTest, WhoSaysThatItStopsIsNotMissed) {
    tell(first, 0);

    hear(first, millisecond, "stopping");
    peers.expire(2'000 * millisecond);

    EXPECT_FALSE(peers.missesAny(2'000 * millisecond));
}

// Its clock was set back between two starts.
TEST_F(AgentPeersTest, AnEarlierStartCountsWithAllItSaidOnceTheLaterIsNotHeard) {
    tell(first, 0);
    for (int tenth = 1; tenth <= 3; ++tenth) {
        if (tenth == 1) tell(first - 1'000'000, 100 * millisecond);
        hear(first - 1'000'000, tenth * 100 * millisecond);
        EXPECT_EQ(peer().epoch(), first);
    }

    hear(first - 1'000'000, 301 * millisecond);

    EXPECT_EQ(lost, std::vector{first});
    EXPECT_TRUE(peer().heard);
    EXPECT_EQ(peer().epoch(), first - 1'000'000);
    EXPECT_TRUE(peer().current->model.structure());
}

// Said by nobody, or by one that fell over at once.
TEST_F(AgentPeersTest, AStartThatIsNotHeardAgainGivesTheNameBack) {
    tell(first, 0);
    hear(first + 1'000'000, 310 * millisecond);
    hear(first + 2'000'000, 350 * millisecond);
    EXPECT_EQ(peer().epoch(), first + 1'000'000);
    for (int tenth = 4; tenth <= 12; ++tenth) hear(first, tenth * 100 * millisecond);

    EXPECT_EQ(peer().epoch(), first);
    EXPECT_TRUE(peer().heard);
    EXPECT_TRUE(peer().current->model.structure()) << "its models came once";
}

// Every call of a tool is somebody new; an agent that is cut off meanwhile tells nothing twice.
TEST_F(AgentPeersTest, AnAgentIsRememberedWhileToolsComeAndGo) {
    tell(first, 0);
    Presence tool = told.presence;
    tool.role = "tool";
    for (int i = 1; i <= 3'000; ++i) {
        tool.name = "tool" + std::to_string(i);
        tool.agent = agentId(tool.name);
        peers.take(tool, i * 10 * millisecond);
        peers.expire(i * 10 * millisecond);
    }
    EXPECT_EQ(peers.all().size(), 1'024U);

    hear(first, 40'000 * millisecond);

    EXPECT_TRUE(peer().heard);
    EXPECT_TRUE(peer().current->model.structure());
}

TEST_F(AgentPeersTest, AGoodbyeOfAnEarlierStartChangesNothing) {
    tell(first, 0);
    peers.expire(2'000 * millisecond);

    hear(first - 1, 2'000 * millisecond, "silent");
    hear(first - 1, 2'000 * millisecond, "stopping");

    EXPECT_EQ(peer().epoch(), first);
    EXPECT_FALSE(peer().heard);
    EXPECT_EQ(lost, std::vector{first});
}

TEST_F(AgentPeersTest, AStandstillOfThisProcessIsNobodysSilence) {
    tell(first, 100 * millisecond);
    peers.expire(200 * millisecond);
    peers.expire(5'000 * millisecond);
    EXPECT_TRUE(lost.empty());

    for (int tenth = 51; tenth < 70; ++tenth) peers.expire(tenth * 100 * millisecond);
    EXPECT_EQ(lost, std::vector{first}) << "it is silent indeed, and told once";
}

TEST(Rejections, AreCountedByReasonAndToldOnceASecond) {
    Rejections rejections;
    for (int i = 0; i < 3; ++i) rejections.add("a block with another structure");
    rejections.add("values of no simplex");
    const std::vector<std::string> told{"3 samples were refused: a block with another structure",
                                        "1 sample was refused: values of no simplex"};
    EXPECT_EQ(rejections.takeReports(1'000 * millisecond), told);
    rejections.add("values of no simplex");
    EXPECT_TRUE(rejections.takeReports(1'999 * millisecond).empty());
    EXPECT_EQ(rejections.takeReports(2'000 * millisecond), std::vector{told[1]});
    EXPECT_EQ(rejections.byReason().at("values of no simplex"), 2U);

    for (int i = 0; i < 1'000; ++i) rejections.add("of " + std::to_string(i));
    EXPECT_LE(rejections.byReason().size(), 33U) << "others cannot fill the memory";
    EXPECT_EQ(rejections.count(), 1'005U);
}

// This agent is "near".
struct FirstOfNameTest : AgentPeersTest {
    void hearOurs(std::int64_t epoch, std::int64_t uptime, std::int64_t now,
                  const char* state = "running") {
        Presence presence = told.presence;
        presence.name = self.name;
        presence.agent = self.id;
        presence.host = "elsewhere";
        presence.epoch = epoch;
        presence.state = state;
        if (uptime > 0) presence.extras = {{"uptime", std::to_string(uptime)}};
        passTo(now);
        peers.take(presence, now);
    }
    void passTo(std::int64_t now) {
        if (passed == 0) passed = now;
        while (passed + 100 * millisecond < now) peers.expire(passed += 100 * millisecond);
        standStillTo(now);
    }
    void standStillTo(std::int64_t now) {
        peers.expire(now);
        passed = now;
    }
    bool says(const std::string& text) { return listener.rig.hasEvent(text); }

    std::int64_t passed = 0;
    const std::string rival = "another start of near is heard, on host elsewhere; ";
    static constexpr std::int64_t second = 1000 * millisecond;
};

TEST_F(FirstOfNameTest, AStartThatWasThereFirstIsNotSilenced) {
    passTo(second);
    hearOurs(self.epoch + 5, 60 * second, 4 * second);
    hearOurs(self.epoch - 5, 60 * second, 5 * second);
    EXPECT_FALSE(peers.isSecond());
    EXPECT_TRUE(says(rival + "this one was there first, and nobody listens to that one"));
}

TEST_F(FirstOfNameTest, AStartThatMeetsALongerOneIsSilentUntilThatEnds) {
    passTo(second);
    hearOurs(self.epoch + 3'600'000'000, 60 * second, 2 * second);  // its clock is ahead
    EXPECT_TRUE(peers.isSecond());
    EXPECT_TRUE(says(rival + "it was there first, so this one is silent while it runs"));
    for (int i = 3; i < 9; ++i) hearOurs(self.epoch + 3'600'000'000, 60 * second, i * second);
    EXPECT_TRUE(peers.isSecond());

    passTo(9 * second + millisecond);

    EXPECT_FALSE(peers.isSecond());
    EXPECT_TRUE(says("the other start of near has ended; this one speaks again"));
}

TEST_F(FirstOfNameTest, AGoodbyeOfTheFirstEndsTheSilenceOfTheSecond) {
    hearOurs(self.epoch - 1, 60 * second, second);
    EXPECT_TRUE(peers.isSecond());
    hearOurs(self.epoch - 1, 60 * second, 2 * second, "stopping");
    passTo(2 * second + millisecond);
    EXPECT_FALSE(peers.isSecond());
}

TEST_F(FirstOfNameTest, ASilentStartIsToldAndEndsNobodysSilence) {
    passTo(second);
    hearOurs(self.epoch + 5, millisecond, 4 * second, "silent");
    EXPECT_FALSE(peers.isSecond());
    EXPECT_TRUE(says(rival + "it is silent while this one runs"));
}

TEST_F(FirstOfNameTest, WhoElseSpeaksIsToldWithWhatItRunsAndSinceWhen) {
    const std::int64_t start = 1'795'168'800'000'000;  // 2026-11-20T10:00:00Z
    const std::string other = "another start of near is heard, on host elsewhere";
    hearOurs(start, 0, second, "silent");
    EXPECT_EQ(peers.otherSelf(second), other) << "it has not heard itself";
    hearOurs(self.epoch, second, 2 * second);
    hearOurs(start, 0, 3 * second, "silent");
    EXPECT_EQ(peers.otherSelf(3 * second),
              other + ": the same system, started at 2026-11-20T10:00:00Z");
    told.presence.structureHash[0] ^= 1U;
    hearOurs(start, 0, 4 * second, "silent");
    EXPECT_EQ(peers.otherSelf(4 * second),
              other + ": another system, started at 2026-11-20T10:00:00Z");
}

TEST_F(FirstOfNameTest, ASecondStartStaysSilentThoughAThirdSaysThatItIsSilent) {
    hearOurs(self.epoch - 1, 60 * second, second);
    hearOurs(self.epoch + 5, millisecond, second + millisecond, "silent");
    passTo(second + 2 * millisecond);
    EXPECT_TRUE(peers.isSecond());
}

TEST_F(FirstOfNameTest, OfTwoThatBeganAtOnceTheEpochsDecide) {
    passTo(second);
    hearOurs(self.epoch + 1, 400 * millisecond, second + 100 * millisecond);
    EXPECT_FALSE(peers.isSecond());
    hearOurs(self.epoch - 1, 1, second + 100 * millisecond);
    EXPECT_TRUE(peers.isSecond());
}

TEST_F(FirstOfNameTest, AStartThatDoesNotSayHowLongItRunsWasThereFirst) {
    hearOurs(self.epoch + 1, 0, second);
    EXPECT_TRUE(peers.isSecond());
}

TEST_F(FirstOfNameTest, AStartThatStoodStillYieldsToOneThatBeganMeanwhile) {
    passTo(second);
    passTo(10 * second);
    standStillTo(14 * second);
    hearOurs(self.epoch + 5, 3'400 * millisecond, 14 * second);
    EXPECT_TRUE(peers.isSecond());
    EXPECT_TRUE(
        says("another start of near on host elsewhere took over while this one stood still, so "
             "this one is silent"));
    EXPECT_FALSE(says("nobody listens to that one"));
}

TEST_F(FirstOfNameTest, AStartThatStoodStillYieldsToASpareThatTookOver) {
    passTo(second);
    hearOurs(self.epoch + 5, second, 4 * second, "silent");
    standStillTo(7 * second);
    hearOurs(self.epoch + 5, 4 * second, 7 * second);
    EXPECT_FALSE(peers.isSecond()) << "it may have spoken for less than 2 s, and yields itself";
    hearOurs(self.epoch + 5, 5'200 * millisecond, 8'200 * millisecond);
    EXPECT_TRUE(peers.isSecond());
}

TEST_F(FirstOfNameTest, AStartThatStoodStillDoesNotYieldToANewOneWhichYieldsItself) {
    passTo(second);
    passTo(10 * second);
    standStillTo(12 * second);
    for (int tenth = 0; tenth < 15; ++tenth) {
        hearOurs(self.epoch + 5, (5 + tenth) * 100 * millisecond,
                 12 * second + tenth * 100 * millisecond);
    }
    EXPECT_FALSE(peers.isSecond());
}

TEST_F(FirstOfNameTest, WhenAllStoodStillTheSecondStaysSilentAndNobodyYields) {
    hearOurs(self.epoch - 1, 60 * second, second);
    standStillTo(100 * second);
    EXPECT_TRUE(peers.isSecond());
    passTo(102 * second);
    EXPECT_FALSE(peers.isSecond());
    passTo(105 * second);
    hearOurs(self.epoch - 1, 164 * second, 105 * second);
    standStillTo(200 * second);
    hearOurs(self.epoch - 1, 260 * second, 200 * second);
    EXPECT_FALSE(peers.isSecond()) << "the other one spoke before";
}

TEST_F(FirstOfNameTest, AGoodbyeThatWeDidNotSayIsReported) {
    passTo(second);
    hearOurs(self.epoch, second, 2 * second, "stopping");
    EXPECT_FALSE(peers.isSecond());
    EXPECT_TRUE(says("somebody else says that near is stopping"));
}

}  // namespace
}  // namespace cortex::comms
