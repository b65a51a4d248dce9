// SPDX-License-Identifier: Apache-2.0
// Brakes, startup, faults: what a world does in its states. Demands are written by the test.
#include "world_rig.hpp"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

namespace cortex::physics::test {
namespace {

constexpr double asItWas = 1e-4;  // m

Entries withSafety(Entries entries) {
    at(entries, "/world").relates.push_back({"safety", "/safety", false, false, {}});
    return std::move(entries) +
           Entries{entry("/safety", "SafetyStatus"),
                   entry("/panel", "SimulatedSafetyPanel", {{"status", "/safety"}})};
}

struct AWorld : testing::Test {
    void begin(const Entries& entries) {
        rig = std::make_unique<WorldRig>(entries);
        demand("/gripper/demand", 0.085);
    }
    void begin() { begin(withoutControllers(liftPlant())); }
    void demand(const std::string& path, double position) {
        rig->tree().at(path).data<double>("position") = position;
    }
    // To an aim, in steps as a controller makes them.
    void lead(double position) {
        double now = rig->position("/lift/demand");
        while (now != position) {
            now = now < position ? std::min(now + 2e-4, position) : std::max(now - 2e-4, position);
            demand("/lift/demand", now);
            rig->step();
        }
        rig->step(300);
    }
    double height() { return rig->position("/lift/axis"); }
    std::int64_t status() { return rig->get<std::int64_t>("/lift/axis", "status"); }
    std::int64_t faultCode() { return rig->get<std::int64_t>("/world", "faultCode"); }
    bool braked() { return rig->get<bool>("/world", "braked"); }
    bool becomes(State state) {
        return rig->until([&] { return rig->state("/world") == state; });
    }
    std::unique_ptr<WorldRig> rig;
};

TEST_F(AWorld, HoldsItsAxesInStandbyWhateverTheirDemandsSay) {
    begin();
    demand("/lift/demand", 0.3);
    rig->step(500);
    EXPECT_NEAR(height(), 0, asItWas);
    EXPECT_EQ(status(), brakedStatus);
    EXPECT_TRUE(braked());
}

TEST_F(AWorld, LetsABodyFallOntoATableInStandbyToo) {
    begin(withoutControllers(liftPlant(0.05)));
    EXPECT_NEAR(rig->array("/boxPose", "position")[2], 0.48, 1e-4);
    const double energy = rig->get<double>("/world", "energy");
    rig->step(50);
    EXPECT_LT(rig->array("/boxPose", "linearVelocity")[2], -0.4) << "9.8 m/s2 for 50 ms";
    rig->step(600);
    EXPECT_NEAR(rig->array("/boxPose", "position")[2], 0.43, 1e-3);
    EXPECT_NEAR(rig->array("/boxPose", "linearVelocity")[2], 0, 1e-3);
    EXPECT_NEAR(rig->array("/boxPose", "rotation")[3], 1, 1e-3);
    EXPECT_EQ(rig->get<std::int64_t>("/world", "contacts"), 4);
    EXPECT_LT(rig->get<double>("/world", "energy"), energy) << "by what it fell";
}

TEST_F(AWorld, WaitsInItsStartupForADemandAndTellsWhich) {
    begin();
    demand("/lift/demand", 0.05);
    rig->send("/world", "startup");
    rig->step(1100);
    EXPECT_EQ(rig->state("/world"), State::StartingUp);
    EXPECT_EQ(rig->told(),
              "it waits: /lift/axis is 0.05 m from its demand; a controller brings the two "
              "together\n");
    demand("/lift/demand", 0.005);
    rig->step(5);
    EXPECT_EQ(rig->state("/world"), State::Active);
    lead(0.1);
    EXPECT_NEAR(height(), 0.1, asItWas);
}

TEST_F(AWorld, DoesNotStartWhileADemandMovesPastItsAxis) {
    begin();
    rig->tree().at("/lift/demand").data<double>("velocity") = 0.1;
    rig->send("/world", "startup");
    rig->step(1100);
    EXPECT_EQ(rig->state("/world"), State::StartingUp);
    EXPECT_EQ(rig->told(),
              "it waits: /lift/axis moves, or its demand does; a controller brings the two "
              "together\n");
}

TEST_F(AWorld, BrakesOnCommandAndIsReleasedOnlyWhereNoDemandIsAway) {
    begin();
    rig->startUp();
    lead(0.1);
    ASSERT_TRUE(rig->call("/world", "brake").done());
    demand("/lift/demand", 0.2);
    rig->step(200);
    EXPECT_NEAR(height(), 0.1, asItWas);
    EXPECT_EQ(status(), brakedStatus);

    const CallResult away = rig->call("/world", "release");
    EXPECT_EQ(away.outcome, Outcome::Rejected);
    EXPECT_EQ(away.why.substr(0, 18), "/lift/axis is 0.1 ") << away.why;
    EXPECT_NE(away.why.find("m from its demand: bring the two together first"), std::string::npos);
    EXPECT_TRUE(braked());

    demand("/lift/demand", 0.1);
    rig->step();
    EXPECT_TRUE(rig->call("/world", "release").done());
    rig->step();
    EXPECT_FALSE(braked());
    lead(0.15);
    EXPECT_NEAR(height(), 0.15, asItWas);
    EXPECT_EQ(status(), 1) << "Ready";
}

TEST_F(AWorld, HasItsBrakesOnWhereItIsShutDownInMotion) {
    begin();
    rig->startUp();
    for (int i = 0; i < 200; ++i) {
        demand("/lift/demand", 5e-4 * i);
        rig->step();
    }
    ASSERT_GT(rig->get<double>("/lift/axis", "velocity"), 0.3);
    const double there = height();
    ASSERT_TRUE(rig->call("/world", "shutdown").done());
    rig->step(200);
    EXPECT_NEAR(height(), there, 0.01);
    EXPECT_NEAR(rig->get<double>("/lift/axis", "velocity"), 0, 1e-4);
}

TEST_F(AWorld, BrakesWhileADemandIsLostAndGoesOnOnceItIsAtItsAxisAgain) {
    begin();
    rig->startUp();
    lead(0.1);
    SlotState& slot = rig->tree().at("/lift/demand").slot();
    slot.quality = Quality::Lost;
    demand("/lift/demand", 0.2);
    rig->step(100);
    EXPECT_TRUE(braked());
    EXPECT_EQ(rig->state("/world"), State::Active);
    slot.quality = Quality::Good;
    rig->step(100);
    EXPECT_TRUE(braked()) << "it would jump";
    EXPECT_NEAR(height(), 0.1, asItWas);
    demand("/lift/demand", 0.1);
    rig->step(10);
    EXPECT_FALSE(braked());
}

TEST_F(AWorld, FollowsAStaleDemandWhichIsThatOfAControllerAtRest) {
    begin();
    rig->tree().at("/lift/demand").slot().quality = Quality::Stale;
    rig->startUp();
    lead(0.05);
    EXPECT_NEAR(height(), 0.05, asItWas);
}

TEST_F(AWorld, KeepsTheJawsOfAGripperWhereTheyWereToldLastOnAStaleDemand) {
    begin();
    rig->startUp();
    Simplex& wish = rig->tree().at("/gripper/demand");
    demand("/gripper/demand", 0.07);
    wish.data<double>("velocity") = -0.1;
    rig->step();
    demand("/gripper/demand", 0.02);
    wish.slot().quality = Quality::Stale;
    rig->step(500);
    EXPECT_NEAR(rig->position("/gripper/opening"), 0.07, asItWas);
    EXPECT_EQ(rig->get<std::int64_t>("/gripper/status", "object"), atDemand);
}

TEST_F(AWorld, SaysAtLimitWhereAnEffortIsAtItsGreatest) {
    begin();
    rig->startUp();
    rig->tree().at("/lift/demand").data<double>("effort") = 1e4;
    rig->step(2);
    EXPECT_EQ(status(), 3);
    EXPECT_EQ(rig->get<double>("/lift/axis", "effort"), 500);
    rig->step(1500);
    EXPECT_EQ(height(), 0.5) << "shown within its range";
    EXPECT_EQ(status(), 3);
}

// Downwards it pushes with its greatest effort less the weight that it carries.
TEST_F(AWorld, SaysAtLimitWhereSomethingIsInTheWay) {
    begin();
    rig->startUp();
    lead(-0.1);
    EXPECT_LT(rig->get<double>("/lift/axis", "effort"), -400);
    EXPECT_GT(height(), -0.09) << "on the table";
    EXPECT_EQ(status(), 3);
    lead(0.1);
    EXPECT_EQ(status(), 1);
}

TEST_F(AWorld, StopsWithTheSafetySystemAndComesBackWhenThatIsReset) {
    begin(withSafety(withoutControllers(liftPlant())));
    rig->startUp();
    lead(0.1);
    ASSERT_TRUE(rig->call("/panel", "press").done());
    ASSERT_TRUE(becomes(State::Fault));
    EXPECT_EQ(faultCode(), 40);
    EXPECT_EQ(rig->told(), "fault 40: safety stop: emergency stop\n");
    demand("/lift/demand", 0.2);
    rig->step(300);
    EXPECT_NEAR(height(), 0.1, asItWas);
    EXPECT_EQ(status(), 4) << "Fault";

    demand("/lift/demand", 0.1);
    rig->send("/world", "clearFaults");
    ASSERT_TRUE(becomes(State::Standby));
    rig->send("/world", "startup");
    ASSERT_TRUE(becomes(State::Fault)) << "the button is still pressed";
    EXPECT_EQ(faultCode(), 40);

    ASSERT_TRUE(rig->call("/panel", "release").done());
    ASSERT_TRUE(rig->call("/panel", "reset").done());
    rig->send("/world", "clearFaults");
    ASSERT_TRUE(becomes(State::Standby));
    rig->startUp();
    lead(0.15);
    EXPECT_NEAR(height(), 0.15, asItWas);
}

// Beside the table, so that only the four points of each box are there.
Entries boxes(int count) {
    Entries entries;
    for (int i = 0; i < count; ++i)
        entries.push_back(entry("/many/" + std::to_string(i), "SceneBody", {},
                                {{"size", "0.05 0.05 0.05"},
                                 {"mass", "0.1"},
                                 {"position", std::to_string(0.15 + 0.1 * i) + " 0.3 0.45"}}));
    return entries;
}

TEST_F(AWorld, FaultsOnTooManyContactsAndStandsStillWhereThatGoesOn) {
    Entries entries = withoutControllers(liftPlant());
    at(entries, "/world").settings.push_back({"contactLimit", "8", {}});
    std::erase_if(at(entries, "/world").relates,
                  [](const auto& each) { return each.rule == "bodyPoses"; });
    for (const auto& box : boxes(2))
        at(entries, "/world").relates.push_back({"bodies", box.path, false, false, {}});
    std::erase_if(entries, [](const auto& each) { return each.path == "/boxPose"; });
    begin(entries + boxes(2));
    ASSERT_TRUE(becomes(State::Fault));
    EXPECT_EQ(faultCode(), 51);
    rig->step(300);
    const std::string told = rig->told();
    EXPECT_EQ(told.find("fault 51: more contacts than contactLimit; "), 0U) << told;
    EXPECT_NE(told.find("it fails again, so it stands still until reset: "), std::string::npos)
        << told;
    EXPECT_EQ(std::ranges::count(told, '\n'), 2) << "nothing is computed any more: " << told;
    rig->send("/world", "clearFaults");
    rig->step(5);
    EXPECT_NE(rig->told().find("the fault is not over"), std::string::npos) << rig->told();

    ASSERT_TRUE(rig->call("/world", "reset").done());
    rig->send("/world", "clearFaults");
    rig->step(5);
    EXPECT_EQ(rig->state("/world"), State::Standby);
}

TEST_F(AWorld, FaultsWhereAnAxisIsThrownThroughTheEndOfItsRange) {
    Entries entries = withoutControllers(liftPlant());
    at(entries, "/gripper").settings.push_back({"bodySize", "10 10 10", {}});
    begin(entries);
    EXPECT_TRUE(becomes(State::Fault));
    EXPECT_EQ(faultCode(), 50);
    rig->step(100);
    EXPECT_NE(rig->told().find("'/lift/axis' was pushed through the end of its range; look at what "
                               "pushes it, or stands in something at the start"),
              std::string::npos)
        << rig->told();
    EXPECT_FALSE(rig->call("/world", "clearFaults").done()) << "it goes on until a reset";
}

TEST_F(AWorld, IsAsAtTheStartAfterAReset) {
    begin();
    rig->startUp();
    lead(0.1);
    EXPECT_EQ(rig->call("/world", "reset").outcome, Outcome::Rejected) << "its axes would jump";
    ASSERT_TRUE(rig->call("/world", "shutdown").done());
    ASSERT_TRUE(rig->call("/world", "reset").done());
    rig->step();
    EXPECT_NEAR(height(), 0, asItWas);
    EXPECT_NEAR(rig->array("/boxPose", "position")[2], 0.43, 1e-4);
    demand("/lift/demand", 0);
    rig->startUp();
    lead(0.05);
    EXPECT_NEAR(height(), 0.05, asItWas);
}

TEST_F(AWorld, TakesAsManyEqualStepsAsACycleNeedsAndAtMostTwenty) {
    for (const auto& [cycle, fallen] : {std::pair{4, 4 * 25}, std::pair{40, 20 * 25}}) {
        WorldRig slow{withoutControllers(liftPlant(5)), std::chrono::milliseconds{cycle}};
        slow.step(24);
        const double seconds = fallen * 1e-3;
        EXPECT_NEAR(slow.array("/boxPose", "linearVelocity")[2], -9.80665 * seconds, 1e-6)
            << cycle << " ms in a cycle, 1 ms in a step";
        EXPECT_EQ(slow.told(), cycle == 4 ? ""
                                          : "time is slower here than outside: a cycle has 0.04 s, "
                                            "and 20 steps of timeStep are 0.02 s; make timeStep "
                                            "0.002 s\n");
    }
}

TEST_F(AWorld, SaysOnceThatItsTimeIsSlowerWhereItsLoopMissesMostTicks) {
    begin();
    rig->standStill(500);
    rig->step(20);
    EXPECT_EQ(rig->told().find("time is slower"), std::string::npos) << "once is no pace";
    for (int i = 0; i < 20; ++i) rig->standStill(7);
    rig->step();
    const std::string told = rig->told(), begins = "time is slower here than outside: ";
    const std::size_t at = told.find(begins +
                                     "0.008 s passed since the last cycle, and it is "
                                     "worth 0.003 s, as the loop misses ticks");
    EXPECT_NE(at, std::string::npos) << told;
    EXPECT_EQ(told.find(begins, at + 1), std::string::npos) << told;
}

TEST_F(AWorld, SaysOnceThatADemandBringsTheWeightThatItsDriveCarriesItself) {
    begin();
    rig->startUp();
    auto effort = rig->tree().at("/lift/demand").data<double>("effort");
    effort = 0.5 * rig->get<double>("/lift/axis", "effort");
    rig->step(100);
    EXPECT_EQ(rig->told(), "") << "some other force";
    effort = 0.9 * rig->get<double>("/lift/axis", "effort");
    rig->step(100);
    EXPECT_EQ(
        rig->told(),
        "the demand of /lift/axis carries its weight, and so does gravityCompensation: switch "
        "that off, or set part of InverseDynamics to Acceleration\n");
}

TEST_F(AWorld, TakesABandwidthInStandbyAlone) {
    begin();
    EXPECT_TRUE(rig->set("/world", "bandwidth", Value{std::vector{3.0}}));
    rig->startUp();
    EXPECT_FALSE(rig->set("/world", "bandwidth", Value{std::vector{5.0}}));
    double lag = 0;
    for (int i = 0; i < 200; ++i) {
        demand("/lift/demand", 2e-4 * i);
        rig->step();
        lag = 2e-4 * i - height();
    }
    EXPECT_NEAR(lag, 0.2 * 2 * 0.9 / (2 * 3.14159 * 3), 2e-3) << "2 d / w of its speed";
}

}  // namespace
}  // namespace cortex::physics::test
