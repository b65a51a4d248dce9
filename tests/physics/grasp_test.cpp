// SPDX-License-Identifier: Apache-2.0
#include "physics/model_scene.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace cortex::physics::test {
namespace {

constexpr std::size_t liftPlace = 0, openingPlace = 1;

// A lift with a 2F-85 about a thing on a table.
class Grasp {
public:
    Grasp(Body::Shape shape, double mass, double force) : physics_{scene(shape, mass)} {
        demands_ = staying(physics_, false);
        demands_[openingPlace].effort = force;
    }

    // At 0.15 m/s.
    void close() {
        for (double aim = 0.085; aim > 0; aim -= 0.00015) {
            demands_[openingPlace].position = aim;
            demands_[openingPlace].velocity = -0.15;
            run(1);
        }
        demands_[openingPlace].position = demands_[openingPlace].velocity = 0;
        run(200);
    }
    void run(int cycles) {
        for (int i = 0; i < cycles; ++i)
            ASSERT_EQ(physics_.step(0.001, 1, demands_, {}), Trouble::None) << physics_.why();
    }
    // By 0.2 m, in two seconds; it pushes with 1.025 times the weight at most.
    void raise() {
        const double from = demands_[liftPlace].position;
        for (int i = 0; i < 2000; ++i) {
            const double phase = std::numbers::pi * i / 2000;
            demands_[liftPlace].position = from + 0.1 * (1 - std::cos(phase));
            demands_[liftPlace].velocity = 0.05 * std::numbers::pi * std::sin(phase);
            run(1);
        }
        demands_[liftPlace] = {.position = from + 0.2, .braked = false};
    }
    // Where the thing is below the lift.
    double hanging() const {
        return physics_.body(0).position[2] - physics_.joint(liftPlace).position;
    }
    void brake() {
        for (JointDemand& demand : demands_) demand = {.position = 0.05, .braked = true};
        demands_[liftPlace].position = physics_.joint(liftPlace).position;
    }
    Physics& physics() { return physics_; }

private:
    static Scene scene(Body::Shape shape, double mass) {
        Scene scene = liftWith(shippedGripper());
        // The jaws end 0.1525 m below the lift's frame, at 0.3475.
        scene.bodies = {fixedBox("/table", {0.4, 0.4, 0.1}, {0, 0, 0.29}),
                        freeBody("/thing", shape, {0.06, 0.06, 0.05}, mass, {0, 0, 0.365})};
        return scene;
    }

    Physics physics_;
    std::vector<JointDemand> demands_;
};

class GraspOf : public testing::TestWithParam<Body::Shape> {};
INSTANTIATE_TEST_SUITE_P(Things, GraspOf, testing::Values(Body::Shape::Box, Body::Shape::Cylinder));

TEST_P(GraspOf, LiftsThreeHundredGramsWhichSlipByLessThanAMillimetre) {
    Grasp grasp{GetParam(), 0.3, 30};
    grasp.close();
    EXPECT_NEAR(grasp.physics().joint(openingPlace).position, 0.06, 1e-3) << "what touches gives "
                                                                             "way a little";
    const double before = grasp.hanging();
    grasp.raise();
    grasp.run(5000);
    EXPECT_GT(grasp.physics().body(0).position[2], 0.56);
    EXPECT_NEAR(grasp.hanging(), before, 1e-3);
}

TEST_P(GraspOf, IsHeldByABrakedGripperThatIsToldAnotherPosition) {
    Grasp grasp{GetParam(), 0.3, 30};
    grasp.close();
    grasp.raise();
    const double before = grasp.hanging();
    grasp.brake();
    grasp.run(1000);
    EXPECT_NEAR(grasp.hanging(), before, 1e-3);
    EXPECT_NEAR(grasp.physics().joint(openingPlace).effort, -30, 1e-9);
}

// Friction of two jaws carries twice their force, as its coefficient is 1: less stays, more falls.
class GripOf : public testing::TestWithParam<double> {
protected:
    double heaviest() const { return 2 * GetParam() / 9.80665; }
};
INSTANTIATE_TEST_SUITE_P(Forces, GripOf, testing::Values(30, 235));

TEST_P(GripOf, CarriesWhatItsForceCanCarry) {
    Grasp grasp{Body::Shape::Box, 0.93 * heaviest(), GetParam()};
    grasp.close();
    EXPECT_NEAR(grasp.physics().joint(openingPlace).effort, -GetParam(), 1e-9);
    const double before = grasp.hanging();
    grasp.raise();
    EXPECT_NEAR(grasp.hanging(), before, 0.01);
}

TEST_P(GripOf, LosesWhatIsHeavier) {
    Grasp grasp{Body::Shape::Box, 1.05 * heaviest(), GetParam()};
    grasp.close();
    const double before = grasp.hanging();
    grasp.raise();
    grasp.run(500);
    EXPECT_LT(grasp.hanging(), before - 0.05);
}

TEST(GripForce, IsAtLeastTheLeastAndAtMostTheGreatest) {
    for (const auto& [asked, expected] : {std::pair{0.0, 20.0}, {5, 20}, {100, 100}, {500, 235}}) {
        Grasp grasp{Body::Shape::Box, 0.3, asked};
        grasp.close();
        EXPECT_NEAR(grasp.physics().joint(openingPlace).effort, -expected, 1e-9) << asked;
    }
}

TEST(GripForce, IsSmallWhereTheJawsAreAtTheirDemand) {
    Grasp grasp{Body::Shape::Box, 0.3, 235};
    grasp.run(500);
    EXPECT_NEAR(grasp.physics().joint(openingPlace).position, 0.085, 1e-4);
    EXPECT_LT(std::abs(grasp.physics().joint(openingPlace).effort), 5);
}

// Then the effort of its demand is like that of any axis: it is added.
TEST(GripperWithoutAStatus, GoesWhereItIsToldAndPushesAsTold) {
    Gripper gripper = shippedGripper();
    gripper.limitsForce = false;
    Physics physics{liftWith(gripper)};
    std::vector<JointDemand> demands = staying(physics, false);
    demands[openingPlace].position = 0.03;
    for (int i = 0; i < 500; ++i) ASSERT_EQ(physics.step(0.001, 1, demands, {}), Trouble::None);
    EXPECT_NEAR(physics.joint(openingPlace).position, 0.03, 1e-6);
    EXPECT_NEAR(physics.joint(openingPlace).effort, 0, 1e-3);

    demands[openingPlace].effort = 10;
    for (int i = 0; i < 500; ++i) ASSERT_EQ(physics.step(0.001, 1, demands, {}), Trouble::None);
    const double stiffness = 0.55 * std::pow(2 * std::numbers::pi * 12, 2);
    EXPECT_NEAR(physics.joint(openingPlace).position, 0.03 + 10 / stiffness, 1e-6);
}

TEST(GripperWithoutAStatus, FollowsWithoutLag) {
    Gripper gripper = shippedGripper();
    gripper.limitsForce = false;
    Physics physics{liftWith(gripper)};
    std::vector<JointDemand> demands = staying(physics, false);
    demands[openingPlace].velocity = -0.1;
    for (int i = 0; i < 500; ++i) {
        ASSERT_EQ(physics.step(0.001, 1, demands, {}), Trouble::None);
        demands[openingPlace].position -= 0.0001;
    }
    EXPECT_NEAR(physics.joint(openingPlace).position, demands[openingPlace].position, 2e-5);
    EXPECT_NEAR(physics.joint(openingPlace).velocity, -0.1, 1e-4);
}

TEST(GripperOfItsOwn, StandsInTheWorldAtItsOrigin) {
    Gripper gripper = shippedGripper();
    gripper.opening.origin = {1, 0, 0.5};
    gripper.opening.originRotation = {std::numbers::pi, 0, std::numbers::pi / 2};
    const Body thing = freeBody("/thing", Body::Shape::Box, {0.06, 0.06, 0.06}, 0.3, {1, 0, 0.37});
    Physics physics{{.grippers = {gripper}, .bodies = {thing}, .contactLimit = 60}};
    std::vector<JointDemand> demands{{.position = 0, .effort = 30, .braked = false}};
    for (int i = 0; i < 2000; ++i) ASSERT_EQ(physics.step(0.001, 1, demands, {}), Trouble::None);
    EXPECT_NEAR(physics.joint(0).position, 0.06, 1e-3);
    EXPECT_GT(physics.body(0).position[2], 0.2) << "it was caught in its fall";
    EXPECT_NEAR(physics.body(0).linearVelocity[2], 0, 1e-3);
}

}  // namespace
}  // namespace cortex::physics::test
