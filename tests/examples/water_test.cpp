// SPDX-License-Identifier: Apache-2.0
// The example of three tanks in a ring, stepped by hand: both agents' parts in one.
#include "cortex/core/registry.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/cs/cluster_cs.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace std::chrono_literals;

class WaterPlant : public testing::Test {
protected:
    static std::string file(const std::string& name) {
        return CORTEX_SOURCE_DIR "/examples/water/" + name;
    }

    SimplexTree load() {
        registry.loadPlugin(CORTEX_WATER_PLUGIN, TypeModel::load(file("water-rules.xml")));
        return SimplexTree::load(file("water.xml"), &registry);
    }

    void SetUp() override {
        water.addSimplexTree(tree);
        trigger = &water.setTriggerSource<cs::ManualTrigger>(10ms);
        water.start();
        water.send("/water", "startup", {{"prefix", "/"}});
    }

    void runSeconds(std::int64_t seconds) { trigger->step(seconds * 100); }
    double level(const std::string& tank) { return value("/tanks/" + tank, "level"); }
    double value(const std::string& path, const std::string& item) {
        return water.image().get<double>(path, item);
    }

    ClassRegistry registry;
    SimplexTree tree = load();
    cs::ClusterCS water{"water"};
    cs::ManualTrigger* trigger = nullptr;
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
    auto& controller = dynamic_cast<cs::SimplexCS&>(tree.at("/levels/1"));
    runSeconds(20);
    const std::vector<std::byte> saved = controller.savedState();
    ASSERT_FALSE(saved.empty());
    runSeconds(10);
    ASSERT_NE(controller.savedState(), saved);

    controller.restoreState(saved);

    EXPECT_EQ(controller.savedState(), saved);
}

TEST_F(WaterPlant, WithoutTheSupervisorPumpsAreSafeAndTheValvesLevelTheTanks) {
    runSeconds(200);
    ASSERT_GT(std::abs(value("/pumps/1", "flow")), 0.0001);

    water.send("/supervisor", "shutdown", {});
    runSeconds(2);
    for (const char* pump : {"/pumps/1", "/pumps/2", "/pumps/3"})
        EXPECT_EQ(value(pump, "flow"), 0) << pump;
    runSeconds(600);

    EXPECT_NEAR(level("1"), 0.5, 0.01);
    EXPECT_NEAR(level("3"), 0.5, 0.01);
}

}  // namespace
}  // namespace cortex::test
