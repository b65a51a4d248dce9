// SPDX-License-Identifier: Apache-2.0
// Whoever writes a demand: what goes out in each state of its writer, and what is told.
#include "support/safe_plant.hpp"

#include <cstddef>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

enum class Place { LoopStart, Standby, Fault, LoopEnd, Handler };
enum class When { Standby, Fault, Loss };

struct Case {
    const char* name;
    Place place;
    When when;
};

// Writes what is not safe in one place of the controller, in each cycle of which that is part.
void writeAt(SafePlant& plant, Place place) {
    const auto write = [&plant](Probe&, const Tick&) { plant.write(2, 1.5, 9); };
    const auto writeTrue = [&plant](Probe&, const Tick&) {
        plant.write(2, 1.5, 9);
        return true;
    };
    if (place == Place::LoopStart) plant.controller.onLoopStart = write;
    if (place == Place::Standby) plant.controller.onStandby = write;
    if (place == Place::Fault) plant.controller.onFault = writeTrue;
    if (place == Place::LoopEnd) plant.controller.onLoopEnd = write;
    if (place == Place::Handler)
        plant.controller.onPoke = [&plant](Probe&, Call&) {
            plant.write(2, 1.5, 9);
            return Outcome::Done;
        };
}

class DemandsAtRest : public testing::TestWithParam<std::tuple<Case, bool>> {};

TEST_P(DemandsAtRest, AreSafeInEveryCycleWhoeverWrites) {
    const auto& [each, shared] = GetParam();
    SafePlant plant{shared};
    plant.start();
    if (each.when != When::Standby) plant.startUp();
    if (each.when == When::Fault) plant.faults = true;
    if (each.when == When::Loss) plant.lost = true;
    plant.cluster.step();
    plant.seen.clear();
    writeAt(plant, each.place);

    for (int i = 0; i < 20; ++i) {
        if (each.place == Place::Handler) plant.cluster.cluster->send("/ctl", "poke");
        plant.cluster.step();
    }

    const double held = each.when == When::Standby ? 0 : 7;
    ASSERT_EQ(plant.seen.size(), 20U);
    for (const Seen& seen : plant.seen) {
        EXPECT_EQ(seen.position, 0.25);  // observed
        EXPECT_EQ(seen.velocity, 0);     // given
        EXPECT_EQ(seen.current, held);   // hold
    }
    const std::string in = each.when == When::Fault ? "Fault" : "Standby";
    const std::string who = each.place == Place::Handler ? "a handler" : "a hook or handler";
    EXPECT_EQ(plant.events("/ctl: what " + who +
                           " wrote to current of /d does not go out: "
                           "in " +
                           in + " it is its safe value"),
              each.when == When::Loss ? 0U : 1U);
}

INSTANTIATE_TEST_SUITE_P(
    Places, DemandsAtRest,
    testing::Combine(testing::Values(Case{"LoopStartInStandby", Place::LoopStart, When::Standby},
                                     Case{"LoopStartInFault", Place::LoopStart, When::Fault},
                                     Case{"LoopStartByLoss", Place::LoopStart, When::Loss},
                                     Case{"StateStandby", Place::Standby, When::Standby},
                                     Case{"StateFault", Place::Fault, When::Fault},
                                     Case{"LoopEndInStandby", Place::LoopEnd, When::Standby},
                                     Case{"LoopEndInFault", Place::LoopEnd, When::Fault},
                                     Case{"LoopEndByLoss", Place::LoopEnd, When::Loss},
                                     Case{"HandlerInStandby", Place::Handler, When::Standby},
                                     Case{"HandlerInFault", Place::Handler, When::Fault},
                                     Case{"HandlerByLoss", Place::Handler, When::Loss}),
                     testing::Bool()),
    [](const auto& each) {
        return std::string{std::get<0>(each.param).name} +
               (std::get<1>(each.param) ? "OfTwoWriters" : "");
    });

TEST(DemandsAtRestEvents, ComeOnceAStay) {
    SafePlant plant;
    writeAt(plant, Place::LoopEnd);
    plant.start();
    plant.cluster.step(5);
    plant.startUp();
    plant.cluster.call("/ctl", "shutdown");
    plant.cluster.step(5);

    EXPECT_EQ(plant.events("what a hook or handler wrote"), 2U);
}

TEST(DemandsAtRestEvents, AreNotForARampNorForAHookThatWritesTheSafeValueItself) {
    SafePlant plant;
    plant.controller.onLoopEnd = [&plant](Probe& self, const Tick&) {
        const bool standby = self.state() == State::Standby;
        if (self.state() != State::Active) plant.write(0.25, -0.0, standby ? 0 : 7);
    };
    plant.start();
    plant.startUp();
    plant.position = 1;
    plant.cluster.step(500);
    plant.faults = true;
    plant.cluster.step(50);
    plant.controller.onLoopEnd = nullptr;
    plant.cluster.step(50);

    EXPECT_NEAR(plant.seen.back().position, 0.8, 0.01) << "on its way";
    EXPECT_EQ(plant.events("what a hook or handler wrote"), 0U);
}

// A word that leads a drive out of its fault, and the speed beside it.
TEST(DemandsAtRestOfTheirWriter, GoOutInStandbyAndFaultWithinTheirRange) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    cluster.tree.relate(probe, "out", cluster.tree.add("/d", "DriveWord"));
    std::int64_t word = 6;
    probe.onPopulate = [&](Probe& self) {
        Data<std::int64_t> out = self.output("out").data<std::int64_t>("word");
        Data<double> speed = self.output("out").data<double>("speed");
        self.onLoopEnd = [&, out, speed](Probe&, const Tick&) mutable {
            out = word;
            speed = 3;
        };
        self.onActive = [](Probe& active, const Tick&) { active.fault(1, "asked for"); };
    };
    cluster.start();
    cluster.step(2);
    EXPECT_EQ(cluster.integer("/d", "word"), 6);
    EXPECT_EQ(cluster.number("/d", "speed"), 0);
    cluster.cluster->send("/a", "startup");
    cluster.step(5);
    ASSERT_EQ(cluster.state("/a"), State::Fault);
    word = 99;
    cluster.step();

    EXPECT_EQ(cluster.integer("/d", "word"), 15);
    EXPECT_EQ(cluster.number("/d", "speed"), 0);
    EXPECT_EQ(cluster.quality("/d"), Quality::Stale);
}

TEST(DemandsAtRestOfTheirWriter, BecomeSafeOnceWhenItsSimplexGoesToRest) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    cluster.tree.relate(probe, "out", cluster.tree.add("/d", "DriveWord"));
    probe.onPopulate = [](Probe& self) {
        Data<std::int64_t> out = self.output("out").data<std::int64_t>("word");
        self.onActive = [out](Probe&, const Tick&) mutable { out = 7; };
    };
    cluster.start();
    cluster.startup(probe);
    EXPECT_EQ(cluster.integer("/d", "word"), 7);
    cluster.call("/a", "shutdown");

    EXPECT_EQ(cluster.integer("/d", "word"), 0);
}

TEST(DemandsOnTheWay, GoOnToTheirSafeValuesInShuttingDown) {
    SafePlant plant;
    plant.start();
    plant.startUp();
    plant.position = 1;
    plant.cluster.step(500);
    plant.controller.onShuttingDown = [](Probe&, const Tick&) { return false; };
    const auto limits = plant.cluster.integer("/test", "limitCount");
    plant.cluster.cluster->send("/ctl", "shutdown");
    plant.cluster.step(101);
    EXPECT_NEAR(plant.seen.back().position, 0.8, 0.01);
    plant.cluster.step(400);

    EXPECT_EQ(plant.cluster.state("/ctl"), State::ShuttingDown);
    EXPECT_EQ(plant.seen.back().position, 0.25);
    EXPECT_EQ(plant.cluster.integer("/test", "limitCount"), limits) << "no event of the plant";
}

TEST(DemandsOnTheWay, GoOnToTheirSafeValuesInStartingUp) {
    SafePlant plant;
    plant.start();
    plant.observed = 1;
    plant.controller.onStartingUp = [](Probe&, const Tick&) { return false; };
    plant.cluster.step(5);
    EXPECT_EQ(plant.seen.back().position, 0.25) << "latched before the first start";
    plant.cluster.cluster->send("/ctl", "startup");
    plant.cluster.step(400);

    EXPECT_EQ(plant.cluster.state("/ctl"), State::StartingUp);
    EXPECT_EQ(plant.seen.back().position, 1);
}

TEST(DemandsOnTheWay, StayWhereAHookMovedThemAndAreLatchedAnewAtStandby) {
    SafePlant plant;
    plant.start();
    plant.startUp();
    int calls = 0;
    plant.controller.onShuttingDown = [&](Probe&, const Tick&) {
        if (++calls == 1) plant.write(0.251, 1, 7);
        return calls == 20;
    };
    plant.cluster.cluster->send("/ctl", "shutdown");
    plant.cluster.step(15);
    EXPECT_EQ(plant.cluster.state("/ctl"), State::ShuttingDown);
    EXPECT_EQ(plant.seen.back().position, 0.251);
    EXPECT_EQ(plant.seen.back().velocity, 1);
    plant.cluster.step(15);

    EXPECT_EQ(plant.cluster.state("/ctl"), State::Standby);
    EXPECT_EQ(plant.seen.back().position, 0.25);
    EXPECT_EQ(plant.seen.back().velocity, 0);
}

TEST(DemandsOnTheWay, MayBeMovedByACommandToo) {
    SafePlant plant;
    writeAt(plant, Place::Handler);
    plant.start();
    plant.startUp();
    plant.controller.onShuttingDown = [](Probe&, const Tick&) { return false; };
    plant.cluster.cluster->send("/ctl", "shutdown");
    plant.cluster.step(2);
    plant.cluster.call("/ctl", "poke");
    plant.cluster.step(5);

    EXPECT_EQ(plant.seen.back().velocity, 1.5);
}

TEST(DemandsOnTheWay, AreSafeByLossWhileTheirWriterStartsUp) {
    SafePlant plant;
    plant.controller.onStartingUp = [&](Probe&, const Tick&) {
        plant.write(0.25, 1.5, 9);
        return false;
    };
    plant.start();
    plant.cluster.startup(plant.sensor);
    plant.cluster.cluster->send("/ctl", "startup");
    plant.cluster.step(5);
    EXPECT_EQ(plant.seen.back().velocity, 1.5);
    plant.lost = true;
    plant.cluster.step(2);

    EXPECT_EQ(plant.cluster.state("/ctl"), State::StartingUp);
    EXPECT_EQ(plant.seen.back().velocity, 0);
    plant.lost = false;
    plant.cluster.step(2);
    EXPECT_EQ(plant.seen.back().velocity, 1.5);
}

TEST(DemandsOnTheWay, OutOfTheirRangeFaultWhereTheItemSaysSo) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    cluster.tree.relate(probe, "out", cluster.tree.add("/s", "StrictSignal"));
    probe.onPopulate = [](Probe& self) {
        Data<double> out = self.output("out").data<double>("value");
        self.onShuttingDown = [out](Probe&, const Tick&) mutable {
            out = 1.5;
            return false;
        };
    };
    cluster.start();
    cluster.startup(probe);
    cluster.cluster->send("/a", "shutdown");
    cluster.step(3);

    EXPECT_EQ(cluster.state("/a"), State::Fault);
    EXPECT_EQ(cluster.integer("/a", "faultCode"), -4);
    EXPECT_TRUE(cluster.hasEvent("/a: value of /s limited from 1.5 to 1"));
    EXPECT_EQ(cluster.number("/s", "value"), 0);
}

TEST(DemandsAtRestDevices, WriteTheirObservationsInEveryState) {
    SafePlant plant;
    plant.start();
    plant.observed = 0.5;
    plant.cluster.step();
    EXPECT_EQ(plant.cluster.number("/o", "position"), 0.5);
    plant.drive.onLoopStart = [](Probe& self, const Tick&) { self.fault(4, "broken"); };
    plant.cluster.step();
    plant.observed = 0.75;
    plant.cluster.step();

    EXPECT_EQ(plant.cluster.state("/drive"), State::Fault);
    EXPECT_EQ(plant.cluster.number("/o", "position"), 0.75);
}

}  // namespace

}  // namespace cortex::test
