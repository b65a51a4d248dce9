// SPDX-License-Identifier: Apache-2.0
#include "physics/model_scene.hpp"

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

namespace cortex::physics::test {
namespace {

// A box falls beside an LBR that moves, in a folder of its own.
class PhysicsInTrouble : public testing::Test {
protected:
    PhysicsInTrouble() {
        std::filesystem::create_directories(folder_);
        std::filesystem::current_path(folder_);
        scene_.bodies = {fixedBox("/table", {0.5, 0.5, 0.1}, {2, 0, 0}),
                         freeBody("/box", Body::Shape::Box, {0.1, 0.1, 0.1}, 1, {2, 0, 0.12})};
    }
    ~PhysicsInTrouble() override {
        mjcb_control = nullptr;
        EXPECT_TRUE(std::filesystem::is_empty(folder_)) << "MuJoCo wrote a file";
        std::filesystem::current_path(outside_);
        std::filesystem::remove_all(folder_);
    }

    // The step has this trouble, and all is where it was before, at rest; then it goes on.
    static void expectTrouble(Physics& physics, const std::vector<JointDemand>& demands,
                              Trouble trouble, const std::string& words) {
        const std::vector<double> before = stateOf(physics);
        const Triple place = physics.body(0).position;
        ASSERT_NE(physics.body(0).linearVelocity, Triple{}) << "nothing moved, so it shows nothing";
        EXPECT_EQ(physics.step(0.001, 1, demands, {}), trouble);
        EXPECT_NE(std::string{physics.why()}.find(words), std::string::npos) << physics.why();
        for (std::size_t i = 0; i < physics.joints(); ++i) {
            EXPECT_EQ(physics.joint(i).position, before[4 * i]) << "joint " << i;
            EXPECT_EQ(physics.joint(i).velocity, 0);
            EXPECT_EQ(physics.joint(i).acceleration, 0);
            EXPECT_EQ(physics.joint(i).effort, 0);
        }
        EXPECT_EQ(physics.body(0).position, place);
        EXPECT_EQ(physics.body(0).linearVelocity, Triple{});
    }
    static void expectGoesOn(Physics& physics) {
        for (int i = 0; i < 5; ++i)
            ASSERT_EQ(physics.step(0.001, 1, staying(physics, true), {}), Trouble::None);
        EXPECT_LT(physics.body(0).linearVelocity[2], 0) << "it falls on";
        EXPECT_NEAR(physics.joint(1).effort, -52.77, 0.1);
    }
    static Physics falling(const Scene& scene) {
        Physics physics{scene};
        for (int i = 0; i < 10; ++i)
            EXPECT_EQ(physics.step(0.001, 1, staying(physics, true), {}), Trouble::None);
        return physics;
    }

    Scene scene_{.arms = {shippedLbr()}, .contactLimit = 10};

private:
    std::filesystem::path outside_ = std::filesystem::current_path();
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("cortex-physics-" + std::to_string(::getpid()));
};

TEST_F(PhysicsInTrouble, DivergesByADemandThatIsNoNumber) {
    Physics physics = falling(scene_);
    std::vector<JointDemand> demands = staying(physics, false);
    demands[3].effort = std::numeric_limits<double>::quiet_NaN();
    testing::internal::CaptureStderr();
    expectTrouble(physics, demands, Trouble::Diverged, "demand of '/lbr/4'");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    expectGoesOn(physics);
}

TEST_F(PhysicsInTrouble, DivergesByAnEffortBeyondAllMeasure) {
    scene_.arms[0].joints[6].effort = Joint::unlimited;
    Physics physics = falling(scene_);
    std::vector<JointDemand> demands = staying(physics, false);
    demands[6].effort = 5e9;  // of some 0.1 kg.m2
    expectTrouble(physics, demands, Trouble::Diverged, "acceleration of '/lbr/7'");
    expectGoesOn(physics);
}

TEST_F(PhysicsInTrouble, HasMoreContactsThanItMay) {
    scene_.contactLimit = 2;
    Physics physics = falling(scene_);
    const std::vector<JointDemand> demands = staying(physics, true);
    Trouble trouble = Trouble::None;
    for (int i = 0; i < 200 && trouble == Trouble::None; ++i) {
        trouble = physics.step(0.001, 1, demands, {});
    }
    EXPECT_EQ(trouble, Trouble::TooManyContacts);
    EXPECT_NE(std::string{physics.why()}.find("raise it"), std::string::npos) << physics.why();
    EXPECT_EQ(physics.body(0).linearVelocity, Triple{});
    EXPECT_NEAR(physics.body(0).position[2], 0.1, 2e-3);
    EXPECT_LE(physics.contacts(), 2);
}

TEST_F(PhysicsInTrouble, LivesOnAfterAnErrorOfTheLibrary) {
    Physics physics = falling(scene_);
    const std::vector<JointDemand> demands = staying(physics, true);
    mjcb_control = [](const mjModel*, mjData* data) {
        mj_stackAlloc(data, data->nstack - data->pstack - 1);  // it leaves this on the stack
        mju_error("it cannot go on");
    };
    expectTrouble(physics, demands, Trouble::Error, "it cannot go on");
    mjcb_control = nullptr;
    for (int i = 0; i < 5; ++i)
        ASSERT_EQ(physics.step(0.001, 1, demands, {}), Trouble::None) << physics.why();
    expectGoesOn(physics);
}

TEST_F(PhysicsInTrouble, TellsOfAnErrorInTheMiddleOfACycleAndTakesAllOfItBack) {
    Physics physics = falling(scene_);
    const std::vector<JointDemand> demands = staying(physics, true);
    const double height = physics.body(0).position[2];
    static int calls = 0;
    calls = 0;
    mjcb_control = [](const mjModel*, mjData*) {
        if (++calls == 4) mju_error("not now");
    };
    EXPECT_EQ(physics.step(0.004, 4, demands, {}), Trouble::Error);
    EXPECT_EQ(calls, 4);
    EXPECT_EQ(physics.body(0).position[2], height);
}

TEST_F(PhysicsInTrouble, ForgetsItsTroubleByReset) {
    Physics physics = falling(scene_);
    const std::vector<double> first = stateOf(Physics{scene_});
    std::vector<JointDemand> demands = staying(physics, false);
    demands[3].position = std::numeric_limits<double>::infinity();
    demands[3].velocity = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(physics.step(0.001, 1, demands, {}), Trouble::Diverged);
    EXPECT_NE(std::string{physics.why()}.find("demand of '/lbr/4'"), std::string::npos)
        << physics.why();
    physics.reset();
    EXPECT_EQ(stateOf(physics), first);
    Physics other{scene_};
    for (int i = 0; i < 100; ++i) {
        ASSERT_EQ(physics.step(0.001, 1, staying(physics, true), {}), Trouble::None);
        ASSERT_EQ(other.step(0.001, 1, staying(other, true), {}), Trouble::None);
    }
    EXPECT_EQ(stateOf(physics), stateOf(other));
}

// The demand that failed is no demand that a brake holds on to.
TEST_F(PhysicsInTrouble, KeepsTheGripOfBefore) {
    Physics physics{liftWith(shippedGripper())};
    std::vector<JointDemand> demands = staying(physics, false);
    demands[1].effort = 30;
    ASSERT_EQ(physics.step(0.001, 1, demands, {}), Trouble::None);
    demands[1].position = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(physics.step(0.001, 1, demands, {}), Trouble::Diverged);
    EXPECT_NE(std::string{physics.why()}.find("'/gripper/opening'"), std::string::npos);
    for (int i = 0; i < 100; ++i)
        ASSERT_EQ(physics.step(0.001, 1, staying(physics, true), {}), Trouble::None);
    EXPECT_NEAR(physics.joint(1).position, 0.085, 1e-4);
}

TEST_F(PhysicsInTrouble, DoesNothingInNoTime) {
    Physics physics = falling(scene_);
    const std::vector<double> before = stateOf(physics);
    for (const double seconds : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_EQ(physics.step(seconds, 1, staying(physics, true), {}), Trouble::None);
    EXPECT_EQ(physics.step(0.001, 0, staying(physics, true), {}), Trouble::None);
    EXPECT_EQ(stateOf(physics), before);
}

}  // namespace
}  // namespace cortex::physics::test
