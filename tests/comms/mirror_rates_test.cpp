// SPDX-License-Identifier: Apache-2.0
// Views of a mirror with a rate for each set of paths.
#include "cortex/comms/mirror.hpp"

#include "comms/stepped_agent.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

// In each cycle the agent "robot" sets the gain of both its simplexes to the number of the cycle.
class MirrorRates : public testing::Test {
protected:
    MirrorRates() {
        agent->rig.hand("/arm");
        agent->rig.hand("/hand");
        agent->rig.start();
        mirror.onImage([this](const std::string&, const AgentImage& image) { note(image); });
    }

    void note(const AgentImage& image) {
        const std::lock_guard lock{mutex};
        const auto& structure = image->structure();
        if (image.came(structure.find("/hand"))) hand.insert(image->get<double>("/hand", "gain"));
        if (!image.came(structure.find("/arm"))) return;
        cycles.push_back(image->cycle());
        arm.insert(image->get<double>("/arm", "gain"));
        fits = fits && image->get<double>("/arm", "gain") == static_cast<double>(image->cycle());
    }

    void step() {
        for (const char* path : {"/arm", "/hand"}) {
            dynamic_cast<test::Hand&>(agent->rig.tree.at(path)).data<double>("gain") =
                static_cast<double>(agent->rig.tick.cycle + 1);
        }
        agent->rig.step();
    }

    // Steps until `condition` holds, each time after the newest cycle has come.
    template <class Condition>
    bool stepsUntil(Condition condition) {
        return comesTrue([&] {
            step();
            return condition();
        });
    }

    std::int64_t newest() {
        const std::lock_guard lock{mutex};
        return cycles.empty() ? 0 : cycles.back();
    }

    std::unique_ptr<SteppedAgent> agent = std::make_unique<SteppedAgent>("robot");
    std::mutex mutex;
    std::vector<std::int64_t> cycles;  // of the images that came
    std::set<double> arm, hand;        // values that were seen
    bool fits = true;                  // the value of the arm is that of the image's cycle
    Mirror mirror{"test", loopback()};
};

TEST_F(MirrorRates, EachSetOfPathsHasItsOwnRate) {
    mirror.view({Viewed{{"/arm"}, 0}, Viewed{{"/"}, 5}});
    ASSERT_TRUE(stepsUntil([&] {
        const std::lock_guard lock{mutex};
        return !arm.empty() && !hand.empty() && cycles.back() > 0;
    }));
    ASSERT_TRUE(comesTrue([&] { return newest() == agent->rig.tick.cycle; }));
    const std::uint64_t before = mirror.agents().front().loss;
    {
        const std::lock_guard lock{mutex};
        arm.clear();
        hand.clear();
    }
    for (int i = 0; i < 400; ++i) {
        step();
        ASSERT_TRUE(comesTrue([&] { return newest() == agent->rig.tick.cycle; }));
    }

    const std::lock_guard lock{mutex};
    EXPECT_GE(arm.size(), 400U);
    EXPECT_LT(hand.size(), 200U) << "five a second";
    EXPECT_TRUE(std::ranges::is_sorted(cycles)) << "the cycle is that of the fastest view";
    EXPECT_EQ(mirror.agents().front().loss, before);
}

TEST_F(MirrorRates, TheFastestViewGivesAnImageItsCycle) {
    mirror.view({Viewed{{"/"}, 30}, Viewed{{"/arm"}, 0}, Viewed{{"/arm"}, 5}});
    ASSERT_TRUE(stepsUntil([&] {
        const std::lock_guard lock{mutex};
        return arm.size() > 100 && hand.size() > 2;
    }));

    const std::lock_guard lock{mutex};
    EXPECT_TRUE(fits) << "a plot has each value at its cycle";
}

TEST_F(MirrorRates, AnotherRateKeepsTheValuesThatAreViewedAlready) {
    mirror.view({Viewed{{"/"}, 5}});
    ASSERT_TRUE(stepsUntil([&] { return static_cast<bool>(mirror.image("robot")); }));
    ASSERT_TRUE(stepsUntil([&] { return mirror.waitForValues(Mirror::Milliseconds{1}); }));

    mirror.view({Viewed{{"/"}, 5}, Viewed{{"/arm"}, 0}});

    EXPECT_TRUE(mirror.waitForValues(Mirror::Milliseconds{0}));
    EXPECT_EQ(mirror.image("robot")->quality("/arm"), Quality::Good);
    const std::int64_t before = agent->rig.tick.cycle;
    EXPECT_TRUE(stepsUntil([&] { return newest() > before; }));
}

}  // namespace
}  // namespace cortex::comms
