// SPDX-License-Identifier: Apache-2.0
// What a gripper that limits its force makes of its demand, beside any physics: the test says where
// the jaws are.
#include "cortex/cs/testing.hpp"
#include "cortex/toolkit/classes.hpp"

#include "world_gripper.hpp"
#include "world_plants.hpp"

#include <chrono>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

namespace cortex::physics::test {
namespace {

constexpr double piece = 0.06, pressing = 40, restTime = 0.06;  // m, N, s

// In the place of a world: a gripper needs the status that it writes.
class OnlyAGripper final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;
    std::optional<WorldGripper> grip;

private:
    void populate() override {
        grip.emplace(outputs("statuses")[0], 0.085);
        for (const char* command : {"brake", "release", "reset"})
            on<&OnlyAGripper::ignore>(command);
    }
    Outcome ignore(Call& /*call*/) { return Outcome::Done; }
};

// Jaws that press on a work piece, with a demand far beyond it.
struct PressingJaws : testing::Test {
    PressingJaws() {
        toolkit::addClasses(plant.classes());
        plant.classes().add<OnlyAGripper>("MujocoWorld");
        for (auto& each : withoutControllers(liftPlant())) plant.add(std::move(each));
        plant.start();
        grip = &*dynamic_cast<OnlyAGripper&>(plant.tree().at("/world")).grip;
        demand(0);
        stand(piece);
    }
    void demand(double opening, double newtons = pressing) {
        grip->follow({opening, 0, newtons, false}, true, {at, 0, 0, 0});
    }
    void stand(double opening) {
        at = opening;
        grip->show({at, 0, 0, 0}, 0);
        grip->show({at, 0, 0, 0}, restTime);
    }
    double aim() const { return grip->demand(false).position; }
    double use() const { return grip->demand(false).effort; }

    cs::TestPlant plant{worldModel(), std::chrono::milliseconds{1}, "rig"};
    WorldGripper* grip = nullptr;
    double at = piece;
};

TEST_F(PressingJaws, KeepTheirGripWhileTheirDemandIsLedBackToThem) {
    for (double led = 0.0592; led <= piece; led += 1e-4) demand(led, 0);
    EXPECT_EQ(aim(), 0);
    EXPECT_EQ(use(), pressing);
}

TEST_F(PressingJaws, KeepItTooWhereTheyMoveALittleAfterThat) {
    demand(piece, 0);
    at = piece + 3e-4;
    grip->show({at, 0, 0, 0}, 1e-3);
    ASSERT_EQ(plant.tree().at("/gripper/status").data<const std::int64_t>("object"), 0) << "Moving";
    demand(piece, 0);
    EXPECT_EQ(aim(), 0);
    EXPECT_EQ(use(), pressing);
}

TEST_F(PressingJaws, LetGoOnceTheirDemandMovesAway) {
    demand(piece, 0);
    demand(piece + 1e-4, 0);
    EXPECT_EQ(aim(), 0) << "not yet";
    demand(piece + 3e-4, 0);
    EXPECT_EQ(aim(), piece + 3e-4) << "without a jump";
}

TEST_F(PressingJaws, GripAnewWithoutLessForceOnTheWay) {
    demand(piece, 0);
    demand(piece - 1.5e-3, 60);
    EXPECT_EQ(aim(), 0) << "a demand so near would mean less";
    EXPECT_EQ(use(), pressing);
    demand(piece - 2.5e-3, 60);
    EXPECT_EQ(aim(), piece - 2.5e-3);
    EXPECT_EQ(use(), 60);
}

}  // namespace
}  // namespace cortex::physics::test
