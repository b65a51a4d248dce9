// SPDX-License-Identifier: Apache-2.0
// For how long a mirror takes what has come for the present, and whom it awaits.
#include "comms/told_agent.hpp"
#include "mirror/mirror_agents.hpp"
#include "wire/ids.hpp"
#include "wire/presence_extras.hpp"

#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t everyCycle = 0, view30 = 2, view5 = 3;  // streams
const MirrorView allAt30 = viewOf({{{"/"}, 30}});
const Moment outset{1h};

TEST(PatienceOfAView, IsThatOfTheSlowerOfViewAndAgent) {
    EXPECT_EQ(patienceOf(view5, 1'000'000), 600ms);
    EXPECT_EQ(patienceOf(view5, 1'000'000, 1'000), 3s) << "it is written every 1,000 cycles";
    EXPECT_EQ(patienceOf(everyCycle, 200'000'000), 600ms);
    EXPECT_EQ(patienceOf(everyCycle, 1'000), 100ms) << "the scheduling of the mirror itself";
    EXPECT_EQ(patienceOf(everyCycle, -1), 100ms) << "what cannot be";
    EXPECT_GT(patienceOf(view30, std::numeric_limits<std::int64_t>::max(), 1'000'000), 1h);
}

class MirrorPatience : public testing::Test {
protected:
    void tellAll() {
        for (const Model& model : agent.models) agents.take(model, outset);
        agents.take(agent.presence, outset);
    }
    // So long after the beginning. Its presence goes on, its loop does not.
    Quality qualityAfter(std::chrono::nanoseconds time, const std::string& path) {
        MirrorAgent& rig = *agents.find("rig");
        rig.heard = outset + time;
        agents.tick(allAt30, outset + time);
        const AgentImage image = rig.image();
        return image->quality(path);
    }

    ToldAgent agent;
    MirrorAgents agents{[](const MirrorAgent&, const char*) {}};
};

TEST_F(MirrorPatience, TakesValuesOfASlowAgentForGoodUntilItMissesThreeCycles) {
    agent.presence.period = 1'000'000'000;
    tellAll();
    agents.tick(allAt30, outset);
    ASSERT_NE(agents.take(agent.block(1), view30, outset), nullptr);
    const Quality boss = qualityAfter(0s, "/boss");
    ASSERT_LT(boss, Quality::Stale);

    EXPECT_EQ(qualityAfter(3s - 1ns, "/work/one"), Quality::Good);
    EXPECT_EQ(qualityAfter(3s, "/work/one"), Quality::Stale);
    EXPECT_EQ(qualityAfter(12s - 1ns, "/boss"), boss) << "it is written every fourth cycle";
    EXPECT_EQ(qualityAfter(12s, "/boss"), Quality::Stale);
}

TEST_F(MirrorPatience, AwaitsOthersThatMayOwnAPathForAsLongAsItIsTold) {
    Presence other = agent.presence;
    other.name = "other";
    other.agent = agentId(other.name);
    other.extras = {{rootPaths, "/work"}};
    agents.take(other, outset);
    EXPECT_FALSE(agents.isOwned("/work/one", outset, true, 0ms)) << "nobody has it";

    tellAll();
    const Moment known = agents.find("rig")->known;

    EXPECT_FALSE(agents.isOwned("/work/one", known + 300ms, true, 300ms));
    EXPECT_TRUE(agents.isOwned("/work/one", known + 301ms, true, 300ms));
    EXPECT_TRUE(agents.isOwned("/work/one", known + 301ms, false, 300ms));
    EXPECT_TRUE(agents.isOwned("/plate", known, true, 300ms)) << "the other cannot have it";
    EXPECT_FALSE(agents.isOwned("/plate", known, false, 300ms));
}

}  // namespace
}  // namespace cortex::comms
