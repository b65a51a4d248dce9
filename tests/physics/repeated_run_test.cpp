// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/archive.hpp"

#include "physics/model_scene.hpp"
#include "toolkit/allocation_counter.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <thread>

#include <gtest/gtest.h>

namespace cortex::physics::test {
namespace {

// An LBR that sweeps through boxes on a table, while a 2F-85 closes about one of them.
Scene busyScene() {
    Scene scene = liftWith(shippedGripper());
    scene.arms.push_back(shippedLbr());
    scene.arms[1].joints[0].origin = {0.7, 0, 0};
    scene.bodies = {fixedBox("/table", {2, 2, 0.1}, {0, 0, 0.29}),
                    freeBody("/held", Body::Shape::Box, {0.06, 0.06, 0.05}, 0.3, {0, 0, 0.365})};
    for (int i = 0; i < 8; ++i) {
        const double x = 0.5 + 0.12 * (i % 4), y = 0.4 + 0.12 * (i / 4);
        scene.bodies.push_back(freeBody("/box" + std::to_string(i), Body::Shape::Box,
                                        {0.06, 0.06, 0.06}, 0.2, {x, y, 0.375}));
    }
    scene.contactLimit = 200;
    return scene;
}

std::vector<JointDemand> demandsAt(int cycle) {
    std::vector<JointDemand> demands(9);
    const double time = cycle * 0.001;
    demands[0] = {.position = 0.02 * std::sin(time), .braked = false};
    for (std::size_t i = 0; i < 7; ++i)
        demands[1 + i] = {.position = lbrPosture[i] + 0.3 * std::sin(3 * time), .braked = false};
    demands[8] = {.position = std::max(0.0, 0.085 - 0.15 * time), .effort = 30, .braked = false};
    if (cycle % 100 > 90) {
        for (JointDemand& demand : demands) demand.braked = true;
    }
    return demands;
}

int run(Physics& physics, int from, int to) {
    int most = 0;
    for (int cycle = from; cycle < to; ++cycle) {
        EXPECT_EQ(physics.step(0.001, 1, demandsAt(cycle), {}), Trouble::None) << physics.why();
        most = std::max(most, physics.contacts());
    }
    return most;
}

TEST(RepeatedRun, IsTheSameBitForBitInAnyThread) {
    Physics one{busyScene()}, other{busyScene()}, third{busyScene()};
    EXPECT_GE(run(one, 0, 1000), 30);
    run(other, 0, 1000);
    std::thread{[&] { run(third, 0, 1000); }}.join();
    EXPECT_EQ(stateOf(one), stateOf(other));
    EXPECT_EQ(stateOf(one), stateOf(third));
    EXPECT_EQ(one.energy(), other.energy());
}

TEST(RepeatedRun, GoesOnTheSameFromAKeptState) {
    Physics one{busyScene()}, other{busyScene()};
    run(one, 0, 595);  // the brakes are on
    Archive measure;
    one.keep(measure);
    std::vector<std::byte> kept(measure.size());
    Archive save{kept};
    one.keep(save);
    EXPECT_FALSE(save.problem());

    run(other, 0, 50);
    Archive restore{std::span<const std::byte>{kept}, Archive::Purpose::Restore};
    other.keep(restore);
    restore.finish();
    EXPECT_FALSE(restore.problem());
    EXPECT_EQ(stateOf(one), stateOf(other));
    EXPECT_EQ(one.contacts(), other.contacts());
    EXPECT_EQ(one.energy(), other.energy());
    run(one, 595, 900);
    run(other, 595, 900);
    EXPECT_EQ(stateOf(one), stateOf(other));
}

TEST(RepeatedRun, OfAnotherSceneDoesNotFit) {
    Physics one{busyScene()}, other{liftWith(shippedGripper())};
    Archive measure;
    one.keep(measure);
    std::vector<std::byte> kept(measure.size());
    Archive save{kept};
    one.keep(save);
    Archive check{std::span<const std::byte>{kept}, Archive::Purpose::Check};
    other.keep(check);
    EXPECT_TRUE(check.problem());
}

TEST(StepOfPhysics, AllocatesNothingInContactBrakedInTroubleOrByReset) {
    Physics physics{busyScene()};
    run(physics, 0, 300);
    std::vector<std::vector<JointDemand>> demands;
    for (int cycle = 300; cycle < 400; ++cycle) demands.push_back(demandsAt(cycle));
    int most = 0;
    const std::uint64_t before = toolkit::test::allocationCount();
    for (const std::vector<JointDemand>& now : demands) {
        physics.step(0.001, 2, now, {});
        most = std::max(most, physics.contacts());
    }
    demands[0][3].effort = std::numeric_limits<double>::quiet_NaN();
    const Trouble trouble = physics.step(0.001, 1, demands[0], {});
    const BodyState body = physics.body(0);
    physics.reset();
    const std::uint64_t allocations = toolkit::test::allocationCount() - before;
    EXPECT_EQ(allocations, 0U);
    EXPECT_GE(most, 30);
    EXPECT_EQ(trouble, Trouble::Diverged);
    EXPECT_GT(body.position[2], 0);
    const std::uint64_t counts = toolkit::test::allocationCount();
    EXPECT_EQ(std::vector<int>(3).size(), 3U);
    EXPECT_GT(toolkit::test::allocationCount(), counts) << "they are not counted";
}

}  // namespace
}  // namespace cortex::physics::test
