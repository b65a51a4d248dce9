// SPDX-License-Identifier: Apache-2.0
// What follows from the measurements of a device is no older for it than those are, however long it
// is silent: its demands are not lost by that.
#include "support/probe.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

// A device that measures while it is not silent, and a controller that holds what it measured. Both
// allow 50 ms.
struct SilentDevice {
    ProbeCluster cluster;
    Probe& controller = cluster.probe("/controller");
    Probe& device = cluster.probe("/device", "UnlinkedDrive");
    bool isSilent = false, isLostWhenSilent = true;
    int lost = 0;                          // runs of the device in which its demand was lost
    std::int64_t measured = -1, late = 0;  // ns; late: when it tells what it measured

    explicit SilentDevice(int every = 1) {
        cluster.tree.add("/o", "Observation");
        cluster.tree.relate(controller, "held", cluster.tree.at("/o"));
        cluster.tree.relate(controller, "out", cluster.tree.add("/s", "Signal"));
        cluster.tree.relate(device, "in", cluster.tree.at("/s"));
        cluster.tree.relate(device, "measured", cluster.tree.at("/o"));
        if (every > 1) controller.runEvery(every, 0);
        device.onLoopStart = [this](Probe& self, const Tick& tick) {
            if (self.inputLost()) ++lost;
            if (!isSilent) measured = tick.nominalTime - late;
            const bool isAway = isSilent && isLostWhenSilent;
            self.setQuality(isAway ? Quality::Lost : Quality::Good, measured);
        };
    }
    void start() {
        cluster.start();
        cluster.startup(controller);
        cluster.step(300);
        lost = 0;
    }
    // From the next cycle on, the demand grows old by itself.
    void letTheDemandAge() {
        controller.onActive = [since = std::int64_t{-1}](Probe& self, const Tick& tick) mutable {
            if (since < 0) since = tick.nominalTime;
            self.setQuality(Quality::Good, since);
        };
    }
    void beSilentFor(int cycles) {
        isSilent = true;
        cluster.step(cycles);
        isSilent = false;
    }
};

TEST(SilentDevice, HasItsDemandsAllTheTimeAndAfterwards) {
    for (const int every : {1, 10}) {
        for (const bool isLostWhenSilent : {true, false}) {
            SilentDevice plant{every};
            plant.isLostWhenSilent = isLostWhenSilent;
            plant.start();
            for (const int cycles : {10, 60, 1000}) {
                plant.beSilentFor(cycles);
                plant.cluster.step(200);
            }
            EXPECT_EQ(plant.lost, 0) << every << isLostWhenSilent;
        }
    }
}

// As where the loop stood still, too, and looks at it later.
TEST(SilentDevice, HasItsDemandsAlsoWhereItTellsLateWhatItMeasuredFirst) {
    for (const int every : {1, 10}) {
        SilentDevice plant{every};
        plant.start();
        for (const int late : {10, 30, 45}) {
            plant.beSilentFor(100);
            plant.late = late * 1'000'000;
            plant.cluster.step();
            plant.late = 0;
            plant.cluster.step(200);
        }
        EXPECT_EQ(plant.lost, 0) << every;
    }
}

TEST(SilentDevice, LosesADemandThatGrowsOldByItselfMeanwhileOrAfterwards) {
    SilentDevice plant;
    plant.start();
    plant.letTheDemandAge();
    plant.cluster.step(20);
    plant.beSilentFor(500);
    EXPECT_EQ(plant.lost, 0) << "it was 20 ms old";
    plant.cluster.step(60);
    EXPECT_GT(plant.lost, 0);

    plant.controller.onActive = nullptr;
    plant.cluster.step(100);
    plant.lost = 0;
    plant.isSilent = true;
    plant.cluster.step(10);
    plant.letTheDemandAge();
    plant.cluster.step(40);
    EXPECT_EQ(plant.lost, 0);
    plant.cluster.step(40);
    EXPECT_GT(plant.lost, 0) << "it is younger than what was measured last";
}

// The time for which it is silent counts once, also where it tells late what it measured in it.
TEST(SilentDevice, MakesADemandNoYoungerByTellingLate) {
    SilentDevice plant;
    plant.start();
    plant.letTheDemandAge();
    plant.cluster.step(20);
    plant.beSilentFor(500);
    plant.late = 45'000'000;
    plant.cluster.step();
    plant.late = 0;
    EXPECT_EQ(plant.lost, 0) << "it was 20 ms old";
    plant.cluster.step(40);
    EXPECT_GT(plant.lost, 0);
}

TEST(SilentDevice, LosesADemandThatItsControllerCallsLost) {
    SilentDevice plant;
    plant.start();
    plant.controller.onActive = [](Probe& self, const Tick&) { self.setQuality(Quality::Lost); };
    plant.beSilentFor(100);
    EXPECT_GT(plant.lost, 90);
}

}  // namespace
}  // namespace cortex::test
