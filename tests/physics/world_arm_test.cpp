// SPDX-License-Identifier: Apache-2.0
// An LBR in a world, with the controllers of the toolkit.
#include "world_rig.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace cortex::physics::test {
namespace {

// Of the same arm, by KDL: N.m that hold it at lbrStart against 9.80665 m/s2.
constexpr std::array lbrWeight{0.0, -52.771484, -0.480523, 20.973181, -0.648991, -0.049862, 0.0};
constexpr double ofATorque = 1e-6, ofARest = 1e-6;

std::string axisOf(std::size_t i) { return "/lbr/axes/" + std::to_string(i + 1); }
std::string demandOf(std::size_t i) { return "/lbr/demands/" + std::to_string(i + 1); }

struct AnLbr : testing::Test {
    void begin(const std::string& controller, const Pairs& world = {}) {
        rig = std::make_unique<WorldRig>(lbrPlant(world));
        rig->send(controller, "startup");
        rig->send("/world", "startup");
        ASSERT_TRUE(rig->until([&] { return rig->state("/world") == State::Active; }))
            << rig->told();
    }
    double farthest(const std::array<double, 7>& pose) {
        double most = 0;
        for (std::size_t i = 0; i < pose.size(); ++i)
            most = std::max(most, std::abs(rig->position(axisOf(i)) - pose[i]));
        return most;
    }
    double lag() {
        double most = 0;
        for (std::size_t i = 0; i < 7; ++i)
            most = std::max(most, std::abs(rig->position(axisOf(i)) - rig->position(demandOf(i))));
        return most;
    }
    std::unique_ptr<WorldRig> rig;
};

TEST_F(AnLbr, StandsWhereItsPositionsWereGivenFromTheFirstCycleOn) {
    WorldRig plant{lbrPlant()};
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_NEAR(plant.position(axisOf(i)), lbrStart[i], ofARest);
        EXPECT_EQ(plant.get<std::int64_t>(axisOf(i), "status"), brakedStatus);
    }
}

TEST_F(AnLbr, HoldsItsPoseWithTheTorquesThatItsMassesNeed) {
    begin("/hold");
    rig->step(200);
    EXPECT_LT(farthest(lbrStart), ofARest);
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_NEAR(rig->get<double>(axisOf(i), "effort"), lbrWeight[i], ofATorque) << axisOf(i);
        EXPECT_EQ(rig->get<std::int64_t>(axisOf(i), "status"), 1) << "Ready";
    }
    EXPECT_FALSE(rig->get<bool>("/world", "braked"));
    EXPECT_EQ(rig->get<std::int64_t>("/rig", "limitCount"), 0);
    EXPECT_EQ(rig->told(), "");
}

TEST_F(AnLbr, GoesWhereItIsToldAndKeepsUpWithItsDemandOnTheWay) {
    begin("/pose");
    const std::array pose{0.3, 0.5, -0.2, -1.2, 0.2, 1.0, 0.4};
    std::vector<double> places(16);
    std::ranges::copy(pose, places.begin());
    ASSERT_TRUE(rig->set("/pose", "pose", Value{places}));
    rig->send("/pose", "moveTo");
    double most = 0;
    bool moved = false;
    for (int i = 0; i < 1500; ++i) {
        rig->step();
        most = std::max(most, lag());
        moved = moved || rig->get<std::int64_t>(axisOf(0), "status") == 2;
    }
    EXPECT_LT(farthest(pose), 1e-3) << "it settles";
    EXPECT_LT(most, 0.01);
    EXPECT_TRUE(moved);
    EXPECT_EQ(rig->told(), "");
}

TEST_F(AnLbr, SagsWithoutCompensationUntilTheDemandsHaveTheEffort) {
    begin("/hold", {{"gravityCompensation", "false"}});
    rig->step(600);
    const double sagged = rig->position(axisOf(1)) - lbrStart[1];
    EXPECT_GT(sagged, 1e-3) << "its weight draws axis 2 on";

    WorldRig carried{withoutControllers(lbrPlant({{"gravityCompensation", "false"}}))};
    for (std::size_t i = 0; i < 7; ++i) {
        carried.tree().at(demandOf(i)).data<double>("position") = lbrStart[i];
        carried.tree().at(demandOf(i)).data<double>("effort") = lbrWeight[i];
    }
    carried.startUp();
    carried.step(600);
    EXPECT_NEAR(carried.position(axisOf(1)), lbrStart[1], 1e-5);
}

}  // namespace
}  // namespace cortex::physics::test
