// SPDX-License-Identifier: Apache-2.0
// The tick is sacred for the class of the plug-in cortex-mujoco, too: in each of its states, with
// some 30 points of contact, and where MuJoCo has no room for them.
#include "cortex/toolkit/classes.hpp"

#include "physics/world_plants.hpp"
#include "realtime/watched_cluster.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using physics::test::at;
using physics::test::Entries;
using physics::test::entry;
using physics::test::liftPlant;
using physics::test::withoutControllers;
using physics::test::worldModel;
using physics::test::operator+;

// Boxes that lie on the table beside the one that is gripped: four points of contact each.
Entries crowdedPlant(const std::string& contactLimit) {
    Entries entries = withoutControllers(liftPlant());
    auto& world = at(entries, "/world");
    world.settings.push_back({"contactLimit", contactLimit, {}});
    world.relates.push_back({"safety", "/safety", false, false, {}});
    std::erase_if(world.relates, [](const auto& each) { return each.rule == "bodyPoses"; });
    Entries boxes;
    for (int i = 0; i < 7; ++i) {
        const std::string path = "/boxes/" + std::to_string(i);
        boxes.push_back(entry(path, "SceneBody", {},
                              {{"size", "0.05 0.05 0.05"},
                               {"mass", "0.1"},
                               {"position", std::to_string(-0.3 + 0.1 * i) + " 0.3 0.426"}}));
        world.relates.push_back({"bodies", path, false, false, {}});
        boxes.push_back(entry("/poses/" + std::to_string(i), "CartesianObservation"));
    }
    world.relates.push_back({"bodyPoses", "/boxPose", false, false, {}});
    for (int i = 0; i < 7; ++i)
        world.relates.push_back({"bodyPoses", "/poses/" + std::to_string(i), false, false, {}});
    return entries + boxes +
           Entries{entry("/safety", "SafetyStatus"),
                   entry("/panel", "SimulatedSafetyPanel", {{"status", "/safety"}})};
}

// Watched from its first cycle on; a cycle takes three steps of the physics.
class WatchedWorld : public cs::TestPlant {
public:
    explicit WatchedWorld(const Entries& entries)
        : TestPlant{worldModel(), std::chrono::milliseconds{3}, "rig"} {
        toolkit::addClasses(classes());
        loadPlugin(CORTEX_MUJOCO_PLUGIN);
        for (const SystemDescription::SimplexEntry& each : entries) add(each);
        checker().watch(cluster());
        start();
        write("/gripper/demand", "position", 0.085);
    }
    void write(const std::string& path, const char* item, double value) {
        tree().at(path).data<double>(item) = value;
    }
    void see(int cycles) {
        for (int i = 0; i < cycles; ++i) {
            step();
            seen.insert(state("/world"));
            most = std::max(most, get<std::int64_t>("/world", "contacts"));
        }
    }
    void order(const std::string& path, const std::string& command, int cycles = 20) {
        cluster().send(path, command);
        see(cycles);
    }
    // The gripper closes on its box, the carriage goes up and down, and the demands come back.
    void work() {
        for (int i = 0; i <= 300; ++i) {
            const double turn = 2 * 3.141592653589793 * i / 300;
            write("/gripper/demand", "position", 0.06 + 0.025 * std::cos(turn));
            write("/gripper/demand", "effort", 30);
            write("/lift/demand", "position", 0.03 * (1 - std::cos(turn)));
            see(1);
        }
        see(100);
    }

    std::set<State> seen;
    std::int64_t most = 0;  // points of contact
};

void goThroughAll(WatchedWorld& world) {
    world.order("/panel", "startup");
    world.write("/lift/demand", "position", 0.1);
    world.order("/world", "startup", 400);  // it waits, and tells so
    world.write("/lift/demand", "position", 0);
    world.see(20);
    world.work();
    world.order("/world", "brake");
    world.order("/world", "release");
    world.tree().at("/lift/demand").slot().quality = Quality::Lost;
    world.see(20);
    world.tree().at("/lift/demand").slot().quality = Quality::Good;
    world.see(20);
    world.order("/panel", "press");
    world.order("/panel", "release");
    world.order("/panel", "reset");
    world.order("/world", "reset");
    world.order("/world", "clearFaults");
    world.order("/world", "startup", 100);
    world.order("/world", "shutdown");
    world.order("/world", "reset");
}

TEST(TheWorldOfMujoco, NeitherAllocatesNorLocksNorCallsTheSystemInAnyState) {
    checker().reset();
    WatchedWorld world{crowdedPlant("500")};
    goThroughAll(world);  // what runs for the first time may meet a page of code
    const std::uint64_t faults = checker().counts().pageFaults;

    goThroughAll(world);

    EXPECT_EQ(violations(), "");
    EXPECT_EQ(checker().counts().pageFaults, faults);
    EXPECT_GE(world.most, 30);
    using enum State;
    for (const State each : {Standby, StartingUp, Active, ShuttingDown, Fault})
        EXPECT_TRUE(world.seen.contains(each)) << name(each);
}

TEST(TheWorldOfMujoco, IsAsGoodWhereItHasMoreContactsThanRoom) {
    checker().reset();
    WatchedWorld world{crowdedPlant("20")};
    std::uint64_t faults = 0;
    for (int round = 0; round < 3; ++round) {
        if (round == 1) faults = checker().counts().pageFaults;
        world.see(200);
        world.order("/world", "reset");
        world.order("/world", "clearFaults");
    }

    EXPECT_EQ(violations(), "");
    EXPECT_EQ(checker().counts().pageFaults, faults);
    EXPECT_TRUE(world.seen.contains(State::Fault));
}

TEST(MujocoClassesThatAreWatched, AreAllThatThePluginHas) {
    cs::TestPlant plant{worldModel()};
    plant.loadPlugin(CORTEX_MUJOCO_PLUGIN);
    EXPECT_EQ(plant.classes().names(), std::vector<std::string>{"MujocoWorld"});
}

}  // namespace
}  // namespace cortex::test
