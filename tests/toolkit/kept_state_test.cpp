// SPDX-License-Identifier: Apache-2.0
#include "recipes.hpp"

#include <set>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

constexpr std::int64_t runOn = 300;  // cycles

// One plant with the class as `/it`, Active, and its history up to cycle `runUp`.
class Plant : public Rig {
public:
    Plant(const Recipe& recipe, double past) : recipe_{recipe} {
        recipe.build(*this);
        start();
        runTo(startedIn(past), past);
        cluster().send("/rig", "startup", {{"prefix", std::string{"/"}}});
        runTo(runUp, past);
        EXPECT_EQ(state("/it"), State::Active) << recipe.type;
    }
    // How it goes on otherwise than the other one: after one cycle, halfway, and at the end.
    std::string goesOnOtherwiseThan(Plant& other) {
        std::string text;
        for (const std::int64_t last : {runUp + 1, runUp + runOn / 2, runUp + runOn}) {
            runTo(last, 1);
            other.runTo(last, 1);
            text += differences(values(), other.values());
        }
        return text;
    }

private:
    void runTo(std::int64_t end, double past) {
        while (cycle() < end) {
            recipe_.feed(*this, cycle() + 1, past);
            step();
        }
    }

    const Recipe& recipe_;
};

class KeptState : public testing::TestWithParam<Recipe> {};

// Whoever forgets a member in keep() goes on otherwise than the one that was saved.
TEST_P(KeptState, MakesAFreshSimplexGoOnBitForBit) {
    Plant saved{GetParam(), 1}, fresh{GetParam(), 2};

    fresh.restore(saved.save());

    EXPECT_EQ(saved.goesOnOtherwiseThan(fresh), "");
    EXPECT_EQ(saved.save().kept.at("/it"), fresh.save().kept.at("/it"));
}

// Otherwise the test above would not see that something is missing.
TEST_P(KeptState, IsMissedWhereItIsNotRestored) {
    Plant saved{GetParam(), 1}, fresh{GetParam(), 2};
    cs::TestPlant::Saved state = saved.save();
    const bool keeps = !state.kept.at("/it").empty();
    state.kept.erase("/it");

    fresh.restore(state);

    EXPECT_EQ(!saved.goesOnOtherwiseThan(fresh).empty(), GetParam().keeps);
    EXPECT_EQ(keeps, GetParam().keeps);
}

INSTANTIATE_TEST_SUITE_P(OfEachClass, KeptState, testing::ValuesIn(recipes()),
                         [](const auto& each) { return each.param.type; });

TEST(KeptStateOfTheToolkit, IsTriedForEveryClass) {
    ClassRegistry registry;
    addClasses(registry);
    std::set<std::string> tried;
    for (const Recipe& recipe : recipes()) tried.insert(recipe.type);

    const std::vector<std::string> names = registry.names();
    EXPECT_EQ(tried, (std::set<std::string>{names.begin(), names.end()}));
}

}  // namespace
}  // namespace cortex::toolkit::test
