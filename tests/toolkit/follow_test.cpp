// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"

#include "rig.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

// An axis of 3 rad either way, 2 rad/s, 10 rad/s2, 100 rad/s3, and a target without limits.
class Following : public testing::Test {
protected:
    static constexpr double period = 1e-3;

    Following() {
        rig_.add("/axis", "RotaryAxisObservation");
        rig_.add("/target", "RotaryAxisConcept");
        rig_.add("/demand", "LimitedAxis");
        rig_.add("/follow", "FollowAxisController",
                 {{"axes", "/axis"}, {"targets", "/target"}, {"demands", "/demand"}});
        rig_.cluster().addEventSink([this](const Event& event, const Structure&) {
            if (event.text.view().find("target of /demand") != std::string_view::npos) ++told_;
        });
        rig_.start();
    }
    void aim(double position, double velocity = 0) {
        rig_.tree().at("/target").data<double>("position") = position;
        rig_.tree().at("/target").data<double>("velocity") = velocity;
    }
    void step(int cycles) {
        for (int i = 0; i < cycles; ++i) {
            const double before = velocity();
            rig_.step();
            change_ = std::max(change_, std::abs(velocity() - before) / period);
        }
    }
    void startUp() { rig_.cluster().send("/follow", "startup"); }
    // The target goes on at this velocity.
    void lead(double from, double velocity, int cycles) {
        for (int i = 0; i < cycles; ++i) {
            aim(from + i * period * velocity, velocity);
            step(1);
        }
    }
    void expectWithinLimits() {
        EXPECT_LE(change_, 10 * (1 + 1e-9));
        EXPECT_EQ(rig_.get<std::int64_t>("/rig", "limitCount"), 0);
    }
    double position() { return rig_.get<double>("/demand", "position"); }
    double velocity() { return rig_.get<double>("/demand", "velocity"); }

    double change_ = 0;
    int told_ = 0;
    Rig rig_;
};

TEST_F(Following, BrakesBeforeTheEndOfTheRangeWhereItsTargetGoesBeyond) {
    startUp();
    lead(0, 1, 4000);

    EXPECT_NEAR(position(), 3, 1e-9);
    EXPECT_EQ(velocity(), 0);
    expectWithinLimits();
    rig_.cluster().agent().events().flush();
    EXPECT_EQ(told_, 1);
}

TEST_F(Following, GoesBackWithATargetThatComesBack) {
    startUp();
    lead(0, 1, 4000);
    lead(4, -1, 3500);

    EXPECT_NEAR(position(), 0.5 + period, 1e-6);
    EXPECT_NEAR(velocity(), -1, 1e-6);
    expectWithinLimits();
}

class FollowingFar : public Following, public testing::WithParamInterface<double> {};

TEST_P(FollowingFar, StopsAtTheEndAndNeverGoesTheOtherWay) {
    aim(GetParam());
    startUp();
    for (int i = 0; i < 6000; ++i) {
        step(1);
        ASSERT_GE(velocity(), 0);
    }

    EXPECT_NEAR(position(), 3, 1e-9);
    EXPECT_EQ(velocity(), 0);
    expectWithinLimits();
}

INSTANTIATE_TEST_SUITE_P(OfTargets, FollowingFar, testing::Values(3.5, 1000.0, 1e16, 1e308));

TEST_F(Following, PassesATargetOnUnchangedThatStopsBeforeTheEnd) {
    startUp();
    lead(0, 1, 2000);
    EXPECT_NEAR(position(), 2 - period, 1e-9);
    EXPECT_EQ(told_, 0);
}

// Down it may go at 1 rad/s only, up at 2.
TEST(AnAxisThatIsSlowerOneWay, IsNeverPlannedFasterThanThat) {
    Rig rig;
    rig.add("/axis", "RotaryAxisObservation");
    rig.add("/demand", "UnevenAxis");
    rig.add("/pose", "AxisPoseController", {{"axes", "/axis"}, {"demands", "/demand"}});
    rig.start();
    rig.startUp();
    std::vector<double> pose(16, -2.0);
    rig.cluster().send("/pose", "set", {{"pose", pose}});
    rig.cluster().send("/pose", "moveTo", {{"speedShare", 1.0}});
    double fastest = 0, before = 0;
    for (int i = 0; i < 4000; ++i) {
        rig.step();
        const double now = rig.get<double>("/demand", "position");
        fastest = std::max(fastest, std::abs(now - before) * 1e3);
        before = now;
    }

    EXPECT_EQ(before, -2);
    EXPECT_LE(fastest, 1 + 1e-9);
    EXPECT_EQ(rig.get<std::int64_t>("/rig", "limitCount"), 0);
}

}  // namespace
}  // namespace cortex::toolkit::test
