// SPDX-License-Identifier: Apache-2.0
// A controller of axes moves to no target that nobody gave, and where it starts again the demand of
// an axis that follows stays where it is.
#include "rig.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

// Each controller with a target, what leads there, and the target.
struct Case {
    const char *type, *command, *item;
};

class ATarget : public testing::TestWithParam<Case> {
protected:
    // An axis at 0.7 rad, and its drive.
    void begin(const Rig::Pairs& settings = {}) {
        rig_.add("/demand", "LimitedAxis");
        rig_.add("/axis", "RotaryAxisObservation");
        rig_.add("/drive", "SimulatedAxis", {{"demand", "/demand"}, {"observation", "/axis"}},
                 {{"startPosition", "0.7"}});
        Rig::Pairs all = settings;
        if (GetParam().type == std::string{"JogController"}) all.emplace_back("mode", "1");
        rig_.add("/control", GetParam().type, {{"axes", "/axis"}, {"demands", "/demand"}}, all);
        rig_.start();
        rig_.startUp();
    }
    CallResult move() { return rig_.call("/control", GetParam().command); }
    CallResult set(double first) {
        std::vector<double> target(16);
        target[0] = first;
        return rig_.call("/control", "set", {{GetParam().item, target}});
    }
    static std::string places(const std::string& first) {
        return first + " 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0";
    }
    void expectNone() {
        const CallResult answer = move();
        EXPECT_EQ(answer.outcome, Outcome::Rejected);
        EXPECT_EQ(answer.why, std::string{GetParam().item} + " was never set: set it first");
        EXPECT_FALSE(rig_.get<bool>("/control", "targetGiven"));
    }
    double shown() { return rig_.array("/control", GetParam().item)[0]; }
    double position() { return rig_.get<double>("/axis", "position"); }

    Rig rig_;
};

INSTANTIATE_TEST_SUITE_P(Of, ATarget,
                         testing::Values(Case{"AxisPoseController", "moveTo", "pose"},
                                         Case{"JointTrajectoryController", "moveTo", "pose"},
                                         Case{"JogController", "go", "demandPosition"}),
                         [](const auto& each) { return std::string{each.param.type}; });

TEST_P(ATarget, ThatNobodyGaveIsWhereTheAxesAreAndNothingMovesThere) {
    begin();
    expectNone();
    EXPECT_EQ(shown(), position());
    EXPECT_EQ(position(), 0.7);
    ASSERT_TRUE(rig_.call("/control", "shutdown").done());
    ASSERT_TRUE(rig_.call("/control", "startup").done());
    expectNone();
    rig_.step(1000);
    EXPECT_NEAR(position(), 0.7, 1e-9);
}

TEST_P(ATarget, IsGivenByASetUntilTheEndOfTheAgent) {
    begin();
    ASSERT_TRUE(set(-0.5).done());
    EXPECT_TRUE(rig_.get<bool>("/control", "targetGiven"));
    EXPECT_EQ(shown(), -0.5);
    EXPECT_TRUE(move().done());
    EXPECT_EQ(rig_.get<double>("/demand", "position"), -0.5);
    ASSERT_TRUE(rig_.call("/control", "shutdown").done());
    ASSERT_TRUE(rig_.call("/control", "startup").done());
    EXPECT_TRUE(move().done());
    EXPECT_EQ(shown(), -0.5);
}

TEST_P(ATarget, IsGivenByASetOfTheValueThatItShows) {
    begin();
    ASSERT_TRUE(set(0.7).done());
    EXPECT_TRUE(move().done());
}

TEST_P(ATarget, IsGivenByAStartValue) {
    begin({{GetParam().item, places("0.2")}});
    EXPECT_TRUE(rig_.get<bool>("/control", "targetGiven"));
    EXPECT_TRUE(move().done());
    EXPECT_EQ(rig_.get<double>("/demand", "position"), 0.2);
}

TEST_P(ATarget, ThatWasRetainedWithoutHavingBeenGivenIsNone) {
    begin({{GetParam().item, places("0.2")}, {"targetGiven", "false"}});
    expectNone();
    EXPECT_EQ(shown(), 0.7);
}

TEST_P(ATarget, IsNotGivenByASetThatWasRejected) {
    begin();
    EXPECT_FALSE(set(std::numeric_limits<double>::quiet_NaN()).done());
    expectNone();
}

TEST(ATargetOfAJog, IsNotGivenByASetOfAnotherItem) {
    Rig rig;
    rig.add("/demand", "LimitedAxis");
    rig.add("/axis", "RotaryAxisObservation");
    rig.add("/drive", "SimulatedAxis", {{"demand", "/demand"}, {"observation", "/axis"}});
    rig.add("/jog", "JogController", {{"axes", "/axis"}, {"demands", "/demand"}}, {{"mode", "1"}});
    rig.start();
    rig.startUp();
    ASSERT_TRUE(rig.call("/jog", "set", {{"speedShare", 0.5}}).done());
    EXPECT_EQ(rig.call("/jog", "go").outcome, Outcome::Rejected);
}

// --- startups ---------------------------------------------------------------------------------

// An axis far behind its demand, jogged by hand.
class SlowAxis : public Rig {
public:
    SlowAxis() {
        add("/demand", "LimitedAxis");
        add("/axis", "RotaryAxisObservation");
        add("/drive", "SimulatedAxis", {{"demand", "/demand"}, {"observation", "/axis"}},
            {{"naturalFrequency", "1"}});
        add("/jog", "JogController", {{"axes", "/axis"}, {"demands", "/demand"}});
        start();
        startUp();
    }
    void jog(double velocity) {
        cluster().send("/jog", "jog", {{"axis", std::int64_t{1}}, {"velocity", velocity}});
    }
    // The way of each cycle is no longer than its velocity says.
    void stepSteadily(int cycles) {
        for (int i = 0; i < cycles; ++i) {
            const double position = demand("position"), velocity = demand("velocity");
            step();
            const double most = std::max(std::abs(velocity), std::abs(demand("velocity"))) * 1e-3;
            EXPECT_LE(std::abs(demand("position") - position), most + 1e-9) << "cycle " << cycle();
        }
    }
    double demand(const std::string& item) { return get<double>("/demand", item); }
};

TEST(AStartup, LeavesTheDemandOfAnAxisThatFollowsWhereItIs) {
    SlowAxis rig;
    std::mt19937 random{78};
    const auto number = [&](int most) { return std::uniform_int_distribution{1, most}(random); };
    int farBehind = 0;
    for (int round = 0; round < 60; ++round) {
        const double velocity = std::abs(rig.demand("position")) > 1
                                    ? -std::copysign(2.0, rig.demand("position"))
                                    : std::copysign(2.0, number(2) - 1.5);
        rig.jog(0);
        rig.jog(velocity);
        rig.stepSteadily(number(250));
        rig.cluster().send("/jog", "shutdown");
        rig.stepSteadily(number(600));
        const double behind = rig.demand("position") - rig.get<double>("/axis", "position");
        if (rig.demand("velocity") == 0 && std::abs(behind) > 0.01) ++farBehind;
        rig.cluster().send("/jog", "startup");
        rig.stepSteadily(number(20) + 4);
        ASSERT_EQ(rig.state("/jog"), State::Active);
    }
    EXPECT_GT(farBehind, 5);
    EXPECT_EQ(rig.get<std::int64_t>("/rig", "limitCount"), 0);
}

// A drive of which nothing is known.
TEST(AStartup, TakesWhereAnAxisIsThatDoesNotSayThatItFollows) {
    Rig rig;
    rig.add("/demand", "RotaryAxisConcept");
    rig.add("/axis", "RotaryAxisObservation");
    rig.add("/hold", "HoldAxisController", {{"axes", "/axis"}, {"demands", "/demand"}});
    rig.start();
    rig.tree().at("/axis").data<double>("position") = 0.4;
    rig.step();
    rig.startUp();
    rig.step(10);
    EXPECT_EQ(rig.get<double>("/demand", "position"), 0.4);
}

TEST(AStartup, TakesWhereAnAxisIsThatDoesNotFollow) {
    SlowAxis rig;
    rig.jog(2);
    rig.step(200);
    rig.cluster().send("/jog", "shutdown");
    rig.cluster().send("/drive", "shutdown");
    rig.step(3000);
    ASSERT_TRUE(rig.call("/jog", "startup").done());
    rig.step(2000);
    EXPECT_NEAR(rig.demand("position"), rig.get<double>("/axis", "position"), 1e-9);
}

}  // namespace
}  // namespace cortex::toolkit::test
