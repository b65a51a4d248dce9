// SPDX-License-Identifier: Apache-2.0
// What a demand becomes on each way out of Active and back, for value, hold and observed.
#include "support/probe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

constexpr double period = 1e-3;
constexpr double rate = 2;  // rad/s, of Demand.position

// A controller that follows a sine, and a drive that lags behind it by a low pass.
struct Plant {
    ProbeCluster cluster;
    Probe& controller = cluster.probe("/controller");
    Probe& source = cluster.probe("/source");
    Probe& drive = cluster.tree.add<Probe>("/drive", "Probe");
    Data<double> position, velocity, current, observed;
    Data<const double> demanded;
    double wanted = 0;
    double offset = 0;
    bool throws = false, faults = false;

    Plant() {
        Simplex& demand = cluster.tree.add("/demand", "Demand");
        Simplex& observation = cluster.tree.add("/observation", "Observation");
        Simplex& signal = cluster.tree.add("/signal", "Signal");
        cluster.tree.relate(source, "out", signal);
        cluster.tree.relate(controller, "guarded", signal);
        cluster.tree.relate(controller, "observed", observation);
        cluster.tree.relate(controller, "demand", demand);
        cluster.tree.relate(drive, "in", demand);
        cluster.tree.relate(drive, "out", observation, true);
        controller.onPopulate = [this](Probe& self) {
            position = self.output("demand").data<double>("position");
            velocity = self.output("demand").data<double>("velocity");
            current = self.output("demand").data<double>("current");
        };
        controller.onActive = [this](Probe& self, const Tick& tick) {
            wanted = offset + 0.5 * std::sin(2 * tick.seconds());
            position = wanted;
            velocity = std::cos(2 * tick.seconds());
            current = 7;
            if (throws) throw std::runtime_error{"half written"};
            if (faults) self.fault(3, "asked for");
        };
        drive.onPopulate = [this](Probe& self) {
            demanded = self.input("in").data<double>("position");
            observed = self.output("out").data<double>("position");
        };
        drive.onLoopEnd = [this](Probe& self, const Tick&) {
            observed += 0.02 * (demanded - observed);
            self.setQuality(Quality::Good);
        };
        cluster.start();
        cluster.startup(source);
        cluster.startup(controller);
        cluster.step(300);
    }

    double position_() { return cluster.number("/demand", "position"); }

    // Steps and returns the greatest change of the demand from cycle to cycle.
    double greatestStep(int cycles) {
        double greatest = 0;
        double last = position_();
        for (int i = 0; i < cycles; ++i) {
            cluster.step();
            greatest = std::max(greatest, std::abs(position_() - last));
            last = position_();
        }
        return greatest;
    }
};

const double oneCycle = rate * period * (1 + 1e-9);

struct WayOut {
    const char* name;
    void (*leave)(Plant&);
    void (*back)(Plant&);
};

void restart(Plant& plant) {
    plant.throws = plant.faults = false;
    plant.cluster.call("/controller", "clearFaults");
    plant.cluster.cluster->send("/controller", "startup");
}

class SafeDemandsOnEachWayOut : public testing::TestWithParam<WayOut> {};

TEST_P(SafeDemandsOnEachWayOut, NeverStepByMoreThanOneCyclesLimitAndComeToRestAtTheObservation) {
    Plant plant;
    ASSERT_GT(std::abs(plant.position_() - plant.cluster.number("/observation", "position")),
              2 * oneCycle)
        << "the plant must lag for this test to mean anything";

    GetParam().leave(plant);
    EXPECT_LE(plant.greatestStep(50), oneCycle);
    plant.cluster.step(2000);
    EXPECT_EQ(plant.cluster.number("/demand", "velocity"), 0);
    EXPECT_EQ(plant.cluster.number("/demand", "current"), 7);  // hold
    const double rest = plant.position_();
    EXPECT_EQ(plant.greatestStep(50), 0) << "latched, not tracked";
    EXPECT_NEAR(rest, plant.cluster.number("/observation", "position"), 1e-6);

    GetParam().back(plant);
    EXPECT_LE(plant.greatestStep(400), oneCycle);
    EXPECT_NEAR(plant.position_(), plant.wanted, 1e-9) << "follows again";
}

INSTANTIATE_TEST_SUITE_P(
    Ways, SafeDemandsOnEachWayOut,
    testing::Values(WayOut{"shutdown",
                           [](Plant& plant) {
                               plant.cluster.cluster->send("/controller", "shutdown");
                           },
                           restart},
                    WayOut{"fault", [](Plant& plant) { plant.faults = true; }, restart},
                    WayOut{"aThrow", [](Plant& plant) { plant.throws = true; }, restart},
                    WayOut{"lostInput",
                           [](Plant& plant) {
                               plant.source.onActive = [](Probe& self, const Tick&) {
                                   self.setQuality(Quality::Bad);
                               };
                           },
                           [](Plant& plant) { plant.source.onActive = nullptr; }}),
    [](const auto& way) { return std::string{way.param.name}; });

TEST(SafeDemands, AreWrittenInTheCycleOfAThrowOverWhatWasHalfWritten) {
    Plant plant;
    plant.throws = true;
    plant.offset = 100;

    plant.cluster.step();

    EXPECT_EQ(plant.cluster.state("/controller"), State::Fault);
    EXPECT_EQ(plant.cluster.number("/demand", "velocity"), 0);
    EXPECT_LT(std::abs(plant.position_()), 1);
}

TEST(SafeDemands, GoOutWhenADemandIsNotFiniteAndTheWriterFaults) {
    Plant plant;
    const double before = plant.position_();
    plant.offset = std::numeric_limits<double>::quiet_NaN();

    plant.cluster.step();

    EXPECT_EQ(plant.cluster.state("/controller"), State::Fault);
    EXPECT_EQ(plant.cluster.integer("/controller", "faultCode"), -3);
    EXPECT_LE(std::abs(plant.position_() - before), oneCycle);
}

TEST(SafeDemands, StartFromTheObservationBeforeTheFirstStartup) {
    ProbeCluster cluster;
    Probe& controller = cluster.probe("/controller");
    Simplex& demand = cluster.tree.add("/demand", "Demand");
    Simplex& observation = cluster.tree.add("/observation", "Observation");
    observation.set("position", 1.25);
    cluster.tree.relate(controller, "observed", observation);
    cluster.tree.relate(controller, "demand", demand);
    cluster.start();
    cluster.step();

    EXPECT_EQ(cluster.number("/demand", "position"), 1.25);
}

TEST(SafeDemands, AStandbyHookMayNotWriteAfterThem) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    Simplex& signal = cluster.tree.add("/s", "Signal");
    cluster.tree.relate(probe, "out", signal);
    probe.onPopulate = [](Probe& self) {
        Data<double> out = self.output("out").data<double>("value");
        self.onStandby = [out](Probe&, const Tick& tick) mutable {
            if (tick.cycle == 2) out = 9;
        };
    };
    cluster.start();

    cluster.step(2);
    EXPECT_EQ(cluster.number("/s", "value"), 0);
    EXPECT_TRUE(
        cluster.hasEvent("/a: what a hook or handler wrote to value of /s does not go out: in "
                         "Standby it is its safe value"));
}

TEST(SafeDemands, StartupIsRefusedWhileTheObservationIsNotGood) {
    ProbeCluster cluster;
    Probe& controller = cluster.probe("/controller");
    Probe& drive = cluster.probe("/drive");
    Simplex& demand = cluster.tree.add("/demand", "Demand");
    Simplex& observation = cluster.tree.add("/observation", "Observation");
    cluster.tree.relate(controller, "observed", observation);
    cluster.tree.relate(controller, "demand", demand);
    cluster.tree.relate(drive, "out", observation, true);
    cluster.start();
    cluster.step();  // the drive is in Standby and no Device: its observation is stale

    const CallResult result = cluster.call("/controller", "startup");

    EXPECT_NE(result.outcome, Outcome::Done);
    EXPECT_NE(result.why.find("startup needs a good observation of what /demand demands"),
              std::string::npos)
        << result.text();
    EXPECT_EQ(cluster.state("/controller"), State::Standby);
}

TEST(DemandLimits, ClampToTheRangeAreCountedAndOneEventAnEpisode) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    Simplex& signal = cluster.tree.add("/s", "Signal");
    cluster.tree.relate(probe, "out", signal);
    probe.onPopulate = [](Probe& self) {
        Data<double> out = self.output("out").data<double>("value");
        self.onActive = [out](Probe&, const Tick&) mutable { out = 5000; };
    };
    cluster.start();
    cluster.startup(probe);
    cluster.step(9);

    EXPECT_EQ(cluster.number("/s", "value"), 1000);
    EXPECT_GE(cluster.integer("/test", "limitCount"), 9);
    int events = 0;
    for (const std::string& event : cluster.events()) {
        if (event == "/a: value of /s limited from 5000 to 1000") ++events;
    }
    EXPECT_EQ(events, 1);
}

TEST(DemandLimits, OfTheStrokesOfARampAreOneEpisodeThatASecondWithoutOneEnds) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    cluster.tree.relate(probe, "out", cluster.tree.add("/s", "Signal"));
    probe.onPopulate = [](Probe& self) {
        Data<double> out = self.output("out").data<double>("value");
        self.onActive = [out](Probe&, const Tick& tick) mutable {
            const bool stroke = tick.cycle % 10 == 0 && (tick.cycle < 200 || tick.cycle > 1800);
            out = stroke ? 5000.00001 : 0;
        };
    };
    cluster.start();
    cluster.startup(probe);

    cluster.step(100);
    EXPECT_GE(cluster.integer("/test", "limitCount"), 9);
    const std::string said = "/a: value of /s limited from 5000 to 1000";
    EXPECT_EQ(std::ranges::count(cluster.events(), said), 1);

    cluster.step(1800);
    EXPECT_EQ(std::ranges::count(cluster.events(), said), 2);
}

TEST(DemandLimits, FaultWhereTheItemSaysSo) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    Simplex& signal = cluster.tree.add("/s", "StrictSignal");
    cluster.tree.relate(probe, "out", signal);
    probe.onPopulate = [](Probe& self) {
        Data<double> out = self.output("out").data<double>("value");
        self.onActive = [out](Probe&, const Tick&) mutable { out = 1.5; };
    };
    cluster.start();
    cluster.startup(probe);

    EXPECT_EQ(cluster.state("/a"), State::Fault);
    EXPECT_EQ(cluster.integer("/a", "faultCode"), -4);
    EXPECT_EQ(cluster.number("/s", "value"), 0);
}

TEST(DemandLimits, FaultTheWriterOfASharedDemandThatIsNotFinite) {
    ProbeCluster cluster;
    Simplex& signal = cluster.tree.add("/s", "SharedSignal");
    Probe& bad = cluster.probe("/bad");
    Probe& other = cluster.probe("/other");
    for (Probe* probe : {&bad, &other}) cluster.tree.relate(*probe, "out", signal);
    bad.onPopulate = [](Probe& self) {
        Data<double> out = self.output("out").data<double>("value");
        self.onActive = [out](Probe&, const Tick&) mutable {
            out = std::numeric_limits<double>::infinity();
        };
    };
    cluster.start();
    cluster.startup(bad);
    EXPECT_EQ(cluster.number("/s", "value"), 0);

    cluster.step();
    EXPECT_EQ(cluster.state("/bad"), State::Fault);
    EXPECT_TRUE(cluster.hasEvent("/bad: fault -3: value of /s was not a number"));
    EXPECT_EQ(cluster.integer("/test", "limitCount"), 0);
}

TEST(DemandLimits, SayWhereItIsTheRateThatLimits) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    cluster.tree.relate(probe, "demand", cluster.tree.add("/d", "Demand"));
    cluster.tree.relate(probe, "observed", cluster.tree.add("/o", "Observation"));
    probe.onPopulate = [](Probe& self) {
        Data<double> position = self.output("demand").data<double>("position");
        self.onActive = [position](Probe&, const Tick&) mutable { position = 1; };
    };
    cluster.start();
    cluster.startup(probe);

    EXPECT_TRUE(cluster.hasEvent("/a: position of /d limited from 1 to 0.002 rad by its rate"));
}

}  // namespace

}  // namespace cortex::test
