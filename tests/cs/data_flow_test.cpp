// SPDX-License-Identifier: Apache-2.0
// Order, quality, stamps, loss and arbitration between simplexes of one cluster.
#include "cortex/core/loopback.hpp"
#include "cortex/cs/testing.hpp"

#include "support/probe.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

// A writes signal /s, B reads it.
struct Chain {
    ProbeCluster cluster;
    Probe& writer = cluster.probe("/z-writer");
    Probe& reader = cluster.probe("/a-reader");
    Data<double> out;
    Data<const double> in;

    explicit Chain(const char* inputRule = "in", bool delayed = false) {
        Simplex& signal = cluster.tree.add("/s", "Signal");
        cluster.tree.relate(writer, "out", signal);
        cluster.tree.relate(reader, inputRule, signal, delayed);
        writer.onPopulate = [this](Probe& self) { out = self.output("out").data<double>("value"); };
        reader.onPopulate = [this, inputRule](Probe& self) {
            in = self.input(inputRule).data<double>("value");
        };
        writer.onActive = [this](Probe&, const Tick& tick) {
            out = static_cast<double>(tick.cycle);
        };
    }
};

TEST(DataFlow, AWriterRunsBeforeItsReadersWhateverTheirPaths) {
    Chain chain;
    double seen = -1;
    chain.reader.onActive = [&](Probe&, const Tick&) { seen = chain.in; };
    chain.cluster.start();
    chain.cluster.startup(chain.writer);
    chain.cluster.startup(chain.reader);

    chain.cluster.step();

    EXPECT_EQ(seen, static_cast<double>(chain.cluster.cluster->image().cycle()));
}

TEST(DataFlow, ADelayedInputIsOnePeriodOld) {
    Chain chain{"in", true};
    double seen = -1;
    chain.reader.onActive = [&](Probe&, const Tick&) { seen = chain.in; };
    chain.cluster.start();
    chain.cluster.startup(chain.writer);
    chain.cluster.startup(chain.reader);

    chain.cluster.step();

    EXPECT_EQ(seen, static_cast<double>(chain.cluster.cluster->image().cycle() - 1));
}

TEST(DataFlow, QualityFollowsTheWritersState) {
    Chain chain;
    chain.cluster.start();
    chain.cluster.step();
    EXPECT_EQ(chain.cluster.quality("/s"), Quality::Stale);

    chain.cluster.startup(chain.writer);
    EXPECT_EQ(chain.cluster.quality("/s"), Quality::Good);

    chain.writer.onActive = [](Probe& self, const Tick&) { self.fault(1, "broken"); };
    chain.cluster.step();
    EXPECT_EQ(chain.cluster.quality("/z-writer"), Quality::Bad);
    EXPECT_EQ(chain.cluster.quality("/s"), Quality::Stale) << "a demand: its safe value";
}

TEST(DataFlow, ATaskMayOverrideItsQuality) {
    Chain chain;
    chain.writer.onActive = [](Probe& self, const Tick&) { self.setQuality(Quality::Stale); };
    chain.cluster.start();
    chain.cluster.startup(chain.writer);

    EXPECT_EQ(chain.cluster.quality("/s"), Quality::Stale);
    EXPECT_EQ(chain.cluster.quality("/z-writer"), Quality::Stale);
}

TEST(DataFlow, QualitySaidOutsideOfItsOwnHooksDoesNotCount) {
    Chain chain;
    chain.reader.onActive = [&](Probe&, const Tick&) { chain.writer.setQuality(Quality::Bad); };
    chain.cluster.start();
    chain.cluster.startup(chain.writer);
    chain.cluster.startup(chain.reader);

    chain.cluster.step(2);

    EXPECT_EQ(chain.cluster.quality("/z-writer"), Quality::Good);
}

// Any number of tasks ask at once, also for the latch that they share.
TEST(DataFlow, HooksOnSeveralThreadsSeeTheStateOfWhatTheyAreRelatedTo) {
    for (const std::uint32_t threads : {1U, 2U, 4U}) {
        ProbeCluster cluster{{.threads = threads}};
        cs::ClusterTesting::set(*cluster.cluster, {.forceThreads = true, .chunkSize = 1});
        Probe& writer = cluster.probe("/writer");
        std::array<std::int64_t, 8> seen{};
        std::array<std::optional<InputSimplex>, 8> inputs;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            Probe& reader = cluster.probe("/reader" + std::to_string(i));
            cluster.tree.relate(reader, "before", writer, true);
            reader.onPopulate = [&, i](Probe& self) { inputs[i] = self.input("before"); };
            reader.onLoopStart = [&, i](Probe&, const Tick&) {
                seen[i] = inputs[i]->state().cycle;
            };
        }
        cluster.start();

        cluster.step(20);

        for (const std::int64_t cycle : seen) EXPECT_EQ(cycle, 19) << threads << " threads";
    }
}

TEST(DataFlow, ALossIsSeenByTheReaderWithItsFirstCause) {
    Chain chain;
    chain.cluster.start();
    chain.cluster.startup(chain.writer);
    chain.cluster.startup(chain.reader);
    chain.writer.onActive = [](Probe& self, const Tick&) { self.setQuality(Quality::Bad); };

    chain.cluster.step();

    EXPECT_EQ(chain.cluster.state("/a-reader"), State::Active);  // propagate: it runs on
    EXPECT_EQ(chain.cluster.quality("/a-reader"), Quality::Bad);
    EXPECT_TRUE(
        chain.cluster.hasEvent("/a-reader: input in from /s is bad, first cause /z-writer"));
}

TEST(DataFlow, OnLossHoldRunsOnWithTheLastValueAndReturns) {
    Chain chain{"held"};
    std::vector<double> seen;
    bool broken = false;
    chain.writer.onActive = [&](Probe& self, const Tick& tick) {
        chain.out = static_cast<double>(tick.cycle);
        if (broken) self.setQuality(Quality::Bad);
    };
    chain.reader.onActive = [&](Probe&, const Tick&) { seen.push_back(chain.in); };
    chain.cluster.start();
    chain.cluster.startup(chain.writer);
    chain.cluster.startup(chain.reader);
    seen.clear();
    chain.cluster.step();
    const double last = seen.back();
    broken = true;

    chain.cluster.step(3);

    EXPECT_EQ(seen, (std::vector{last, last, last, last}));
    EXPECT_EQ(chain.cluster.quality("/a-reader"), Quality::Stale);
    broken = false;
    chain.cluster.step();
    EXPECT_EQ(seen.back(), static_cast<double>(chain.cluster.cluster->image().cycle()));
}

TEST(DataFlow, OnLossFaultEntersFaultAndNamesTheInput) {
    Chain chain{"vital"};
    chain.cluster.start();
    chain.cluster.startup(chain.writer);
    chain.cluster.startup(chain.reader);
    chain.writer.onActive = [](Probe& self, const Tick&) { self.setQuality(Quality::Bad); };

    chain.cluster.step();

    EXPECT_EQ(chain.cluster.state("/a-reader"), State::Fault);
    EXPECT_EQ(chain.cluster.integer("/a-reader", "faultCode"), -2);
    EXPECT_TRUE(
        chain.cluster.hasEvent("fault -2: input vital from /s is bad, first cause /z-writer"));
}

// Of a reader whose input is lost, and is back: what becomes of its long commands.
TEST(DataFlow, OnLossSafeEndsLongCommandsUnlessTheirTypeSaysOtherwise) {
    ProbeCluster cluster;
    Probe& writer = cluster.probe("/writer");
    Probe& reader = cluster.probe("/reader", "LongProbe");
    Simplex& signal = cluster.tree.add("/s", "Signal");
    cluster.tree.relate(writer, "out", signal);
    cluster.tree.relate(reader, "guarded", signal);
    cluster.tree.relate(reader, "out", cluster.tree.add("/t", "Signal"));
    bool broken = false;
    int calls = 0, lastCalls = 0;
    writer.onActive = [&](Probe& self, const Tick&) {
        if (broken) self.setQuality(Quality::Bad);
    };
    reader.onWork = [&](Probe&, Call& call) {
        ++calls;
        if (call.cancelling()) ++lastCalls;
        return cortex::Outcome::Running;
    };
    cluster.start();
    cluster.startup(writer);
    cluster.startup(reader);
    const std::string lost = "its input guarded from /s is lost";
    CallResult result;

    const std::uint64_t work = cluster.cluster->send("/reader", "work");
    cluster.step(3);
    ASSERT_FALSE(cluster.cluster->program().poll(work, result));
    broken = true;
    cluster.step(2);
    ASSERT_TRUE(cluster.cluster->program().poll(work, result));
    EXPECT_EQ(result.text(), "Failed: " + lost);
    EXPECT_EQ(lastCalls, 1) << "it may clean up";

    const int before = calls;
    EXPECT_EQ(cluster.call("/reader", "work").text(), "Rejected (state): " + lost);
    EXPECT_EQ(calls, before) << "its handler saw nothing of it";
    const std::uint64_t keep = cluster.cluster->send("/reader", "keep");
    cluster.step(3);
    EXPECT_FALSE(cluster.cluster->program().poll(keep, result)) << result.text();
    EXPECT_EQ(calls, before + 3);

    broken = false;
    cluster.step(2);
    EXPECT_EQ(cluster.call("/reader", "cancel").outcome, cortex::Outcome::Done);
    const std::uint64_t again = cluster.cluster->send("/reader", "work");
    cluster.step(3);
    EXPECT_FALSE(cluster.cluster->program().poll(again, result)) << result.text();
}

TEST(DataFlow, OnLossSafeSkipsTheStateFunctionWritesSafeDemandsAndResumes) {
    Chain chain{"guarded"};
    Simplex& target = chain.cluster.tree.add("/t", "Signal");
    chain.cluster.tree.relate(chain.reader, "out", target);
    Data<double> value;
    int active = 0;
    bool broken = false;
    chain.writer.onActive = [&](Probe& self, const Tick&) {
        if (broken) self.setQuality(Quality::Bad);
    };
    chain.reader.onPopulate = [&](Probe& self) {
        value = self.output("out").data<double>("value");
    };
    chain.reader.onActive = [&](Probe&, const Tick&) {
        ++active;
        value = 5;
    };
    chain.cluster.start();
    chain.cluster.startup(chain.writer);
    chain.cluster.startup(chain.reader);
    ASSERT_EQ(chain.cluster.number("/t", "value"), 5);
    const int before = active;
    broken = true;

    chain.cluster.step(2);
    EXPECT_EQ(active, before);
    EXPECT_EQ(chain.cluster.number("/t", "value"), 0);
    EXPECT_EQ(chain.cluster.state("/a-reader"), State::Active);

    broken = false;
    chain.cluster.step();
    EXPECT_EQ(active, before + 1);
    EXPECT_EQ(chain.cluster.number("/t", "value"), 5);
}

TEST(DataFlow, AMeasurementOlderThanMaxAgeIsALoss) {
    Chain chain;  // maxAge 50 ms
    chain.writer.onActive = [](Probe& self, const Tick&) { self.setQuality(Quality::Good, 0); };
    chain.cluster.start();
    chain.cluster.startup(chain.writer);
    chain.cluster.step(40);
    EXPECT_FALSE(chain.cluster.hasEvent("ms old"));

    chain.cluster.step(20);
    EXPECT_TRUE(chain.cluster.hasEvent("/a-reader: input in from /s is 51 ms old, allowed 50 ms"));
}

// What another agent or a device measures, read by one that runs in every second cycle.
struct Followed {
    LoopbackHub hub;
    ProbeCluster hand{{}, "hand"}, arm;
    Probe& follower = arm.probe("/follower");
    std::vector<std::string> seen;  // of the runs of the follower, the latest last

    Followed() {
        Probe& writer = hand.probe("/writer");
        hand.tree.relate(writer, "out", hand.tree.add("/s", "Signal"));
        writer.onLoopStart = [](Probe& self, const Tick& tick) {
            self.setQuality(Quality::Good, tick.nominalTime);
        };
        hand.cluster->adoptInterface(hub.makeInterface());
        arm.tree.relateRemote(follower, "in", "/s", "Signal");
        follower.onLoopStart = [this](Probe& self, const Tick&) {
            seen.emplace_back(self.inputLost() ? "lost" : "there");
        };
        arm.cluster->adoptInterface(hub.makeInterface());
    }
    void start() {
        hand.start();
        arm.start();
    }
    void step() {
        hand.step();
        arm.step();
    }
    std::vector<std::string> stepsAfterStandstill(std::int64_t periods, int steps) {
        for (int i = 0; i < 10; ++i) step();
        seen.clear();
        cs::ClusterTesting::playLate(*arm.trigger, periods);
        for (int i = 0; i <= steps; ++i) step();
        return seen;
    }
};

TEST(DataFlow, WhatMovedOnWhileTheLoopStoodStillIsLostOnceHoweverFreshItIs) {
    Followed plant;
    plant.start();
    const auto seen = plant.stepsAfterStandstill(60, 3);

    EXPECT_EQ(seen, (std::vector<std::string>{"there", "lost", "there", "there"}));
    EXPECT_TRUE(
        plant.arm.hasEvent("input in from /s was not followed for 61 ms, as the loop "
                           "stood still, allowed 50 ms; reaction: propagate"));
    EXPECT_TRUE(plant.arm.hasEvent("input in from /s is back"));
}

TEST(DataFlow, AStandstillWithinMaxAgeIsNoLoss) {
    Followed plant;
    plant.start();

    EXPECT_EQ(plant.stepsAfterStandstill(40, 3), (std::vector<std::string>(4, "there")));
}

TEST(DataFlow, ATaskThatSkippedTheFirstCycleAfterAStandstillSeesTheLossAtItsNextRun) {
    Followed plant;
    plant.follower.runEvery(4, 3);
    plant.start();
    const auto seen = plant.stepsAfterStandstill(60, 11);

    EXPECT_EQ(seen.size(), 3U);
    EXPECT_EQ(std::ranges::count(seen, "lost"), 1);
    EXPECT_NE(seen.back(), "lost");
}

// Whoever wrote it knows nothing of what was before, or was not followed meanwhile.
TEST(DataFlow, WhatWasLinkedAnewSinceTheLastRunIsLostOnceHoweverFreshItIs) {
    for (const int every : {1, 4}) {
        Followed plant;
        if (every > 1) plant.follower.runEvery(every, 3);
        plant.start();
        for (int i = 0; i < 12; ++i) plant.step();
        plant.seen.clear();
        plant.hub.setConnected("hand", false);
        plant.step();
        plant.hub.setConnected("hand", true);
        for (int i = 0; i < 12; ++i) plant.step();

        EXPECT_EQ(std::ranges::count(plant.seen, "lost"), 1) << every;
        EXPECT_EQ(plant.seen.back(), "there") << every;
        EXPECT_EQ(plant.arm.hasEvent("input in from /s was linked anew; reaction: propagate"),
                  every > 1);
    }
}

// A writer's value of this very cycle is as good as ever: nothing has moved on without us.
TEST(DataFlow, WhatTheClusterComputesItselfIsNotLostByAStandstill) {
    Chain chain;
    bool everLost = false;
    chain.reader.onLoopStart = [&](Probe& self, const Tick&) { everLost |= self.inputLost(); };
    chain.cluster.start();
    chain.cluster.startup(chain.writer);
    chain.cluster.step();
    everLost = false;
    cs::ClusterTesting::playLate(*chain.cluster.trigger, 60);
    chain.cluster.step(3);

    EXPECT_FALSE(everLost);
}

// Every tick comes 200 ms late.
struct LateTrigger final : cs::TriggerSource {
    cs::ManualTrigger trigger{std::chrono::milliseconds{1}};

    void start() override { trigger.start(); }
    cs::Trigger waitForTick() override {
        cs::Trigger tick = trigger.waitForTick();
        tick.lateness = 200'000'000;
        return tick;
    }
    void interrupt() override { trigger.interrupt(); }
    std::int64_t period() const override { return trigger.period(); }
    bool realTime() const override { return false; }
};

TEST(DataFlow, ALateCycleDoesNotAgeWhatItsClusterMade) {
    Chain chain("in", true);
    std::vector<std::string> seen;
    chain.reader.onLoopStart = [&](Probe& self, const Tick&) {
        seen.emplace_back(self.inputLost() ? "lost" : "there");
    };
    chain.cluster.trigger = &chain.cluster.cluster->setTriggerSource<LateTrigger>().trigger;
    chain.cluster.start();
    chain.cluster.startup(chain.writer);
    chain.cluster.step();
    seen.clear();
    chain.cluster.step(3);

    EXPECT_EQ(seen, (std::vector<std::string>(3, "there")));
}

TEST(DataFlow, AStampIsTheOldestOfTheInputs) {
    Chain chain;
    chain.writer.onActive = [](Probe& self, const Tick& tick) {
        self.setQuality(Quality::Good, tick.nominalTime - 3'000'000);
    };
    chain.cluster.start();
    chain.cluster.startup(chain.writer);
    chain.cluster.startup(chain.reader);
    chain.cluster.step();

    const Image image = chain.cluster.cluster->image();
    const SlotState state = image.state(image.structure().find("/a-reader"));
    EXPECT_EQ(state.time, image.nominalTime() - 3'000'000);
}

// As where an input was measured before this agent started.
TEST(DataFlow, AStampBeforeTheStartIsPassedOnAsOldAsItIs) {
    constexpr std::int64_t hour = 3'600'000'000'000;
    Chain chain;
    chain.writer.onActive = [](Probe& self, const Tick&) { self.setQuality(Quality::Good, -hour); };
    chain.cluster.start();
    chain.cluster.startup(chain.writer);
    chain.cluster.step();

    const Image image = chain.cluster.cluster->image();
    EXPECT_EQ(image.state(image.structure().find("/s")).time, -hour);
    EXPECT_TRUE(chain.reader.inputLost());
    EXPECT_EQ(image.quality("/s"), Quality::Good);
}

// Two writers of one simplex.
struct Shared {
    ProbeCluster cluster;
    Probe& first = cluster.probe("/w1");
    Probe& second = cluster.probe("/w2");

    Shared() {
        Simplex& signal = cluster.tree.add("/s", "SharedSignal");
        write(first, signal, 10);
        write(second, signal, 20);
        cluster.start();
    }
    void write(Probe& probe, Simplex& signal, double number) {
        cluster.tree.relate(probe, "out", signal);
        probe.onPopulate = [number](Probe& self) {
            Data<double> out = self.output("out").data<double>("value");
            self.onActive = [out, number](Probe&, const Tick&) mutable { out = number; };
        };
    }
};

TEST(Arbitration, TakesTheCandidateOfTheOneWriterThatIsActive) {
    Shared shared;
    shared.cluster.startup(shared.second);
    EXPECT_EQ(shared.cluster.number("/s", "value"), 20);

    shared.cluster.cluster->send("/w2", "shutdown");
    shared.cluster.startup(shared.first);
    EXPECT_EQ(shared.cluster.number("/s", "value"), 10);
}

TEST(Arbitration, SeveralActiveTakesTheFirstInCanonicalOrderCountedOnceAnEvent) {
    Shared shared;
    shared.cluster.startup(shared.second);
    shared.cluster.startup(shared.first);
    shared.cluster.step(2);

    EXPECT_EQ(shared.cluster.number("/s", "value"), 10);
    EXPECT_TRUE(shared.cluster.hasEvent("/s: several writers are Active; taken is /w1"));
    shared.cluster.step(2);
    EXPECT_GE(shared.cluster.integer("/test", "conflictCount"), 2);
    int events = 0;
    for (const std::string& event : shared.cluster.events()) {
        if (event.find("several writers") != std::string::npos) ++events;
    }
    EXPECT_EQ(events, 1);
}

TEST(Arbitration, NoneActiveGivesSafeValues) {
    Shared shared;
    shared.cluster.startup(shared.second);
    shared.cluster.cluster->send("/w2", "shutdown");
    shared.cluster.step(3);

    EXPECT_EQ(shared.cluster.number("/s", "value"), 0);
    EXPECT_EQ(shared.cluster.quality("/s"), Quality::Stale);
}

}  // namespace

}  // namespace cortex::test
