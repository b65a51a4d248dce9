// SPDX-License-Identifier: Apache-2.0
// A 2F-85 with its status in a world: a carriage lifts it, a GripperController moves it.
#include "world_rig.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cortex::physics::test {
namespace {

constexpr double ofSlip = 1e-3;  // m

struct AGripper : testing::Test {
    AGripper() { rig.startUp(); }
    double boxHeight() { return rig.array("/boxPose", "position")[2]; }
    // In the frame of the gripper.
    double boxBelow() { return rig.position("/lift/axis") + 0.565 - boxHeight(); }
    double opening() { return rig.position("/gripper/opening"); }
    std::int64_t object() { return rig.get<std::int64_t>("/gripper/status", "object"); }
    double effort() { return rig.get<double>("/gripper/opening", "effort"); }
    CallResult grip(double force) { return rig.call("/grip", "grip", {{"force", force}}); }

    WorldRig rig{liftPlant()};
};

TEST_F(AGripper, SaysAtDemandWhereNothingIsInItsWay) {
    EXPECT_EQ(object(), atDemand);
    ASSERT_TRUE(rig.call("/grip", "moveTo", {{"width", 0.07}}).done());
    EXPECT_NEAR(opening(), 0.07, 5e-4);
    EXPECT_EQ(object(), atDemand);
    rig.send("/grip", "open");
    rig.step(60);
    EXPECT_EQ(object(), 0) << "Moving";
    EXPECT_EQ(rig.told(), "");
}

TEST_F(AGripper, GripsABoxWithItsForceLiftsItAndHoldsItWithTheWorldShutDown) {
    const CallResult gripped = grip(40);
    ASSERT_TRUE(gripped.done()) << gripped.text();
    EXPECT_NEAR(opening(), 0.06, 3e-3) << "what touches gives way a little";
    EXPECT_EQ(object(), stoppedClosing);
    EXPECT_NEAR(std::abs(effort()), 40, 1e-6) << "of each jaw";
    const double below = boxBelow();

    ASSERT_TRUE(rig.moveTo("/lifter", {0.2}).done());
    EXPECT_NEAR(boxHeight(), 0.63, 2e-3);
    EXPECT_NEAR(boxBelow(), below, ofSlip);

    ASSERT_TRUE(rig.call("/world", "shutdown").done());
    rig.step(500);
    EXPECT_NEAR(boxBelow(), below, ofSlip) << "braked";
    EXPECT_NEAR(std::abs(effort()), 40, 1e-6);
    EXPECT_EQ(object(), stoppedClosing);

    rig.send("/world", "startup");
    ASSERT_TRUE(rig.until([&] { return rig.state("/world") == State::Active; })) << rig.told();
    rig.step(300);
    EXPECT_NEAR(boxBelow(), below, ofSlip) << "a demand that was led to the jaws lets nothing go";
    EXPECT_NEAR(std::abs(effort()), 40, 1e-6);

    ASSERT_TRUE(rig.call("/grip", "open").done());
    rig.step(300);
    EXPECT_NEAR(boxHeight(), 0.43, 2e-3) << "it fell onto the table";
    EXPECT_EQ(object(), atDemand);
    EXPECT_EQ(rig.told(), "");
}

TEST(AGripperWithAHeavyBox, LiftsItAsFirmlyAfterItWasBraked) {
    Entries entries = liftPlant();
    at(entries, "/box").settings[1].value = "6";
    WorldRig rig{entries};
    rig.startUp();
    const auto effort = [&] { return std::abs(rig.get<double>("/gripper/opening", "effort")); };
    ASSERT_TRUE(rig.call("/grip", "grip", {{"force", 200.0}}).done());
    ASSERT_TRUE(rig.call("/world", "brake").done());
    rig.step(2000);
    ASSERT_TRUE(rig.call("/world", "release").done());
    ASSERT_TRUE(rig.set("/lifter", "pose", Value{std::vector<double>(16, 0.1)}));
    rig.cluster().send("/lifter", "moveTo", {{"speedShare", 1.0}});
    for (int i = 0; i < 700; ++i) {
        rig.step();
        ASSERT_NEAR(effort(), 200, 1e-6) << "nobody has asked for less";
    }
}

TEST_F(AGripper, HoldsOnWhileItsControllerIsAtRest) {
    ASSERT_TRUE(grip(40).done());
    rig.send("/grip", "shutdown");
    rig.step(300);
    EXPECT_NEAR(std::abs(effort()), 40, 1e-6) << "a demand at rest asks for no force";
    rig.send("/grip", "startup");
    rig.step(300);
    EXPECT_NEAR(std::abs(effort()), 40, 1e-6) << "nor does a controller that has just begun";
    EXPECT_EQ(object(), stoppedClosing);
    EXPECT_TRUE(grip(60).done());
    EXPECT_NEAR(std::abs(effort()), 60, 1e-6);
}

TEST_F(AGripper, IsSaidToHoldWhatItHoldsByItsBrake) {
    ASSERT_TRUE(grip(40).done());
    rig.send("/world", "shutdown");
    for (int cycle = 0; cycle < 500; ++cycle) {
        rig.step(1);
        ASSERT_EQ(rig.get<std::int64_t>("/grip", "object"), stoppedClosing) << cycle;
    }
    EXPECT_EQ(rig.told(), "");
}

TEST(AGripperAndABox, ThatIsSlipperyStaysOnTheTable) {
    Entries entries = liftPlant();
    at(entries, "/box").settings.push_back({"friction", "0.02", {}});
    WorldRig rig{entries};
    rig.startUp();
    ASSERT_TRUE(rig.call("/grip", "grip", {{"force", 40.0}}).done());
    ASSERT_TRUE(rig.moveTo("/lifter", {0.1}).done());
    EXPECT_NEAR(rig.array("/boxPose", "position")[2], 0.43, 5e-3);
}

TEST(AGripperThatNoArmCarries, IsToldOfAtEachStartup) {
    Entries entries = liftPlant();
    std::erase_if(at(entries, "/world").relates,
                  [](const auto& each) { return each.rule == "arms"; });
    WorldRig rig{entries};
    rig.startUp();
    EXPECT_EQ(rig.told(),
              "/gripper stands at the origin of the world, as no Arm under arms carries it; relate "
              "one, or give an originPosition\n");
}

TEST_F(AGripper, UsesItsLeastForceWhereLessIsDemanded) {
    ASSERT_TRUE(grip(0).done());
    EXPECT_NEAR(std::abs(effort()), 20, 1e-6);
}

}  // namespace
}  // namespace cortex::physics::test
