// SPDX-License-Identifier: Apache-2.0
// The example of three tanks in a ring, stepped by hand: both agents' parts in one.
#include "cortex/cs/testing.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace std::chrono_literals;

class WaterPlant : public testing::Test, protected cs::TestPlant {
protected:
    WaterPlant() : TestPlant{{CORTEX_SOURCE_DIR "/examples/water/water.xml"}, 10ms} {
        loadPlugin(CORTEX_WATER_PLUGIN);
        start();
        startUp();
    }

    void runSeconds(std::int64_t seconds) { step(seconds * 100); }
    double level(const std::string& tank) { return value("/tanks/" + tank, "level"); }
    double value(const std::string& path, const std::string& item) {
        return get<double>(path, item);
    }
};

TEST_F(WaterPlant, LevelsSettleWhereTheyAreWanted) {
    runSeconds(200);

    EXPECT_NEAR(level("1"), 0.6, 0.001);
    EXPECT_NEAR(level("2"), 0.5, 0.001);
    EXPECT_NEAR(level("3"), 0.4, 0.001);
}

TEST_F(WaterPlant, WaterIsNeitherMadeNorLost) {
    for (int second = 0; second < 200; ++second) {
        runSeconds(1);
        ASSERT_NEAR(value("/ring", "volume"), 0.15, 1e-9) << "after " << second + 1 << " s";
        ASSERT_NEAR(level("1") + level("2") + level("3"), 1.5, 1e-8);
    }
}

// What is no item of a class and not in its keep() would be lost.
TEST_F(WaterPlant, TheControllersKeepTheirIntegralPart) {
    runSeconds(20);
    const Saved before = save();
    ASSERT_FALSE(before.kept.at("/levels/1").empty());
    runSeconds(10);
    ASSERT_NE(save().kept, before.kept);

    restore(before);

    EXPECT_EQ(save(), before);
}

TEST_F(WaterPlant, WithoutTheSupervisorPumpsAreSafeAndTheValvesLevelTheTanks) {
    runSeconds(200);
    ASSERT_GT(std::abs(value("/pumps/1", "flow")), 0.0001);

    cluster().send("/supervisor", "shutdown", {});
    runSeconds(2);
    for (const char* pump : {"/pumps/1", "/pumps/2", "/pumps/3"})
        EXPECT_EQ(value(pump, "flow"), 0) << pump;
    runSeconds(600);

    EXPECT_NEAR(level("1"), 0.5, 0.01);
    EXPECT_NEAR(level("3"), 0.5, 0.01);
}

}  // namespace
}  // namespace cortex::test
