// SPDX-License-Identifier: Apache-2.0
// What a demand says about itself: value, quality, cause and stamp in each situation of its writer.
#include "cortex/core/error.hpp"
#include "cortex/core/loopback.hpp"

#include "support/safe_plant.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

enum class Stamp { Now, Old };

struct Row {
    const char* name;
    const char* rule;  // of the controller's input
    void (*arrange)(SafePlant&);
    double velocity;  // given as 0, 1 in Active
    Quality quality;
    const char* cause;
    Stamp stamp;
    bool lost;
};

void start(SafePlant& plant) {
    plant.start();
    plant.startUp();
}

void passing(SafePlant& plant, const char* command, bool moves) {
    const auto hook = [&plant, moves](Probe&, const Tick&) {
        if (moves) plant.write(0.25, 0.5, 7);
        return false;
    };
    plant.controller.onStartingUp = plant.controller.onShuttingDown = hook;
    plant.cluster.cluster->send("/ctl", command);
    plant.cluster.step(3);
}

void lose(SafePlant& plant, int cycles) {
    start(plant);
    plant.lost = true;
    plant.cluster.step(cycles);
}

const std::vector<Row> rows{
    {"StandbyBeforeTheFirstStart", "guarded", [](SafePlant& plant) { plant.start(); }, 0,
     Quality::Stale, "/ctl", Stamp::Now, false},
    {"StartingUp", "guarded",
     [](SafePlant& plant) {
         plant.start();
         passing(plant, "startup", false);
     },
     0, Quality::Stale, "/ctl", Stamp::Now, false},
    {"ShuttingDown", "guarded",
     [](SafePlant& plant) {
         start(plant);
         passing(plant, "shutdown", false);
     },
     0, Quality::Stale, "/ctl", Stamp::Now, false},
    {"ShuttingDownMovedByAHook", "guarded",
     [](SafePlant& plant) {
         start(plant);
         passing(plant, "shutdown", true);
     },
     0.5, Quality::Stale, "/ctl", Stamp::Old, false},
    {"ActiveInputsGood", "guarded", start, 1, Quality::Good, "none", Stamp::Old, false},
    {"ActiveLostSafe", "guarded", [](SafePlant& plant) { lose(plant, 3); }, 0, Quality::Stale,
     "/ctl", Stamp::Now, false},
    {"ActiveLostHold", "held", [](SafePlant& plant) { lose(plant, 3); }, 1, Quality::Stale,
     "/sensor", Stamp::Old, false},
    {"ActiveLostHoldForLong", "held", [](SafePlant& plant) { lose(plant, 100); }, 1, Quality::Stale,
     "/sensor", Stamp::Old, true},
    {"ActiveLostPropagate", "in", [](SafePlant& plant) { lose(plant, 3); }, 1, Quality::Lost,
     "/sensor", Stamp::Old, true},
    {"LostFaultInThatCycle", "vital", [](SafePlant& plant) { lose(plant, 1); }, 0, Quality::Stale,
     "/ctl", Stamp::Now, false},
    {"Fault", "guarded",
     [](SafePlant& plant) {
         start(plant);
         plant.faults = true;
         plant.cluster.step(3);
     },
     0, Quality::Stale, "/ctl", Stamp::Now, false},
    {"FaultWithALostInput", "in",
     [](SafePlant& plant) {
         lose(plant, 3);
         plant.faults = true;
         plant.cluster.step(100);
     },
     0, Quality::Stale, "/ctl", Stamp::Now, false},
    {"FaultAfterAThrow", "guarded",
     [](SafePlant& plant) {
         start(plant);
         plant.controller.onActive = [](Probe&, const Tick&) { throw std::runtime_error{"no"}; };
         plant.cluster.step();
     },
     0, Quality::Stale, "/ctl", Stamp::Now, false},
    {"FaultAfterWhatIsNoNumber", "guarded",
     [](SafePlant& plant) {
         start(plant);
         plant.velocity = std::numeric_limits<double>::quiet_NaN();
         plant.cluster.step();
     },
     0, Quality::Stale, "/ctl", Stamp::Now, false},
    {"StandbyWhoeverSaysItIsGood", "guarded",
     [](SafePlant& plant) {
         plant.controller.onLoopEnd = [](Probe& self, const Tick& tick) {
             self.setQuality(Quality::Good, tick.nominalTime / 2);
         };
         plant.start();
     },
     0, Quality::Stale, "/ctl", Stamp::Now, false},
};

class DemandQuality : public testing::TestWithParam<Row> {};

TEST_P(DemandQuality, IsWhatTheTableOfTheDocumentsSays) {
    const Row& row = GetParam();
    SafePlant plant{false, row.rule};
    row.arrange(plant);

    const Seen& seen = plant.seen.back();
    EXPECT_EQ(seen.velocity, row.velocity);
    EXPECT_EQ(seen.state.quality, row.quality) << name(seen.state.quality);
    EXPECT_EQ(plant.pathOf(seen.state.cause), row.cause);
    const bool now = seen.state.time == plant.cluster.cluster->image().nominalTime();
    EXPECT_EQ(now, row.stamp == Stamp::Now) << seen.state.time;
    EXPECT_EQ(seen.lost, row.lost);
}

INSTANTIATE_TEST_SUITE_P(Rows, DemandQuality, testing::ValuesIn(rows),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(DemandQualityOfAWriter, StaysWhatFollowsFromItsStateAndInputs) {
    SafePlant plant{false, "in"};
    lose(plant, 3);
    EXPECT_EQ(plant.cluster.quality("/ctl"), Quality::Lost);
    plant.lost = false;
    plant.faults = true;
    plant.cluster.step();

    EXPECT_EQ(plant.cluster.quality("/ctl"), Quality::Bad);
    EXPECT_EQ(plant.cluster.quality("/d"), Quality::Stale);
}

TEST(DemandQualityOfALoss, NeverLosesTheDemandHoweverLongASensorIsGone) {
    SafePlant plant;
    lose(plant, 10'000);

    for (const Seen& seen : plant.seen) EXPECT_FALSE(seen.lost);
    EXPECT_EQ(plant.seen.back().state.quality, Quality::Stale);
}

TEST(DemandQualityOfASlowWriter, IsStaleBeforeItsFirstRunToo) {
    for (const bool shared : {false, true}) {
        SafePlant plant{shared};
        plant.controller.runEvery(500, 499);
        if (shared) plant.cluster.tree.at("/other").runEvery(500, 499);
        plant.start();

        for (const Seen& seen : plant.seen) {
            EXPECT_EQ(seen.velocity, 0);
            EXPECT_EQ(seen.state.quality, Quality::Stale) << shared;
            EXPECT_NE(plant.pathOf(seen.state.cause), "none") << "a writer of it";
        }
        EXPECT_EQ(plant.seen.size(), 5U);
        EXPECT_EQ(plant.cluster.quality("/d"), Quality::Stale);
    }
}

// Of a shared demand: the safe value goes out in the cycle of the refusal, and says so.
TEST(DemandQualityOfARefusal, IsStaleAtOnce) {
    SafePlant plant{true};
    start(plant);
    ASSERT_EQ(plant.seen.back().state.quality, Quality::Good);
    plant.velocity = std::numeric_limits<double>::infinity();
    plant.cluster.step();

    EXPECT_EQ(plant.seen.back().velocity, 0);
    EXPECT_EQ(plant.seen.back().state.quality, Quality::Stale);
    EXPECT_EQ(plant.pathOf(plant.seen.back().state.cause), "/ctl");
}

// A valve that should open when nobody controls it, and its controller in another agent.
struct FarValve {
    LoopbackHub hub;
    ProbeCluster desk{{}, "desk"}, cell{{}, "cell"};
    Probe& controller = desk.probe("/ctl");
    Probe& valve = cell.probe("/valve");
    Data<double> demanded;
    Data<const double> opening;
    double safe = 0;
    bool lost = false, faults = false;

    FarValve() {
        desk.tree.relate(controller, "out", desk.tree.add("/v", "Valve"));
        controller.onPopulate = [this](Probe& self) {
            demanded = self.output("out").data<double>("opening");
        };
        controller.onActive = [this](Probe& self, const Tick&) {
            demanded = 40;
            if (faults) self.fault(3, "asked for");
        };
        desk.cluster->adoptInterface(hub.makeInterface());
        cell.tree.relateRemote(valve, "in", "/v", "Valve");
        valve.onPopulate = [this](Probe& self) {
            opening = self.input("in").data<double>("opening");
            safe = self.input("in").safeValue<double>("opening", "%");
        };
        valve.onLoopStart = [this](Probe& self, const Tick&) { lost = self.inputLost(); };
        cell.cluster->adoptInterface(hub.makeInterface());
    }
    void step(int cycles) {
        for (int i = 0; i < cycles; ++i) {
            desk.step();
            cell.step();
        }
    }
};

TEST(DemandQualityOfALink, IsLostAndTheValueSafeBeforeTheFirstSample) {
    FarValve plant;
    plant.cell.start();
    plant.cell.step(5);

    EXPECT_EQ(plant.opening.get(), 100);
    EXPECT_EQ(plant.cell.quality("/v"), Quality::Lost);
    EXPECT_TRUE(plant.lost);
}

TEST(DemandQualityOfALink, IsStaleWhileItsControllerIsInFault) {
    FarValve plant;
    plant.desk.start();
    plant.cell.start();
    plant.step(5);
    plant.desk.startup(plant.controller);
    plant.step(5);
    EXPECT_EQ(plant.opening.get(), 40);
    EXPECT_EQ(plant.cell.quality("/v"), Quality::Good);
    plant.faults = true;
    plant.step(100);

    EXPECT_EQ(plant.opening.get(), 100);
    EXPECT_EQ(plant.cell.quality("/v"), Quality::Stale);
    EXPECT_FALSE(plant.lost);
}

TEST(DemandQualityOfALink, IsLostWithTheLastValueWhenItsAgentIsGone) {
    FarValve plant;
    plant.desk.start();
    plant.cell.start();
    plant.step(5);
    plant.desk.startup(plant.controller);
    plant.step(5);
    plant.hub.setConnected("desk", false);
    plant.cell.step(100);

    EXPECT_EQ(plant.opening.get(), 40);
    EXPECT_EQ(plant.cell.quality("/v"), Quality::Lost);
    EXPECT_TRUE(plant.lost);
    EXPECT_EQ(plant.safe, 100);
}

TEST(SafeValueOfADemand, IsRefusedWhereItsTypeGivesNone) {
    FarValve plant;
    plant.valve.onPopulate = [](Probe& self) {
        EXPECT_THROW(self.input("in").safeValue<double>("opening", "m"), Error);
        EXPECT_THROW(self.input("in").safeValue<bool>("opening"), Error);
        try {
            self.input("in").safeValue<double>("last");
            ADD_FAILURE() << "it is hold";
        } catch (const Error& error) {
            EXPECT_NE(std::string{error.what()}.find("/v.last has no safe value"),
                      std::string::npos)
                << error.what();
        }
    };
    plant.cell.start();
}

}  // namespace

}  // namespace cortex::test
