// SPDX-License-Identifier: Apache-2.0
// What is shown as the present value, and why a demand has the values that it has: one rule for the
// command line, the window, views of one's own and plots.
#include "common/live_rule.hpp"

#include "common/safe_demand.hpp"
#include "gui/made_agent.hpp"
#include "model/why_text.hpp"
#include "record/pending.hpp"

#include <array>
#include <optional>
#include <string>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

class LiveRule : public testing::Test {
protected:
    AgentFrame withWriter(State state, Quality quality, std::string_view cause) {
        robot.put("/probe", "state", static_cast<std::int64_t>(state));
        robot.degrade("/probe", quality, cause);
        robot.degrade("/order", Quality::Stale, "/probe");
        return robot.now();
    }
    std::uint32_t at(const char* path) const { return robot.at(path); }

    MadeAgent robot{"robot", [](SimplexTree& tree) {
                        Simplex& probe = tree.add("/probe", "Probe");
                        Simplex& order = tree.add("/order", "Order");
                        tree.relate(probe, "out", order);
                        tree.add("/signal", "Signal");
                    }};
};

struct Because {
    State state;
    Quality quality;
    const char* cause;
    bool safe;
    const char *why, *window;
};
const std::array<Because, 8> reasonsOfStale{{
    {State::Standby, Quality::Stale, "/probe", true, "/probe is in Standby",
     "Safe values, as /probe is in Standby."},
    {State::Fault, Quality::Good, "/probe", true, "/probe is in Fault",
     "Safe values, as /probe is in Fault."},
    {State::StartingUp, Quality::Good, "/probe", false, "/probe is in StartingUp",
     "Stale, as /probe is in StartingUp."},
    {State::StartingUp, Quality::Stale, "/probe", false, "/probe is in StartingUp",
     "Stale, as /probe is in StartingUp."},
    {State::ShuttingDown, Quality::Lost, "/signal", false, "/probe is in ShuttingDown",
     "Stale, as /probe is in ShuttingDown."},
    {State::Active, Quality::Lost, "/signal", true, "/probe has lost an input",
     "Safe values, as /probe has lost an input."},
    {State::Active, Quality::Stale, "/probe", false, "", ""},  // it calls itself stale
    {State::Active, Quality::Good, "/probe", false, "", ""},
}};

TEST_F(LiveRule, SaysWhyADemandIsStaleOnceForBothPrograms) {
    for (const Because& each : reasonsOfStale) {
        const AgentFrame agent = withWriter(each.state, each.quality, each.cause);
        const SlotState own = (*agent.image)->state(at("/order"));
        const auto demand = common::safeBecause(at("/order"), own, *agent.image);
        EXPECT_EQ(demand.safe, each.safe) << name(each.state);
        EXPECT_EQ(demand.why, each.why);
        EXPECT_EQ(agent.live(at("/order")), each.safe) << "a safe demand is live";

        const auto frame = frameOf({agent});
        const QString why = whyText(*frame, *frame->find("/order"));
        const bool told = *each.window != '\0';
        EXPECT_TRUE(!told || why.contains(QLatin1String{each.window})) << why.toStdString();
        EXPECT_TRUE(told || !why.contains("Safe values")) << why.toStdString();
    }
}

TEST_F(LiveRule, CallsWhatTheFrameworkWritesAsGoodAsTheLastCycleThatWasHeard) {
    const auto isLive = [&](const AgentFrame& agent, const char* path, const char* item) {
        const auto& layout = *robot.structure->simplexes[at(path)].layout;
        return agent.live(at(path), *layout.find(item)->item);
    };
    const AgentFrame rests = withWriter(State::Standby, Quality::Stale, "/probe");
    EXPECT_TRUE(isLive(rests, "/probe", "state"));
    EXPECT_TRUE(isLive(rests, "/probe", "faultText"));
    EXPECT_FALSE(rests.live(at("/probe"))) << "what it writes itself is old";

    AgentFrame hangs = withWriter(State::Active, Quality::Good, "/probe");
    EXPECT_TRUE(hangs.live(at("/probe")));
    hangs.status.standstill = "hangs in /probe.stateActive for 8.5 s";
    EXPECT_FALSE(isLive(hangs, "/probe", "state"));
    EXPECT_FALSE(hangs.live(at("/probe")));

    const AgentFrame lost = robot.now("lost");
    EXPECT_FALSE(isLive(lost, "/probe", "state"));
}

// Its thread knows its link, also while nothing answers; what never came is shown by nobody.
TEST(LiveRuleOfDevices, CallsTheLinkOfALostDeviceLiveAndShowsNothingThatNeverCame) {
    MadeAgent robot{"robot",
                    [](SimplexTree& tree) {
                        Simplex& boiler = tree.add("/boiler", "Boiler");
                        tree.relate(boiler, "heater", tree.add("/power", "BoilerPower"));
                        tree.relate(boiler, "water", tree.add("/water", "BoilerTemperature"));
                    },
                    "fieldbus-rules.xml"};
    const auto isShown = [&](const char* path, const char* item) {
        const std::uint32_t simplex = robot.at(path);
        return robot.now()
            .value(simplex, *robot.structure->simplexes[simplex].layout->find(item))
            .has_value();
    };
    const auto isLive = [&](const char* path, const char* item) {
        const std::uint32_t simplex = robot.at(path);
        const ItemLayout& layout = *robot.structure->simplexes[simplex].layout->find(item);
        return robot.now().live(simplex, *layout.item);
    };
    for (const char* path : {"/boiler", "/water"}) robot.degrade(path, Quality::Lost);
    EXPECT_FALSE(isShown("/boiler", "age"));
    EXPECT_FALSE(isShown("/boiler", "exchangeTimeMax"));
    EXPECT_FALSE(isShown("/water", "temperature"));
    EXPECT_FALSE(robot.now().age(robot.at("/water")));
    EXPECT_TRUE(isShown("/boiler", "exchangeCount"));
    EXPECT_TRUE(isShown("/power", "power"));
    EXPECT_TRUE(isLive("/boiler", "link"));
    robot.unasked = "/boiler";
    EXPECT_TRUE(isShown("/water", "temperature")) << "nobody knows that it never came";
    EXPECT_TRUE(robot.now().age(robot.at("/water")));
    robot.unasked.clear();

    robot.put("/boiler", "exchangeCount", std::int64_t{1});
    EXPECT_TRUE(isShown("/boiler", "age"));
    EXPECT_TRUE(isShown("/water", "temperature"));
    EXPECT_TRUE(robot.now().age(robot.at("/water")));
    EXPECT_TRUE(isLive("/boiler", "age"));
    EXPECT_FALSE(isLive("/water", "temperature")) << "the last one that came";
}

TEST_F(LiveRule, IsThatOfRecordsToo) {
    const auto recorded = [&](const RecordedItem& item) {
        Pending pending;
        pending.record({item});
        const AgentFrame agent = robot.now();
        pending.hear("robot", *agent.image);
        return pending.take().at(0).qualities.at(0);
    };
    withWriter(State::Standby, Quality::Stale, "/probe");
    const auto good = static_cast<std::uint8_t>(Quality::Good);
    EXPECT_EQ(recorded({"robot", "/probe", "faultCode", 0}), good);
    EXPECT_EQ(recorded({"robot", "/order", "value", 0}), good) << "a safe demand";
    withWriter(State::StartingUp, Quality::Stale, "/probe");
    EXPECT_NE(recorded({"robot", "/order", "value", 0}), good);
}

}  // namespace
}  // namespace cortex::test
