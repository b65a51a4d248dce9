// SPDX-License-Identifier: Apache-2.0
// The loop stands still for up to three seconds, again and again. What goes out makes up for
// nothing: one cycle is worth three periods at most, and the motion arrives later.
#include "cortex/core/registry.hpp"

#include "rig.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

// Ticks that are missed before a cycle: none in most of them.
class Standstills {
public:
    static constexpr double period = 1e-3;                   // s
    static constexpr double most = 3 * period * (1 + 1e-9);  // s, that one cycle is worth

    void before(Rig& rig) {
        constexpr std::array<std::int64_t, 6> lengths{1, 4, 20, 40, 300, 3000};
        if (std::uniform_int_distribution{0, 9}(random_) != 0)
            rig.step();
        else
            rig.standStill(lengths[std::uniform_int_distribution<std::size_t>{0, 5}(random_)]);
    }

private:
    std::mt19937 random_{78};
};

// Two axes with simulated drives; /pose leads one of them, and /jog the other.
class MovedAxes : public Rig {
public:
    static constexpr double speed = 2, acceleration = 10, jerk = 100;  // of LimitedAxis

    MovedAxes() {
        for (const std::string each : {"pose", "jog"}) {
            const std::string demand = "/" + each + "/demand", axis = "/" + each + "/axis";
            add(demand, "LimitedAxis");
            add(axis, "LimitedAxis");
            add("/" + each + "/drive", "SimulatedAxis",
                {{"demand", demand}, {"observation", axis}});
            add("/" + each, each == "pose" ? "AxisPoseController" : "JogController",
                {{"axes", axis}, {"demands", demand}});
        }
        start();
        startUp();
        cluster().send("/pose", "set", {{"pose", places(2.5)}});
        cluster().send("/jog", "set", {{"demandPosition", places(-2)}, {"speedShare", 1.0}});
        call("/jog", "setMode", {{"mode", std::int64_t{1}}});
    }
    static std::vector<double> places(double first) {
        std::vector<double> all(16);
        all[0] = first;
        return all;
    }
    bool endedEarly(const std::string& controller) {
        return get<std::int64_t>(controller, "outcome") == static_cast<int>(Outcome::Failed);
    }
    std::array<double, 3> state(const std::string& path) {
        return {get<double>(path, "position"), get<double>(path, "velocity"),
                get<double>(path, "acceleration")};
    }
};

TEST(AStandstill, IsNoStepOfAPoseOrAJogNorOfWhatFollowsThem) {
    MovedAxes rig;
    Standstills standstills;
    rig.cluster().send("/pose", "moveTo");
    rig.cluster().send("/jog", "go");
    const std::array<std::string, 2> demands{"/pose/demand", "/jog/demand"};
    const std::array<std::string, 2> followers{"/pose/axis", "/jog/axis"};
    std::array<std::array<double, 3>, 2> before{rig.state(demands[0]), rig.state(demands[1])};
    std::array<double, 2> observed{};
    for (int cycle = 0; cycle < 6000; ++cycle) {
        standstills.before(rig);
        // A drive that was not followed for 50 ms counts as lost, and ends the motion.
        if (rig.endedEarly("/pose")) rig.cluster().send("/pose", "moveTo");
        if (rig.endedEarly("/jog")) rig.cluster().send("/jog", "go");
        for (std::size_t i = 0; i < demands.size(); ++i) {
            const std::array<double, 3> now = rig.state(demands[i]);
            ASSERT_LE(std::abs(now[0] - before[i][0]), MovedAxes::speed * Standstills::most)
                << demands[i] << cycle;
            ASSERT_LE(std::abs(now[1] - before[i][1]), MovedAxes::acceleration * Standstills::most)
                << cycle;
            ASSERT_LE(std::abs(now[2] - before[i][2]), MovedAxes::jerk * Standstills::most)
                << cycle;
            before[i] = now;
            const double there = rig.get<double>(followers[i], "position");
            ASSERT_LE(std::abs(there - observed[i]), MovedAxes::speed * Standstills::most)
                << followers[i] << cycle;
            observed[i] = there;
        }
    }
    EXPECT_EQ(before[0][0], 2.5);
    EXPECT_EQ(before[1][0], -2);
    for (const char* each : {"/pose", "/jog"})
        EXPECT_EQ(rig.get<std::int64_t>(each, "outcome"), static_cast<int>(Outcome::Done));
}

// What a block writes to /result, from /source where it has one.
class Blocks : public Rig {
public:
    Blocks(const std::string& type, const Pairs& relates, const Pairs& settings,
           const std::string& result = "Heating") {
        add("/source", "MeasuredTemperature");
        add("/wish", "Temperature");
        add("/result", result, {}, {{"value", "0"}});
        add("/block", type, relates, settings);
        start();
        startUp();
    }
    void feed(double value) { tree().at("/source").data<double>("value") = value; }
    double result() { return get<double>("/result", "value"); }
};

// Its result goes there by `rate` a second, however the loop runs.
void expectToReach(Blocks& rig, double target, double rate) {
    Standstills standstills;
    double before = rig.result();
    for (int cycle = 0; cycle < 10'000 && before != target; ++cycle) {
        standstills.before(rig);
        ASSERT_LE(std::abs(rig.result() - before), rate * Standstills::most) << "to " << before;
        before = rig.result();
    }
    EXPECT_EQ(before, target);
}

TEST(AStandstill, IsNoStepOfARamp) {
    Blocks rig{"Ramp", {{"result", "/result"}}, {{"rate", "20"}}};
    rig.cluster().send("/block", "goTo", {{"target", 50.0}});
    expectToReach(rig, 50, 20);
}

TEST(AStandstill, IsNoStepOfARateLimiter) {
    Blocks rig{"RateLimiter",
               {{"source", "/source"}, {"result", "/result"}},
               {{"rate", "5"}},
               "Temperature"};
    rig.feed(10);
    expectToReach(rig, 10, 5);
}

TEST(AStandstill, IsNoStepByTheRateOfAType) {
    Blocks rig{"PidController",
               {{"measured", "/source"}, {"setpoint", "/wish"}, {"output", "/result"}},
               {{"kp", "10"}},
               "SlowHeating"};  // 10 % a second
    rig.tree().at("/wish").data<double>("value") = 2;
    expectToReach(rig, 20, 10);
}

// The derivative divides by the whole time; by less it would be a kick.
TEST(AStandstill, IsNoKickOfTheDerivativeOfAPidController) {
    const double slope = -3, kd = 2;
    Blocks rig{"PidController",
               {{"measured", "/source"}, {"setpoint", "/wish"}, {"output", "/result"}},
               {{"kp", "0"}, {"kd", "2"}, {"filterTime", "0"}}};
    std::int64_t ticks = 0;
    for (const std::int64_t late : {0, 2, 50, 1000, 0, 3000}) {
        for (int i = 0; i < 20; ++i) {
            rig.feed(slope * static_cast<double>(++ticks) * Standstills::period);
            rig.step();
            if (i > 0) {
                ASSERT_NEAR(rig.result(), -kd * slope, 1e-9) << "after " << late << " ticks";
            }
        }
        rig.feed(slope * static_cast<double>(++ticks) * Standstills::period);
        rig.standStill(late);
        ticks += late;
    }
}

}  // namespace
}  // namespace cortex::toolkit::test
