// SPDX-License-Identifier: Apache-2.0
// How simplexes are, as an agent says in a summary.
#include "comms/told_agent.hpp"
#include "mirror/mirror_agents.hpp"
#include "wire/presence_extras.hpp"
#include "wire/simplex_marks.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using namespace std::chrono_literals;

const MirrorView slowView = viewOf({{{"/"}, 5}});
const Moment start{1h};

TEST(SimplexMark, StandsInOneOctet) {
    for (const auto state : {std::optional<State>{}, std::optional{State::Standby},
                             std::optional{State::Active}, std::optional{State::Fault}}) {
        for (const Quality quality : {Quality::Good, Quality::Stale, Quality::Bad, Quality::Lost}) {
            for (const bool outside : {false, true}) {
                const SimplexMark mark{state, quality, outside};
                EXPECT_EQ(markOf(octetOf(mark)), mark);
            }
        }
    }
    EXPECT_EQ(octetOf({State::Active, Quality::Good, false}), 3U << 2U);
    EXPECT_EQ(markOf(6U << 2U), std::nullopt) << "no such state";
    EXPECT_EQ(markOf(0xc0U | 3U << 2U), markOf(3U << 2U)) << "what later versions add";
}

class MirrorMarks : public testing::Test {
protected:
    MirrorMarks() {
        agent.presence.extras.push_back({summaries, "1"});
        for (const Model& model : agent.models) agents.take(model, start);
        agents.take(agent.presence, start);
    }

    MirrorAgent& rig() { return *agents.find("rig"); }
    SimplexMark mark(Moment now = start) {
        const auto marks = rig().marks(now);
        const std::uint32_t worker = agent.structure().find("/work/one");
        return worker < marks.size() ? marks[worker] : SimplexMark{};
    }

    ToldAgent agent;
    MirrorAgents agents{[](const MirrorAgent&, const char*) {}};
};

TEST_F(MirrorMarks, TellHowEachSimplexIs) {
    EXPECT_TRUE(rig().marks(start).empty()) << "nothing has come";
    ASSERT_TRUE(agents.take(agent.summary(), start));

    const auto marks = rig().marks(start);

    const Image image = agent.rig.agent->images().newest();
    ASSERT_EQ(marks.size(), agent.structure().simplexes.size());
    for (std::uint32_t i = 0; i < marks.size(); ++i) {
        const bool own = i < agent.presence.simplexes;
        EXPECT_EQ(marks[i].quality, own ? image.state(i).quality : Quality::Lost);
    }
    EXPECT_EQ(mark().state, static_cast<State>(image.get<std::int64_t>("/work/one", "state")));
    EXPECT_FALSE(mark().outside);

    agent.worker->data<double>("gain") = 1000.0;
    agent.rig.step();
    ASSERT_TRUE(agents.take(agent.summary(), start));
    EXPECT_TRUE(mark().outside);
}

TEST_F(MirrorMarks, AreStaleWhereNothingComesAndLostWithTheAgent) {
    agents.take(agent.summary(), start);

    EXPECT_EQ(mark(start + 599ms).quality, Quality::Good);
    EXPECT_EQ(mark(start + 600ms).quality, Quality::Stale);
    agents.take(agent.summary(), start + 600ms);
    EXPECT_EQ(mark(start + 600ms).quality, Quality::Stale) << "the same cycle is no news";
    agents.tick({}, start + 2s);
    EXPECT_EQ(mark(start + 2s).quality, Quality::Lost);
    agent.rig.step();
    agents.take(agent.summary(), start + 3s);
    EXPECT_EQ(mark(start + 3s).quality, Quality::Good);
}

TEST_F(MirrorMarks, OfASlowAgentAreStaleWhenItMissesThreeCycles) {
    agent.presence.period = 1'000'000'000;
    agents.take(agent.presence, start);
    agents.take(agent.summary(), start);
    const auto boss = [&](Moment now) {
        return rig().marks(now)[agent.structure().find("/boss")].quality;
    };
    const Quality own = boss(start);

    EXPECT_EQ(mark(start + 3s - 1ns).quality, Quality::Good);
    EXPECT_EQ(mark(start + 3s).quality, Quality::Stale);
    EXPECT_EQ(boss(start + 12s - 1ns), own) << "it is written every fourth cycle";
}

TEST_F(MirrorMarks, OfASummaryThatCannotBeAreRefusedWhole) {
    using Fault = std::function<void(Summary&)>;
    agents.take(agent.summary(), start);
    const auto before = rig().marks(start);
    for (const Fault& fault : std::vector<Fault>{
             [](Summary& each) { ++each.epoch; }, [](Summary& each) { each.structureHash = {}; },
             [](Summary& each) { each.marks.pop_back(); },
             [](Summary& each) { each.marks.push_back(0); }, [](Summary& each) { each.marks = {}; },
             [](Summary& each) { each.marks.back() = 6U << 2U; }}) {
        const std::uint64_t refused = agents.refused();
        Summary summary = agent.summary();
        summary.marks.front() = 0x3;
        fault(summary);
        EXPECT_FALSE(agents.take(summary, start));
        EXPECT_EQ(agents.refused(), refused + 1);
        EXPECT_EQ(rig().marks(start), before);
    }
}

TEST_F(MirrorMarks, OfAnAgentThatSendsNoSummariesFollowFromWhatIsViewed) {
    agent.presence.extras.clear();
    agents.take(agent.presence, start);
    EXPECT_FALSE(rig().status(start).summarises);
    EXPECT_TRUE(rig().marks(start).empty()) << "nothing is viewed";
    agents.tick(slowView, start);
    agents.take(agent.block(1), 3, start);

    const Image image = agent.rig.agent->images().newest();
    EXPECT_EQ(mark().state, static_cast<State>(image.get<std::int64_t>("/work/one", "state")));
    EXPECT_EQ(mark().quality, Quality::Good);
}

}  // namespace
}  // namespace cortex::comms
