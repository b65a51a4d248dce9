// SPDX-License-Identifier: Apache-2.0
// The tick is sacred for each class of the toolkit, in each of the five states.
#include "realtime/watched_cluster.hpp"
#include "toolkit/recipes.hpp"

#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using toolkit::test::Recipe;
using toolkit::test::recipes;
using toolkit::test::Rig;
using toolkit::test::runUp;

// A plant with the class as `/it`, whose hooks are watched from the first cycle on.
class WatchedPlant : public Rig {
public:
    explicit WatchedPlant(const Recipe& recipe) : recipe_{recipe} {
        recipe.build(*this);
        checker().watch(cluster());
        start();
    }
    // Fed as in a run, and told to do what it does, from its start on.
    void work() {
        cluster().send("/rig", "startup", {{"prefix", std::string{"/"}}});
        for (std::int64_t cycle = 1; cycle <= runUp + 300; ++cycle) {
            recipe_.feed(*this, cycle, 1);
            see();
        }
    }
    void order(const std::string& command, std::int64_t cycles) {
        cluster().send("/it", command);
        for (std::int64_t i = 0; i < cycles; ++i) see();
    }
    // What it needs is lost and no number, so it goes to Fault where anything can bring it there.
    void spoil() {
        for (const SimplexInfo& each : cluster().image().structure().simplexes) {
            if (!each.writers.empty() || each.role == Role::Active) continue;
            Simplex& simplex = tree().at(each.path);
            simplex.slot().quality = Quality::Lost;
            if (each.layout->find("position") != nullptr) {
                simplex.array<double>("position")[0] = std::numeric_limits<double>::quiet_NaN();
            }
        }
        for (int i = 0; i < 300; ++i) see();
    }
    const std::set<State>& seen() const { return seen_; }

private:
    void see() {
        step();
        seen_.insert(state("/it"));
    }

    const Recipe& recipe_;
    std::set<State> seen_;
};

class EveryClass : public testing::TestWithParam<Recipe> {};

TEST_P(EveryClass, NeitherAllocatesNorLocksNorCallsTheSystemInAnyState) {
    checker().reset();
    WatchedPlant plant{GetParam()};
    plant.order("shutdown", 20);
    plant.work();
    plant.order("shutdown", 300);
    plant.order("startup", 50);
    plant.spoil();
    plant.order("clearFaults", 50);

    EXPECT_EQ(violations(), "");
    for (const State state :
         {State::Standby, State::StartingUp, State::Active, State::ShuttingDown}) {
        EXPECT_TRUE(plant.seen().contains(state)) << name(state);
    }
}

INSTANTIATE_TEST_SUITE_P(OfTheToolkit, EveryClass, testing::ValuesIn(recipes()),
                         [](const auto& each) { return each.param.type; });

}  // namespace
}  // namespace cortex::test
