// SPDX-License-Identifier: Apache-2.0
#include "cortex/mechanics/motion_profile.hpp"

#include "cortex/mechanics/synchronous_move.hpp"

#include "toolkit/allocation_counter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::mechanics {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double noNumber = std::numeric_limits<double>::quiet_NaN();
constexpr MotionLimits limits{2, 10, 100};
constexpr MotionLimits trapezoid{2, 10};

double timeFromRest(double way, const MotionLimits& of) {
    return planPosition({}, way, of)->duration();
}

// Of all times of a profile: the greatest magnitudes of velocity and acceleration.
MotionState greatest(const Profile& profile) {
    MotionState most;
    for (int i = 0; i <= 1000; ++i) {
        const MotionState state = profile.at(profile.duration() * i / 1000);
        most.velocity = std::max(most.velocity, std::abs(state.velocity));
        most.acceleration = std::max(most.acceleration, std::abs(state.acceleration));
    }
    return most;
}

TEST(Profile, TakesTheTimesOfTheClosedFormsFromRest) {
    const double v = limits.velocity, a = limits.acceleration, j = limits.jerk;
    const double ramp = a / j;

    EXPECT_NEAR(timeFromRest(0.01, limits), 4 * std::cbrt(0.01 / (2 * j)), 1e-9);
    EXPECT_NEAR(timeFromRest(0.3, limits), ramp + std::sqrt(ramp * ramp + 4 * 0.3 / a), 1e-9);
    EXPECT_NEAR(timeFromRest(-3, limits), 3 / v + v / a + ramp, 1e-9);
    EXPECT_NEAR(timeFromRest(0.1, trapezoid), 2 * std::sqrt(0.1 / a), 1e-9);
    EXPECT_NEAR(timeFromRest(-3, trapezoid), 3 / v + v / a, 1e-9);
}

TEST(Profile, BeginsAtItsStartAndStandsAtItsTarget) {
    const MotionState start{0.5, -1, 4};
    const auto profile = planPosition(start, 2, limits);
    ASSERT_TRUE(profile);

    for (const double time : {-1.0, 0.0}) {
        EXPECT_EQ(profile->at(time).position, start.position);
        EXPECT_EQ(profile->at(time).velocity, start.velocity);
        EXPECT_EQ(profile->at(time).acceleration, start.acceleration);
    }
    for (const double after : {0.0, 7.0}) {
        EXPECT_EQ(profile->at(profile->duration() + after).position, 2);
        EXPECT_EQ(profile->at(profile->duration() + after).velocity, 0);
    }
}

TEST(Profile, NeedsNoTimeWhereTheAxisStandsAtItsTarget) {
    const auto profile = planPosition({1, 0, 0}, 1, limits);

    ASSERT_TRUE(profile);
    EXPECT_EQ(profile->duration(), 0);
    EXPECT_EQ(profile->at(3).position, 1);
}

TEST(Profile, TakesTheTimeThatItIsGiven) {
    for (const double time : {1.0, 2.5, 60.0}) {
        const auto profile = planPosition({}, 0.5, limits, time);

        ASSERT_TRUE(profile);
        EXPECT_NEAR(profile->duration(), time, 1e-9);
        EXPECT_LT(greatest(*profile).velocity, limits.velocity);
    }
}

TEST(Profile, EndsBehindTheGapWhereATimeCannotBeHad) {
    const MotionState start{0, 2, 0};  // it must brake hard, or brake and set out once more
    const MotionLimits weak{2, 2, 4};
    const double target = planVelocity(start, 0, weak)->end().position + 0.002;
    const double shortest = planPosition(start, target, weak)->duration();
    double gapBegin = 0, gapEnd = 0, before = shortest;
    for (int i = 1; i < 2000; ++i) {
        const double asked = shortest + i * 1e-3;
        const double time = planPosition(start, target, weak, asked)->duration();
        EXPECT_GE(time, asked - 1e-9);
        if (time > asked + 1e-6) {
            if (gapEnd == 0) gapBegin = before;
            gapEnd = time;
        }
        before = time;
    }

    EXPECT_GT(gapEnd - gapBegin, 0.01);
}

TEST(Profile, KeepsItsLimitsFromAnyStartWithinThem) {
    std::mt19937_64 engine(3);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine);
    };
    for (int i = 0; i < 2000; ++i) {
        MotionLimits of{between(0.5, 2.4), between(1, 15), between(20, 300)};
        if (i % 4 == 0) of.jerk = infinity;
        const double a = i % 2 ? between(-of.acceleration, of.acceleration) : 0;
        // Such that the velocity stays within its limit while the acceleration goes to 0.
        const double room = of.velocity - (a * a / (2 * of.jerk));
        if (room < 0) continue;
        const MotionState start{between(-2, 2), between(-room, room), a};
        const auto profile = planPosition(start, between(-2, 2), of, i % 3 ? 0 : between(0, 9));

        ASSERT_TRUE(profile);
        const MotionState most = greatest(*profile);
        EXPECT_LE(most.velocity, of.velocity * (1 + 1e-12));
        EXPECT_LE(most.acceleration, of.acceleration * (1 + 1e-12));
        const MotionState end = profile->at(profile->duration() * (1 - 1e-15));
        EXPECT_NEAR(end.position, profile->end().position, 1e-12);
        EXPECT_NEAR(end.velocity, 0, 1e-6);
    }
}

TEST(Profile, LeadsAStartBeyondItsLimitsBackAtOnce) {
    const MotionState start{0, 3, 20};
    const auto profile = planPosition(start, 5, limits);

    ASSERT_TRUE(profile);
    EXPECT_LT(profile->at(0.01).acceleration, 20);
    EXPECT_LE(std::abs(profile->at(0.7).velocity), limits.velocity * (1 + 1e-12));
    EXPECT_EQ(profile->at(profile->duration()).position, 5);
}

TEST(VelocityStep, EndsAtItsVelocityWithoutAccelerationAndGoesOn) {
    const auto profile = planVelocity({1, -0.5, 3}, 1.5, limits);

    ASSERT_TRUE(profile);
    const MotionState end = profile->at(profile->duration());
    EXPECT_EQ(end.velocity, 1.5);
    EXPECT_EQ(end.acceleration, 0);
    EXPECT_NEAR(profile->at(profile->duration() + 2).position, end.position + 3, 1e-12);
    EXPECT_LE(greatest(*profile).acceleration, limits.acceleration * (1 + 1e-12));
}

TEST(VelocityStep, TakesTheTimesOfTheClosedForms) {
    const double ramp = limits.acceleration / limits.jerk;

    EXPECT_NEAR(planVelocity({}, 0.25, limits)->duration(), 2 * std::sqrt(0.25 / 100), 1e-12);
    EXPECT_NEAR(planVelocity({}, 2, limits)->duration(), 2 / limits.acceleration + ramp, 1e-12);
    EXPECT_NEAR(planVelocity({}, 2, trapezoid)->duration(), 2 / limits.acceleration, 1e-12);
    EXPECT_EQ(planVelocity({4, 0, 0}, 0, limits)->duration(), 0);
    EXPECT_NEAR(planVelocity({0, 2, 0}, 0, trapezoid)->end().position, 4 / 20.0, 1e-12);
}

TEST(Profile, ComesBackToWhereItBeganInMotion) {
    for (const double velocity : {-1.0, 0.5}) {
        const auto profile = planPosition({0, velocity, 0}, 0, limits);
        ASSERT_TRUE(profile);
        EXPECT_EQ(profile->at(profile->duration()).position, 0);
        EXPECT_EQ(profile->at(0).velocity, velocity);
    }
}

TEST(Profile, IsRefusedWhereNumbersMakeNoSense) {
    for (const double wrong : {0.0, -1.0, noNumber}) {
        EXPECT_FALSE(planPosition({}, 1, {wrong, 10, 100}));
        EXPECT_FALSE(planPosition({}, 1, {2, wrong, 100}));
        EXPECT_FALSE(planPosition({}, 1, {2, 10, wrong}));
        EXPECT_FALSE(planVelocity({}, 1, {2, wrong, 100}));
    }
    for (const double wrong : {noNumber, infinity, -infinity}) {
        EXPECT_FALSE(planPosition({wrong, 0, 0}, 1, limits));
        EXPECT_FALSE(planPosition({0, wrong, 0}, 1, limits));
        EXPECT_FALSE(planPosition({0, 0, wrong}, 1, limits));
        EXPECT_FALSE(planPosition({}, wrong, limits));
        EXPECT_FALSE(planPosition({}, 1, limits, wrong));
        EXPECT_FALSE(planVelocity({}, wrong, limits));
    }
    EXPECT_FALSE(planPosition({}, 1, {infinity, 10, 100}));
    EXPECT_FALSE(planPosition({}, 1, {2, infinity, 100}));
}

TEST(Profile, IsRightOrRefusedForNumbersOfAnySize) {
    std::mt19937_64 engine(5);
    const auto any = [&] {
        const double size = std::uniform_real_distribution<double>(-320, 305)(engine);
        return (engine() % 2 ? 1 : -1) * std::pow(10.0, size);
    };
    for (int i = 0; i < 5000; ++i) {
        const MotionLimits of{std::abs(any()), std::abs(any()), std::abs(any())};
        const double target = any();
        const auto profile = planPosition({any(), any(), any()}, target, of);

        if (!profile) continue;
        EXPECT_TRUE(std::isfinite(profile->duration()));
        EXPECT_EQ(profile->at(profile->duration()).position, target);
    }
}

TEST(SynchronousMove, BringsAllAxesToRestAtOnce) {
    const std::array<MotionState, 3> starts{{{0, 1, 0}, {1, 0, 0}, {2, 0, 0}}};
    const std::array<double, 3> targets{0.4, -2, 2};
    const std::array<MotionLimits, 3> of{{{2, 2, 4}, {1, 10, 100}, {1, 10}}};
    SynchronousMove move;

    ASSERT_TRUE(move.plan(starts, targets, of));
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_NEAR(move.profile(i).duration(), move.duration(), 1e-9);
        EXPECT_EQ(move.profile(i).at(move.duration()).position, targets[i]);
    }
    EXPECT_EQ(move.profile(2).at(move.duration() / 2).position, 2);
}

TEST(SynchronousMove, StaysAsItIsWhereAPlanIsRefused) {
    const std::array<MotionState, 2> starts{};
    const std::array<double, 2> targets{1, 2};
    SynchronousMove move;
    ASSERT_TRUE(move.plan(starts, targets, std::array{limits, limits}));
    const double duration = move.duration();

    EXPECT_FALSE(move.plan(starts, std::array{1.0, noNumber}, std::array{limits, limits}));
    EXPECT_FALSE(move.plan(starts, targets, std::array{limits, MotionLimits{}}));
    EXPECT_FALSE(move.plan(starts, std::array{1.0}, std::array{limits, limits}));
    EXPECT_FALSE(move.plan(std::vector<MotionState>(17), std::vector<double>(17),
                           std::vector<MotionLimits>(17, limits)));
    EXPECT_EQ(move.duration(), duration);
    EXPECT_EQ(move.profile(1).end().position, 2);
}

TEST(SynchronousMove, NeitherPlansNorReadsWithAnAllocation) {
    const std::array<MotionState, 2> starts{{{0, 1, 1}, {1, -1, 0}}};
    SynchronousMove move;
    double sum = 0;

    const auto before = toolkit::test::allocationCount();
    ASSERT_TRUE(move.plan(starts, std::array{2.0, 3.0}, std::array{limits, trapezoid}));
    for (int i = 0; i < 100; ++i) sum += move.profile(0).at(i * 0.01).position;
    EXPECT_EQ(toolkit::test::allocationCount(), before);
    EXPECT_GT(sum, 0);
}

}  // namespace
}  // namespace cortex::mechanics
