// SPDX-License-Identifier: Apache-2.0
#include "recipes.hpp"

#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

constexpr std::int64_t runOn = 300;  // cycles

// One plant with the class as `/it`, Active, and its history up to cycle `runUp`. It was there for
// `age` cycles before.
class Plant : public Rig {
public:
    Plant(const Recipe& recipe, double past, std::int64_t age = 0) : recipe_{recipe}, age_{age} {
        recipe.build(*this);
        start();
        step(age);
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
        while (cycle() < age_ + end) {
            recipe_.feed(*this, cycle() - age_ + 1, past);
            step();
        }
    }

    const Recipe& recipe_;
    std::int64_t age_;
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

class KeptTimes : public testing::TestWithParam<Recipe> {};

// Whose clock shows another time.
TEST_P(KeptTimes, MakeASimplexOfAnOlderPlantGoOnBitForBit) {
    Plant saved{GetParam(), 1}, older{GetParam(), 2, 260};

    older.restore(saved.save());

    EXPECT_EQ(saved.goesOnOtherwiseThan(older), "");
    EXPECT_EQ(saved.save().kept.at("/it"), older.save().kept.at("/it"));
}

// But for those that read how old a demand is, which stands in tables, or count cycles of a
// hand-over.
std::vector<Recipe> withoutOtherTimes() {
    const std::set<std::string> others{"AxisControllerSelector", "Ds402AxisProcessor",
                                       "ProcessorSelector"};
    std::vector<Recipe> all = recipes();
    std::erase_if(all, [&](const Recipe& each) { return others.contains(each.type); });
    return all;
}

INSTANTIATE_TEST_SUITE_P(OfEachClass, KeptTimes, testing::ValuesIn(withoutOtherTimes()),
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
