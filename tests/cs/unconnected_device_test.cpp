// SPDX-License-Identifier: Apache-2.0
// Nobody takes a demand whose device is not connected: it stands, and goes on from there.
#include "support/probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

// A controller of /d, two where it may be shared, and drives that read it.
class TakenDemand {
public:
    static constexpr double period = 1e-3;     // s
    static constexpr double rate = 2;          // rad/s, of each position
    static constexpr double braking = 200;     // rad/s2, of StoppedAxis
    static constexpr double rounding = 1e-12;  // rad

    explicit TakenDemand(const std::string& demand = "Demand",
                         const std::string& drive = "LinkedDrive",
                         const cs::ClusterOptions& options = {})
        : cluster{options}, isArray_{demand == "StoppedAxis"} {
        cluster.tree.add("/d", demand);
        cluster.tree.add("/o", isArray_ ? "StoppedObservation" : "Observation");
        lead(writer);
        if (demand == "SharedDemand") lead(cluster.probe("/other"));
        addDrive("/drive", drive, connected);
    }
    void lead(Probe& by) {
        cluster.tree.relate(by, isArray_ ? "stands" : "observed", cluster.tree.at("/o"));
        cluster.tree.relate(by, isArray_ ? "axis" : "demand", cluster.tree.at("/d"));
    }
    // Its link is as `is` says; one whose type has no such item measures nothing without it.
    void addDrive(const std::string& path, const std::string& type, const bool& is) {
        Probe& drive = cluster.probe(path, type);
        cluster.tree.relate(drive, "in", cluster.tree.at("/d"));
        drive.onPopulate = [&is](Probe& self) {
            constexpr std::int64_t closed = 0, open = 2;
            Data<std::int64_t> link;
            if (self.type().findData("link") != nullptr) link = self.data<std::int64_t>("link");
            self.onLoopEnd = [&is, link](Probe& each, const Tick&) mutable {
                if (link.bound()) link = is ? open : closed;
                if (!link.bound() && !is) each.setQuality(Quality::Lost);
            };
        };
    }
    // The controller writes these from then on.
    void start() {
        writer.onPopulate = [this](Probe& self) {
            const OutputSimplex demand = self.output(isArray_ ? "axis" : "demand");
            if (isArray_) {
                const auto positions = demand.array<double>("position");
                const auto velocities = demand.array<double>("velocity");
                self.onActive = [this, positions, velocities](Probe&, const Tick&) {
                    std::ranges::fill(positions, position);
                    std::ranges::fill(velocities, velocity);
                };
            } else {
                auto first = demand.data<double>("position"),
                     second = demand.data<double>("velocity"),
                     third = demand.data<double>("current");
                self.onActive = [this, first, second, third](Probe&, const Tick&) mutable {
                    first = position;
                    second = velocity;
                    third = current;
                };
            }
        };
        cluster.start();
        cluster.step(3);
        cluster.startup(writer);
    }
    double get(const std::string& item = "position") {
        if (!isArray_) return cluster.number("/d", item);
        return std::get<std::vector<double>>(cluster.cluster->image().value("/d", item))[1];
    }
    std::int64_t count(std::string_view text) {
        return std::ranges::count_if(cluster.events(), [text](const std::string& each) {
            return each.find(text) != std::string::npos;
        });
    }

    ProbeCluster cluster;
    Probe& writer = cluster.probe("/writer");
    double position = 0, velocity = 0, current = 0;
    bool connected = true, otherConnected = true;

private:
    bool isArray_;
};

class UnconnectedDevice : public testing::TestWithParam<std::array<const char*, 2>> {};

TEST_P(UnconnectedDevice, LetsADemandStandThatGoesOnByItsRateFromThere) {
    const auto [demand, drive] = GetParam();
    TakenDemand plant{demand, drive};
    plant.start();
    plant.position = 2;
    plant.cluster.step(200);
    ASSERT_NEAR(plant.get(), 0.4, 0.02) << "on its way";
    plant.connected = false;
    plant.cluster.step();  // in which the drive sees it
    const double stood = plant.get();
    for (int cycle = 0; cycle < 500; ++cycle) {
        plant.cluster.step();
        ASSERT_EQ(plant.get(), stood) << cycle;
    }

    plant.connected = true;
    plant.cluster.step();
    for (double before = stood; before != 2; before = plant.get()) {
        plant.cluster.step();
        ASSERT_LE(plant.get() - before,
                  TakenDemand::rate * TakenDemand::period + TakenDemand::rounding);
        ASSERT_GT(plant.get(), before);
    }
    EXPECT_EQ(plant.count("while"), 0) << "nothing stepped";
}

INSTANTIATE_TEST_SUITE_P(Demands, UnconnectedDevice,
                         testing::Values(std::array{"Demand", "LinkedDrive"},
                                         std::array{"Demand", "UnlinkedDrive"},
                                         std::array{"SharedDemand", "LinkedDrive"},
                                         std::array{"StoppedAxis", "LinkedDrive"}),
                         [](const auto& which) {
                             return std::string{which.param[0]} + "Of" + which.param[1];
                         });

TEST(UnconnectedDevices, LetAVelocityComeToRestByItsOwnRate) {
    TakenDemand plant{"StoppedAxis"};
    plant.start();
    plant.position = 2;
    plant.velocity = TakenDemand::rate;
    plant.cluster.step(300);
    plant.connected = false;
    plant.cluster.step();
    double before = plant.get("velocity");
    ASSERT_EQ(before, TakenDemand::rate);
    int cycles = 0;
    for (; plant.get("velocity") != 0 && cycles < 100; ++cycles) {
        plant.cluster.step();
        ASSERT_LE(std::abs(plant.get("velocity") - before),
                  TakenDemand::braking * TakenDemand::period + TakenDemand::rounding);
        before = plant.get("velocity");
    }
    EXPECT_NEAR(cycles, 10, 1) << TakenDemand::rate << " rad/s at " << TakenDemand::braking
                               << " rad/s2";
}

TEST(UnconnectedDevices, LetADemandGoOnAsLongAsOneOfThemIsConnected) {
    TakenDemand plant;
    plant.addDrive("/spare", "LinkedDrive", plant.otherConnected);
    plant.start();
    plant.position = 2;
    plant.cluster.step(100);
    plant.connected = false;
    plant.cluster.step();
    double before = plant.get();
    plant.cluster.step(10);
    EXPECT_NEAR(plant.get(), before + 10 * TakenDemand::rate * TakenDemand::period,
                TakenDemand::rounding);

    plant.otherConnected = false;
    plant.cluster.step();
    before = plant.get();
    plant.cluster.step(10);
    EXPECT_EQ(plant.get(), before);
}

TEST(UnconnectedDevices, TellTheStepOfWhatHasNoRate) {
    TakenDemand plant;
    plant.connected = false;
    plant.current = 3;
    plant.start();
    plant.connected = true;
    plant.cluster.step(5);
    EXPECT_EQ(plant.count("was not connected"), 0) << "nobody took the one before";
    for (const double next : {3.0, 8.5}) {
        plant.connected = false;
        plant.cluster.step(5);
        plant.current = next;
        plant.cluster.step(5);
        EXPECT_EQ(plant.get("current"), next) << "it has no rate";
        plant.connected = true;
        plant.cluster.step(5);
    }
    EXPECT_EQ(
        plant.count("/writer: current of /d went from 3 to 8.5 while /drive was not connected"), 1);
    EXPECT_EQ(plant.count("was not connected"), 1) << "the first time nothing had changed";
}

TEST(UnconnectedDevices, TellTheStepThatAShutdownMakes) {
    TakenDemand plant;
    plant.velocity = 1.5;
    plant.start();
    plant.cluster.step(5);
    plant.connected = false;
    plant.cluster.step(5);
    plant.cluster.call("/writer", "shutdown");
    plant.cluster.step(5);
    ASSERT_EQ(plant.get("velocity"), 0) << "its safe value";
    plant.connected = true;
    plant.cluster.step(5);
    EXPECT_EQ(plant.count("velocity of /d went from 1.5 to 0 rad/s while /drive was not connected"),
              1);
}

TEST(UnconnectedDevices, AreNamedAtAStopForWhatHasNoRate) {
    for (const bool isConnected : {true, false}) {
        TakenDemand plant;
        plant.velocity = 1.5;
        plant.start();
        plant.cluster.step(5);
        plant.connected = isConnected;
        plant.cluster.step(2);
        EXPECT_TRUE(plant.cluster.cluster->stop());
        EXPECT_EQ(plant.cluster.cluster->notShutDown(), std::vector<std::string>{});
        EXPECT_EQ(plant.count("/d: its safe values were not sent: /drive is not connected"),
                  isConnected ? 0 : 1);
    }
}

TEST(UnconnectedDevices, AreNotWaitedForAtAStop) {
    TakenDemand plant;
    plant.start();
    plant.position = 2;
    plant.cluster.step(500);
    plant.connected = false;
    plant.cluster.step(2);
    const auto before = plant.cluster.cluster->image().cycle();

    EXPECT_TRUE(plant.cluster.cluster->stop());

    EXPECT_LE(plant.cluster.cluster->image().cycle() - before, 10);
    EXPECT_EQ(plant.cluster.cluster->notShutDown(), std::vector<std::string>{});
    EXPECT_EQ(plant.count(" rad, its safe value 0 was not waited for: /drive is not connected"), 1);
}

}  // namespace
}  // namespace cortex::test
