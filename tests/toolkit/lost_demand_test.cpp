// SPDX-License-Identifier: Apache-2.0
// What a demand of an axis does while it is lost, nobody sees. So whoever acts on it stands still
// until it rests where the axis is.
#include "cortex/core/agent.hpp"
#include "cortex/core/structure.hpp"

#include "recipes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

// A class of the toolkit that acts on demands of axes, as `/it`.
class ActsOnDemands : public Rig {
public:
    explicit ActsOnDemands(const Recipe& recipe) { recipe.build(*this); }

    // False: it has no such demand.
    bool begin() {
        start();
        const Structure& all = cluster().agent().structure();
        const std::uint32_t it = all.find("/it");
        for (const Edge& edge : all.edges) {
            const SimplexInfo& target = all.simplexes[edge.target];
            const bool isDemand = edge.rule->name == "demand" || edge.rule->name == "demands";
            if (edge.owner != it || !target.layout->type->isA("AxisConcept")) continue;
            if (edge.rule->direction == Direction::Output)
                led_.push_back(target.path);
            else if (isDemand)
                demands_.push_back(target.path);
        }
        if (demands_.empty()) return false;
        cluster().send("/rig", "startup", {{"prefix", std::string{"/"}}});
        enable();
        return true;
    }
    // By the words of CiA 402, where there is no processor that says them.
    void enable() {
        if (tree().at("/it").type().findCommand("enable") != nullptr)
            cluster().send("/it", "enable");
        for (const std::int64_t word : {0x06, 0x07, 0x0F}) {
            for (const std::string& each : demands_) {
                if (tree().at(each).type().findData("controlWord") == nullptr) continue;
                tree().at(each).data<std::int64_t>("controlWord") = word;
                tree().at(each).data<std::int64_t>("quickStopOption") = 6;
            }
            step(200);
        }
    }
    void demand(double position, Quality quality = Quality::Good) {
        for (const std::string& each : demands_) {
            tree().at(each).data<double>("position") = position;
            tree().at(each).slot().quality = quality;
        }
    }
    std::vector<double> places() {
        std::vector<double> all;
        for (const std::string& each : led_) all.push_back(get<double>(each, "position"));
        return all;
    }
    double farthestFrom(double position) {
        double farthest = 0;
        for (const double each : places()) farthest = std::max(farthest, std::abs(each - position));
        return farthest;
    }

private:
    std::vector<std::string> demands_, led_;
};

// False: it has no such demand.
bool standsUntilItRestsWhereTheAxisIs(const Recipe& recipe) {
    ActsOnDemands rig{recipe};
    if (!rig.begin()) return false;
    constexpr double start = 0.02, elsewhere = 0.5, nearness = 1e-3;
    for (int cycle = 0; cycle <= 200; ++cycle) {
        rig.demand(start * cycle / 200);
        rig.step();
    }
    rig.step(2000);
    EXPECT_LT(rig.farthestFrom(start), nearness) << "it follows";

    for (const bool comesBackAtOnce : {true, false}) {
        rig.demand(elsewhere, Quality::Lost);
        rig.step(comesBackAtOnce ? 1 : 500);
        rig.demand(elsewhere);
        for (int cycle = 0; cycle < 1500; ++cycle) {
            rig.step();
            EXPECT_LT(rig.farthestFrom(start), nearness) << cycle;
        }
        // It passes by.
        for (double position = elsewhere; position > -elsewhere; position -= 2e-3) {
            rig.demand(position);
            rig.step();
            EXPECT_LT(rig.farthestFrom(start), nearness) << position;
        }
        rig.demand(start);
        rig.step(10);
        rig.enable();
        for (int cycle = 0; cycle <= 200; ++cycle) {
            rig.demand(start + start * cycle / 200);
            rig.step();
        }
        rig.step(2000);
        EXPECT_LT(rig.farthestFrom(2 * start), nearness) << "it goes on";
        for (int cycle = 0; cycle <= 200; ++cycle) {
            rig.demand(2 * start - start * cycle / 200);
            rig.step();
        }
        rig.step(2000);
    }
    return true;
}

// A SimulatedAxis that is Active, with its demand and what it observes.
struct SimulatedDrive : Rig {
    SimulatedDrive() {
        for (const char* each : {"/demand", "/axis"}) add(each, "LimitedAxis");
        add("/drive", "SimulatedAxis", {{"demand", "/demand"}, {"observation", "/axis"}});
        start();
        startUp();
    }
};

TEST(LostDemand, LetsAnAxisStopWithinItsAcceleration) {
    constexpr double top = 1, cycleTime = 1e-3;
    constexpr double braking = 10, jolt = 100;  // as LimitedAxis has them
    SimulatedDrive rig;
    Simplex& demand = rig.tree().at("/demand");
    for (double now = 0; now < top; now += braking * cycleTime / 2) {
        demand.data<double>("velocity") = now;
        demand.data<double>("position") = now * now / braking;
        rig.step();
    }
    demand.slot().quality = Quality::Lost;
    double before = rig.get<double>("/axis", "velocity");
    ASSERT_NEAR(before, top, 0.05);
    const double lostAt = rig.get<double>("/axis", "position");
    for (int cycle = 0; cycle < 300; ++cycle) {
        rig.step();
        const double now = rig.get<double>("/axis", "velocity");
        EXPECT_LT(std::abs(now - before), 2 * braking * cycleTime) << cycle;
        EXPECT_EQ(rig.get<std::int64_t>("/axis", "status"), 7) << "Braked";
        before = now;
    }
    EXPECT_NEAR(before, 0, 1e-4);
    EXPECT_NEAR(rig.get<double>("/axis", "position") - lostAt,
                top * top / braking / 2 + top * braking / jolt / 2, 0.01);
}

TEST(LostDemand, LetsAnAxisThatHasNearlyStoppedNotTakeOffAgain) {
    constexpr double cycleTime = 1e-3, frozenFor = 0.05;
    SimulatedDrive rig;
    Simplex& demand = rig.tree().at("/demand");
    demand.data<double>("velocity") = 1;
    for (int cycle = 0; cycle < 500; ++cycle) {
        demand.data<double>("position") = cycle * cycleTime;
        rig.step();
    }
    ASSERT_NEAR(rig.get<double>("/axis", "velocity"), 1, 0.05);
    rig.step(std::lround(frozenFor / cycleTime));  // as a cut link leaves it
    const double atLoss = std::abs(rig.get<double>("/axis", "velocity"));
    ASSERT_LT(atLoss, 0.3);

    demand.slot().quality = Quality::Lost;
    for (int cycle = 0; cycle < 300; ++cycle) {
        rig.step();
        EXPECT_LE(std::abs(rig.get<double>("/axis", "velocity")), atLoss + 0.01) << cycle;
    }
    EXPECT_NEAR(rig.get<double>("/axis", "velocity"), 0, 1e-4);
}

TEST(LostDemand, IsFollowedAgainByEachClassOnlyOnceItRestsWhereTheAxisIs) {
    int tried = 0;
    for (const Recipe& recipe : recipes()) {
        const testing::ScopedTrace trace{__FILE__, __LINE__, recipe.type};
        if (standsUntilItRestsWhereTheAxisIs(recipe)) ++tried;
        ASSERT_FALSE(HasFailure());
    }
    EXPECT_EQ(tried, 3) << "SimulatedAxis, Ds402SimulatedDrive and Ds402AxisProcessor";
}

}  // namespace
}  // namespace cortex::toolkit::test
