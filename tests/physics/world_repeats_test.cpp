// SPDX-License-Identifier: Apache-2.0
// The same worlds again, on more threads, and from a state that was saved: bit for bit the same.
#include "cortex/core/error.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/core/value.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include "world_rig.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

namespace cortex::physics::test {
namespace {

constexpr std::int64_t gripsUntil = 150, runUp = 320, goesOn = 100;  // cycles

// Two worlds: with an LBR, and with a carriage and a gripper.
Entries twoWorlds() {
    Entries arm = lbrPlant();
    at(arm, "/world").path = "/lbrWorld";
    return withoutControllers(std::move(arm) + liftPlant());
}

void write(SimplexTree& tree, const std::string& path, const char* item, double value) {
    tree.at(path).data<double>(item) = value;
}

// The gripper closes on the box, and is lifted and lowered; another past has other forces and ways.
void feedLift(SimplexTree& tree, std::int64_t cycle, double past) {
    const double closed = std::min(1.0, static_cast<double>(cycle) / gripsUntil);
    write(tree, "/gripper/demand", "position", 0.085 - 0.05 * closed);
    write(tree, "/gripper/demand", "effort", 40 * (cycle < runUp ? past : 1));
    const double angle = std::max(0.0, static_cast<double>(cycle - gripsUntil) * 0.01);
    write(tree, "/lift/demand", "position",
          0.05 * (1 - std::cos(angle)) * (cycle < runUp ? past : 1));
    write(tree, "/lift/demand", "velocity", 0.5 * std::sin(angle) * (cycle < runUp ? past : 1));
}

void feedLbr(SimplexTree& tree, std::int64_t cycle) {
    for (std::size_t i = 0; i < lbrStart.size(); ++i)
        write(tree, "/lbr/demands/" + std::to_string(i + 1), "position",
              lbrStart[i] + 0.1 * (1 - std::cos(static_cast<double>(cycle) * 0.005)));
}

// All that the worlds tell in the end, on so many threads.
std::string toldOnThreads(std::uint32_t threads) {
    ClassRegistry classes;
    addWorldClasses(classes);
    SimplexTree tree = SimplexTree::load(worldModel(), &classes);
    cs::ClusterCS cluster{"rig", {.threads = threads}};
    cs::ClusterTesting::set(cluster, {.forceThreads = true, .chunkSize = 1});
    SystemDescription system;
    system.simplexes = twoWorlds();
    Report report;
    tree.add(system, &classes, report);
    if (!report.ok()) throw ModelError(std::move(report));
    cluster.addSimplexTree(tree);
    cluster.useClasses(classes);
    auto& trigger = cluster.setTriggerSource<cs::ManualTrigger>(std::chrono::milliseconds{1});
    cluster.start();
    cluster.send("/rig", "startup", {{"prefix", std::string{"/"}}});
    for (std::int64_t cycle = 1; cycle <= runUp; ++cycle) {
        feedLift(tree, cycle, 1);
        feedLbr(tree, cycle);
        trigger.step();
    }
    std::string told;
    const Image image = cluster.image();
    const auto add = [&](const std::string& path, const char* item) {
        told += path + "." + item + " " + toText(image.value(path, item)) + "\n";
    };
    for (int i = 1; i <= 7; ++i) add("/lbr/axes/" + std::to_string(i), "effort");
    for (const char* item : {"position", "velocity", "acceleration", "effort", "status"}) {
        add("/lift/axis", item);
        add("/gripper/opening", item);
    }
    for (const char* item : {"position", "rotation", "linearVelocity"}) add("/boxPose", item);
    for (const char* world : {"/world", "/lbrWorld"}) add(world, "energy");
    add("/gripper/status", "object");
    cluster.stop();
    return told;
}

TEST(AWorldThatRunsAgain, TellsTheSameBitsOnOneTwoAndFourThreads) {
    const std::string one = toldOnThreads(1);
    EXPECT_NE(one.find("/gripper/status.object 2"), std::string::npos) << "it holds: " << one;
    EXPECT_EQ(toldOnThreads(1), one);
    EXPECT_EQ(toldOnThreads(2), one);
    EXPECT_EQ(toldOnThreads(4), one);
}

// What happens to a world a while before its state is saved.
struct Moment {
    const char* name;
    std::function<void(WorldRig&)> happens;
    State state;
    int other;  // what happens to the one that goes on as it does; in the same state

    friend void PrintTo(const Moment& each, std::ostream* out) { *out << each.name; }
};

void loseDemand(WorldRig& rig) {
    rig.tree().at("/lift/demand").slot().quality = Quality::Lost;
    rig.step();
    rig.tree().at("/lift/demand").slot().quality = Quality::Good;
}

const std::vector<Moment> moments{
    {"Active", [](WorldRig&) {}, State::Active, 1},
    {"BrakedByCommand", [](WorldRig& rig) { rig.send("/world", "brake"); }, State::Active, 0},
    {"BrakedByALoss", loseDemand, State::Active, 0},
    {"InStandby", [](WorldRig& rig) { rig.send("/world", "shutdown"); }, State::Standby, 3},
};

const Moment& otherThan(const Moment& moment) {
    return moments[static_cast<std::size_t>(moment.other)];
}

class WorldWithAPast {
public:
    WorldWithAPast(const Moment& moment, double past) {
        rig.send("/world", "startup");
        runTo(runUp - 60, past);
        moment.happens(rig);
        runTo(runUp, past);
        EXPECT_EQ(rig.state("/world"), moment.state);
    }
    std::string goesOnOtherwiseThan(WorldWithAPast& other) {
        std::string text;
        for (const std::int64_t last : {runUp + 1, runUp + goesOn / 2, runUp + goesOn}) {
            runTo(last, 1);
            other.runTo(last, 1);
            text += cs::TestPlant::differences(rig.values(), other.rig.values());
        }
        return text;
    }

    WorldRig rig{withoutControllers(liftPlant())};

private:
    void runTo(std::int64_t end, double past) {
        while (rig.cycle() < end) {
            feedLift(rig.tree(), rig.cycle() + 1, past);
            rig.step();
        }
    }
};

class StateOfAWorld : public testing::TestWithParam<Moment> {};

TEST_P(StateOfAWorld, MakesAFreshWorldGoOnBitForBit) {
    WorldWithAPast saved{GetParam(), 1}, fresh{otherThan(GetParam()), 0.8};

    fresh.rig.restore(saved.rig.save());

    EXPECT_EQ(saved.goesOnOtherwiseThan(fresh), "");
    EXPECT_EQ(saved.rig.save().kept.at("/world"), fresh.rig.save().kept.at("/world"));
}

// Otherwise the test above would not see that something is missing.
TEST_P(StateOfAWorld, IsMissedWhereItIsNotRestored) {
    WorldWithAPast saved{GetParam(), 1}, fresh{otherThan(GetParam()), 0.8};
    cs::TestPlant::Saved state = saved.rig.save();
    state.kept.erase("/world");

    fresh.rig.restore(state);

    EXPECT_NE(saved.goesOnOtherwiseThan(fresh), "");
}

INSTANTIATE_TEST_SUITE_P(AtAMoment, StateOfAWorld, testing::ValuesIn(moments),
                         [](const auto& each) { return std::string{each.param.name}; });

}  // namespace
}  // namespace cortex::physics::test
