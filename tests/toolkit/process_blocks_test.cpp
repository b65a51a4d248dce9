// SPDX-License-Identifier: Apache-2.0
// Blocks of process control against closed forms.
#include "cortex/cs/cluster_cs.hpp"

#include "rig.hpp"

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

constexpr double cycleTime = 1e-3;  // s, of the rig
constexpr double nearly = 1e-9;

// A room whose temperature the test writes, its set-point, a heater and a PID controller.
struct Heated : Rig {
    explicit Heated(const Pairs& settings, const std::string& heating = "Heating") {
        add("/room", "MeasuredTemperature");
        add("/wish", "Temperature");
        add("/heater", heating, {}, {{"value", "0"}});
        add("/pid", "PidController",
            {{"measured", "/room"}, {"setpoint", "/wish"}, {"output", "/heater"}}, settings);
        start();
    }
    void measure(double value) { tree().at("/room").data<double>("value") = value; }
    void wish(double value) { tree().at("/wish").data<double>("value") = value; }
    double heat() { return get<double>("/heater", "value"); }
    // To the first cycle in which it is Active.
    void startPid() {
        cluster().send("/pid", "startup");
        while (state("/pid") != State::Active) step();
    }
};

TEST(APidController, AddsAShareOfTheErrorAndItsIntegral) {
    Heated plant{{{"kp", "2"}, {"ki", "0.5"}}};
    plant.measure(20);
    plant.wish(20);
    plant.startPid();
    EXPECT_EQ(plant.heat(), 0);

    plant.wish(25);
    for (int cycle = 1; cycle <= 1000; ++cycle) {
        plant.step();
        ASSERT_NEAR(plant.heat(), 2 * 5 + 0.5 * 5 * cycle * cycleTime, nearly) << cycle;
    }
}

TEST(APidController, BeginsAtTheOutputThatStandsAndStaysThereOnAGainThatIsChanged) {
    Heated plant{{{"kp", "4"}, {"ki", "1"}}};
    plant.measure(15);
    plant.wish(25);
    plant.startPid();
    EXPECT_NEAR(plant.heat(), 0, nearly) << "the error of 10 is no step";
    plant.step(500);
    const double before = plant.heat();
    EXPECT_NEAR(before, 10 * 0.5, nearly);

    EXPECT_EQ(plant.call("/pid", "set", {{"kp", std::vector{8.0}}}).outcome, Outcome::Done);
    plant.step();
    EXPECT_LE(std::abs(plant.heat() - before), 10 * cycleTime * 5) << "the integral alone goes on";
}

TEST(APidController, AnswersAChangeOfWhatIsMeasuredAndNotOfTheSetPoint) {
    const double slope = 3, filterTime = 0.05, kd = 2;
    Heated plant{{{"kp", "0"}, {"kd", "-2"}, {"filterTime", "0.05"}}};
    plant.startPid();
    plant.wish(80);
    plant.step(5);
    EXPECT_EQ(plant.heat(), 0);

    // d = kd·slope·(1 − (T/(T+Ts))^n)
    for (int cycle = 1; cycle <= 400; ++cycle) {
        plant.measure(slope * cycle * cycleTime);
        plant.step();
        const double share = 1 - std::pow(filterTime / (filterTime + cycleTime), cycle);
        ASSERT_NEAR(plant.heat(), kd * slope * share, nearly) << cycle;
    }
}

// How long the output stays at its end after the error has changed its sign.
int cyclesAtTheEnd(Heated& plant) {
    plant.measure(20);
    plant.wish(20);
    plant.startPid();
    plant.wish(120);  // 10 s at the upper end
    plant.step(10'000);
    plant.measure(125);
    int cycles = 0;
    do {
        plant.step();
        ++cycles;
    } while (plant.heat() == 100 && cycles < 20'000);
    return cycles;
}

TEST(APidController, DoesNotWindUpAtTheEndOfTheRange) {
    Heated plant{{{"kp", "2"}, {"ki", "2"}}};
    EXPECT_LE(cyclesAtTheEnd(plant), 2);
}

TEST(APidController, DoesNotWindUpBeforeALimitOfItsOwn) {
    Heated plant{{{"kp", "2"}, {"ki", "2"}, {"outputMax", "40"}, {"trackingTime", "0.1"}}};
    plant.startPid();
    plant.wish(100);
    plant.step(5'000);
    EXPECT_EQ(plant.heat(), 40);
    plant.wish(-1);
    plant.step(2);
    EXPECT_LT(plant.heat(), 40);
}

TEST(APidController, FollowsADemandThatItsRateHoldsBack) {
    Heated plant{{{"kp", "1"}, {"ki", "1"}, {"trackingTime", "0.001"}}, "SlowHeating"};
    plant.startPid();
    plant.wish(60);
    plant.step(2000);
    EXPECT_NEAR(plant.heat(), 20, 0.05) << "10 percent per second";
    plant.wish(0);
    const double before = plant.heat();
    plant.step(50);
    EXPECT_LT(plant.heat(), before) << "it turns at once";
}

TEST(APidController, RefusesAnOutputRangeThatIsNone) {
    Heated plant{{}};
    const CallResult result = plant.call(
        "/pid", "set", {{"outputMin", std::vector{50.0}}, {"outputMax", std::vector{40.0}}});
    EXPECT_EQ(result.outcome, Outcome::Rejected);
    EXPECT_NE(result.text().find("outputMin is not below outputMax"), std::string::npos)
        << result.text();
}

TEST(APidController, FaultsWhereWhatIsMeasuredIsLost) {
    Heated plant{{}};
    plant.startPid();
    plant.tree().at("/room").slot().quality = Quality::Lost;
    plant.step(2);
    EXPECT_EQ(plant.state("/pid"), State::Fault);
}

// A block from a measured temperature to one that is passed on.
struct Passed : Rig {
    explicit Passed(const std::string& type, const std::string& result, const Pairs& settings) {
        add("/source", "MeasuredTemperature");
        add("/result", result);
        add("/block", type, {{"source", "/source"}, {"result", "/result"}}, settings);
        start();
        startUp();
    }
    void feed(double value) { tree().at("/source").data<double>("value") = value; }
    double result() { return get<double>("/result", "value"); }
};

TEST(ARateLimiter, GoesNoFasterThanItsRateAndThenFollows) {
    Passed plant{"RateLimiter", "Temperature", {{"rate", "5"}}};
    plant.feed(1);
    for (int cycle = 1; cycle < 200; ++cycle) {
        plant.step();
        ASSERT_NEAR(plant.result(), 5 * cycle * cycleTime, nearly) << cycle;
        ASSERT_TRUE(plant.get<bool>("/block", "limiting"));
    }
    plant.step(2);
    EXPECT_EQ(plant.result(), 1);
    EXPECT_FALSE(plant.get<bool>("/block", "limiting"));
}

TEST(AFilter, AnswersAStepByAnExponential) {
    Passed plant{"Filter", "Temperature", {{"timeConstant", "0.2"}}};
    plant.feed(10);
    for (int cycle = 1; cycle <= 1000; ++cycle) {
        plant.step();
        ASSERT_NEAR(plant.result(), 10 * (1 - std::exp(-cycle * cycleTime / 0.2)), nearly) << cycle;
    }
}

TEST(AFilter, BeginsAtItsSourceWhereItObservesAndAtWhatStandsWhereItDemands) {
    Passed observed{"Filter", "MeasuredTemperature", {}};
    EXPECT_EQ(observed.call("/block", "shutdown").outcome, Outcome::Done);
    observed.feed(50);
    observed.step(5);
    observed.startUp();
    EXPECT_EQ(observed.result(), 50);

    Passed demanded{"Filter", "Temperature", {}};
    demanded.step(5);
    demanded.feed(50);
    demanded.step();
    EXPECT_LT(demanded.result(), 1);
}

TEST(AFilter, PassesOnAtOnceWithoutATimeConstant) {
    Passed plant{"Filter", "Temperature", {{"timeConstant", "0"}}};
    plant.feed(7);
    plant.step();
    EXPECT_EQ(plant.result(), 7);
}

TEST(AFilter, BeginsAnewAfterASourceThatWasNoNumber) {
    for (const double none :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Passed plant{"Filter", "MeasuredTemperature", {{"timeConstant", "0.2"}}};
        plant.feed(20);
        plant.step(10);
        plant.feed(none);
        plant.step(10);
        EXPECT_FALSE(std::isfinite(plant.result()));
        EXPECT_EQ(plant.tree().at("/result").slot().quality, Quality::Bad);
        plant.feed(20);
        plant.step();
        EXPECT_EQ(plant.result(), 20);
        EXPECT_EQ(plant.tree().at("/result").slot().quality, Quality::Good);
        plant.feed(30);
        plant.step();
        EXPECT_NEAR(plant.result(), 30 - 10 * std::exp(-cycleTime / 0.2), nearly);
    }
}

TEST(ARateLimiter, GoesOnFromWhatStoodAfterASourceThatWasNoNumber) {
    Passed plant{"RateLimiter", "MeasuredTemperature", {{"rate", "1"}}};
    plant.step(10);
    plant.feed(std::numeric_limits<double>::quiet_NaN());
    plant.step(10);
    EXPECT_EQ(plant.result(), 0);
    EXPECT_EQ(plant.tree().at("/result").slot().quality, Quality::Bad);
    plant.feed(50);
    for (int cycle = 1; cycle <= 100; ++cycle) {
        plant.step();
        ASSERT_NEAR(plant.result(), cycle * cycleTime, nearly);
    }
}

TEST(ABlock, TakesOneUnitForItsSourceAndItsResult) {
    for (const char* type : {"RateLimiter", "Filter"}) {
        Rig rig;
        rig.add("/source", "MeasuredTemperature");
        rig.add("/result", "Heating");
        rig.add("/block", type, {{"source", "/source"}, {"result", "/result"}});
        try {
            rig.start();
            ADD_FAILURE() << type << " took Cel for %";
        } catch (const ModelError& error) {
            EXPECT_NE(std::string{error.what()}.find("Cel"), std::string::npos) << error.what();
        }
    }
}

struct Ramped : Rig {
    Ramped() {
        add("/heater", "Heating");
        add("/ramp", "Ramp", {{"result", "/heater"}}, {{"rate", "20"}});
        start();
        startUp();
    }
    double heat() { return get<double>("/heater", "value"); }
    CallResult goTo(double target) { return call("/ramp", "goTo", {{"target", target}}); }
};

TEST(ARamp, LeadsToItsTargetAtItsRate) {
    Ramped plant;
    plant.cluster().send("/ramp", "goTo", {{"target", 1.0}});
    plant.step();
    const double first = plant.heat();
    for (int cycle = 1; cycle <= 40; ++cycle) {
        plant.step();
        ASSERT_NEAR(plant.heat(), first + 20 * cycle * cycleTime, nearly) << cycle;
        ASSERT_NEAR(plant.get<double>("/ramp", "remaining"), (1 - plant.heat()) / 20, nearly);
    }
    plant.step(20);
    EXPECT_EQ(plant.heat(), 1);
    EXPECT_EQ(plant.get<std::int64_t>("/ramp", "outcome"),
              static_cast<std::int64_t>(Outcome::Done));
}

TEST(ARamp, RefusesATargetThatTheDemandMayNotHave) {
    Ramped plant;
    const CallResult result = plant.goTo(140);
    EXPECT_EQ(result.outcome, Outcome::Rejected);
    EXPECT_NE(result.text().find("target is 140, above 100, the limit of /heater.value"),
              std::string::npos)
        << result.text();
}

TEST(ARamp, KeepsWhatItHasReachedWhereItIsCancelled) {
    Ramped plant;
    plant.cluster().send("/ramp", "goTo", {{"target", 90.0}});
    plant.step(100);
    plant.call("/ramp", "cancel");
    const double reached = plant.heat();
    plant.step(100);
    EXPECT_EQ(plant.heat(), reached);
    EXPECT_GT(reached, 1);
    EXPECT_LT(reached, 5);
}

struct Watched : Rig {
    Watched() {
        add("/first", "MeasuredTemperature");
        add("/second", "Heartbeat");
        add("/ok", "DigitalIoConcept");
    }
    void watch(const std::string& item) {
        add("/watchdog", "Watchdog", {{"watched", "/second"}, {"ok", "/ok"}},
            {{"item", item}, {"timeout", "0.05"}});
        start();
        startUp();
    }
    void beat() {
        ++count_;
        tree().at("/second").data<std::int64_t>("count") = count_;
        step();
    }
    bool ok() { return get<bool>("/ok", "value"); }

private:
    std::int64_t count_ = 0;
};

TEST(AWatchdog, IsOffOnceACounterStandsStillForItsTimeout) {
    Watched plant;
    plant.watch("count");
    for (int i = 0; i < 100; ++i) {
        plant.beat();
        ASSERT_TRUE(plant.ok()) << i;
    }
    plant.step(50);
    EXPECT_TRUE(plant.ok());
    EXPECT_NEAR(plant.get<double>("/watchdog", "lastChange"), 0.05, nearly);
    plant.step();
    EXPECT_FALSE(plant.ok());
    EXPECT_EQ(plant.get<std::int64_t>("/watchdog", "failing"), 1);
    plant.beat();
    EXPECT_TRUE(plant.ok());
}

TEST(AWatchdog, IsOffWhereWhatItWatchesIsNotGood) {
    Watched plant;
    plant.watch("");
    plant.step();
    EXPECT_TRUE(plant.ok());
    for (const Quality quality : {Quality::Stale, Quality::Bad, Quality::Lost}) {
        plant.tree().at("/second").slot().quality = quality;
        plant.step();
        EXPECT_FALSE(plant.ok()) << name(quality);
        EXPECT_EQ(plant.cluster().image().quality("/ok"), Quality::Good) << "it vouches for it";
    }
}

// All blocks in one plant, fed by a wave: what they say in the end, on so many threads.
std::string saidOnThreads(std::uint32_t threads) {
    ClassRegistry registry;
    addClasses(registry);
    const std::vector<std::filesystem::path> files{
        CORTEX_SOURCE_DIR "/ontology/cortex-morphology.xml",
        CORTEX_SOURCE_DIR "/tests/data/process-types.xml"};
    SimplexTree tree = SimplexTree::load(files, &registry);
    cs::ClusterCS cluster{"blocks", {.threads = threads}};
    cs::ClusterTesting::set(cluster, {.forceThreads = true, .chunkSize = 1});
    SystemDescription system;
    const auto add = [&system](const std::string& path, const char* type,
                               const Rig::Pairs& relates = {}) {
        SystemDescription::SimplexEntry entry;
        entry.path = path;
        entry.type = type;
        for (const auto& [rule, to] : relates)
            entry.relates.push_back({rule, to, false, false, {}});
        system.simplexes.push_back(entry);
    };
    add("/room", "MeasuredTemperature");
    add("/wish", "Temperature");
    add("/smooth", "MeasuredTemperature");
    add("/slow", "Temperature");
    add("/heater", "Heating");
    add("/other", "Heating");
    add("/ok", "DigitalIoConcept");
    add("/filter", "Filter", {{"source", "/room"}, {"result", "/smooth"}});
    add("/limiter", "RateLimiter", {{"source", "/wish"}, {"result", "/slow"}});
    add("/pid", "PidController",
        {{"measured", "/smooth"}, {"setpoint", "/slow"}, {"output", "/heater"}});
    add("/ramp", "Ramp", {{"result", "/other"}});
    add("/watchdog", "Watchdog", {{"watched", "/smooth"}, {"ok", "/ok"}});
    Report report;
    tree.add(system, &registry, report);
    if (!report.ok()) throw ModelError(std::move(report));
    cluster.addSimplexTree(tree);
    auto& trigger = cluster.setTriggerSource<cs::ManualTrigger>(std::chrono::milliseconds{1});
    cluster.start();
    cluster.send("/blocks", "startup", {{"prefix", std::string{"/"}}});
    cluster.send("/ramp", "goTo", {{"target", 3.0}});
    for (int i = 0; i < 2000; ++i) {
        tree.at("/room").data<double>("value") = 20 + 5 * std::sin(0.01 * i);
        tree.at("/wish").data<double>("value") = 25 + (i / 500);
        if (i == 10) cluster.send("/ramp", "goTo", {{"target", 3.0}});
        trigger.step();
    }
    std::string said;
    const Image image = cluster.image();
    for (const char* path : {"/smooth", "/slow", "/heater", "/other"})
        said += toText(image.get<double>(path, "value")) + " ";
    cluster.stop();
    return said + toText(image.get<double>("/pid", "integral"));
}

TEST(AllBlocks, GiveTheSameBitsOnOneTwoAndFourThreads) {
    const std::string one = saidOnThreads(1);
    EXPECT_EQ(one.find("0 0 0 0"), std::string::npos) << one;
    EXPECT_EQ(saidOnThreads(2), one);
    EXPECT_EQ(saidOnThreads(4), one);
}

}  // namespace
}  // namespace cortex::toolkit::test
