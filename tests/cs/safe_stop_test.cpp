// SPDX-License-Identifier: Apache-2.0
// A stop goes on until demands have reached their safe values.
#include "support/safe_plant.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

// Away from what is observed, so that the position has 0.55 rad to go at 2 rad/s.
void away(SafePlant& plant) {
    plant.start();
    plant.startUp();
    plant.position = 0.8;
    plant.cluster.step(300);
}

TEST(SafeStop, WaitsForADemandThatIsOnItsWay) {
    for (const bool shared : {false, true}) {
        SafePlant plant{shared};
        away(plant);

        EXPECT_TRUE(plant.cluster.cluster->stop());

        EXPECT_EQ(plant.seen.back().position, 0.25) << shared;
        EXPECT_EQ(plant.cluster.cluster->notShutDown(), std::vector<std::string>{});
    }
}

TEST(SafeStop, WaitsForTheDemandOfOneInFaultToo) {
    SafePlant plant;
    away(plant);
    plant.faults = true;
    plant.cluster.step();

    EXPECT_TRUE(plant.cluster.cluster->stop());

    EXPECT_EQ(plant.seen.back().position, 0.25);
}

TEST(SafeStop, WaitsWhereTheWriterRunsSeldomToo) {
    SafePlant plant;
    plant.controller.runEvery(10, 3);
    away(plant);

    EXPECT_TRUE(plant.cluster.cluster->stop());

    EXPECT_EQ(plant.seen.back().position, 0.25);
}

TEST(SafeStop, NamesTheDemandThatDidNotArriveWithinTheStopTimeout) {
    SafePlant plant{false, "guarded", {.stopTimeout = 0.1}};
    away(plant);

    EXPECT_FALSE(plant.cluster.cluster->stop());

    const std::vector<std::string> lines = plant.cluster.cluster->notShutDown();
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines.front().starts_with("/d: position is 0.")) << lines.front();
    const std::string text =
        " rad, its safe value 0.25 was not reached within the stopTimeout of 0.1 s";
    EXPECT_TRUE(lines.front().ends_with(text)) << lines.front();
    EXPECT_TRUE(plant.cluster.hasEvent(lines.front()));
}

TEST(SafeStop, TakesNoLongerWhereNoDemandIsOnItsWay) {
    SafePlant plant;
    plant.start();
    plant.startUp();
    const auto before = plant.cluster.cluster->image().cycle();

    EXPECT_TRUE(plant.cluster.cluster->stop());

    EXPECT_LE(plant.cluster.cluster->image().cycle() - before, 6);
}

}  // namespace

}  // namespace cortex::test
