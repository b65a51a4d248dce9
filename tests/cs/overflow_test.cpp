// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"
#include "cortex/core/clock.hpp"
#include "cortex/cs/testing.hpp"

#include "loop/pace_judge.hpp"
#include "support/probe.hpp"
#include "support/stepped_clock.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

TEST(Overflow, SkipGoesOnAtTheNextTickOfTheGridAndCountsEachMissedOne) {
    ProbeCluster cluster;
    std::vector<std::int64_t> times, passed, elapsed;
    cluster.probe("/a").onLoopStart = [&](Probe&, const Tick& tick) {
        times.push_back(tick.nominalTime / 1'000'000);
        passed.push_back(tick.passed / 1'000'000);
        elapsed.push_back(tick.elapsed / 1'000'000);
    };
    cluster.start();
    cluster.step(2);
    cs::ClusterTesting::playLate(*cluster.trigger, 3);
    cluster.step(3);

    EXPECT_EQ(times, (std::vector<std::int64_t>{0, 1, 2, 6, 7}));
    EXPECT_EQ(passed, (std::vector<std::int64_t>{1, 1, 1, 4, 1}));
    EXPECT_EQ(elapsed, (std::vector<std::int64_t>{1, 1, 1, 3, 1}))
        << "what moves makes up for none";
    EXPECT_EQ(cluster.integer("/test", "overflowCount"), 3);
    EXPECT_TRUE(cluster.hasEvent("/test: missed 3 ticks, 3 since the start"));
}

// By number among those that the same input causes again; without those of measured times.
std::map<std::uint64_t, std::string> repeatableEvents(std::int64_t late) {
    std::map<std::uint64_t, std::string> seen;
    ProbeCluster cluster;
    cluster.cluster->addEventSink([&](const Event& event, const Structure&) {
        if (event.repeatable != 0) seen[event.repeatable] = event.text.view();
    });
    Probe& probe = cluster.probe("/a");
    probe.onActive = [](Probe& self, const Tick&) { self.event(Severity::Info, "works"); };
    cluster.start();
    cluster.startup(probe);
    if (late > 0) cs::ClusterTesting::playLate(*cluster.trigger, late);
    cluster.step(3);
    EXPECT_EQ(cluster.hasEvent("missed"), late > 0);
    cluster.cluster->stop();
    return seen;
}

TEST(Overflow, LeavesTheNumbersOfEventsThatComeFromValues) {
    const auto punctual = repeatableEvents(0);

    EXPECT_GE(punctual.size(), 5U);
    EXPECT_EQ(punctual.rbegin()->first, punctual.size()) << "without gaps";
    EXPECT_EQ(repeatableEvents(2), punctual);
}

TEST(Overflow, NamesTheTaskThatTookLongestWhereOneTookMoreThanHalfThePeriod) {
    ProbeCluster cluster;
    bool slow = false;
    cluster.probe("/a");
    cluster.probe("/slow").onLoopStart = [&](Probe&, const Tick&) {
        const std::int64_t end = monotonicNow() + (slow ? 2'000'000 : 0);
        while (monotonicNow() < end) {
        }
    };
    cluster.trigger = &cluster.cluster->setTriggerSource<SteppedClock>().trigger;
    cluster.start();
    cluster.step(2);
    slow = true;
    cs::ClusterTesting::playLate(*cluster.trigger, 3);
    cluster.step(2);

    EXPECT_TRUE(cluster.hasEvent("missed 3 ticks, 3 since the start; /slow took "));
}

TEST(Overflow, CatchUpRunsTheMissedTicksAtOnceAndCountsThemOnce) {
    ProbeCluster cluster{{.overflow = cs::Overflow::CatchUp, .catchUpCycles = 5}};
    std::vector<std::int64_t> times;
    cluster.probe("/a").onLoopStart = [&](Probe&, const Tick& tick) {
        times.push_back(tick.nominalTime / 1'000'000);
    };
    cluster.start();
    cluster.step(2);
    cs::ClusterTesting::playLate(*cluster.trigger, 3);
    cluster.step();
    EXPECT_EQ(times, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5}));
    cluster.step();

    EXPECT_EQ(times.back(), 6);
    EXPECT_EQ(cluster.integer("/test", "overflowCount"), 3);
}

TEST(Overflow, CatchUpSkipsAfterItsBoundAndEveryTickIsRunOrCounted) {
    ProbeCluster cluster{{.overflow = cs::Overflow::CatchUp, .catchUpCycles = 2}};
    std::vector<std::int64_t> times;
    cluster.probe("/a").onLoopStart = [&](Probe&, const Tick& tick) {
        times.push_back(tick.nominalTime / 1'000'000);
    };
    cluster.start();
    cs::ClusterTesting::playLate(*cluster.trigger, 5);
    cluster.step(2);

    // 0, then two of the five at once, the other three skipped, then on.
    EXPECT_EQ(times, (std::vector<std::int64_t>{0, 1, 2, 6}));
    EXPECT_EQ(cluster.integer("/test", "overflowCount"), 5);
}

TEST(Overflow, HaltFaultsAllThatIsActiveInTheNextCycleAndRunsOnWithSafeDemands) {
    ProbeCluster cluster{{.overflow = cs::Overflow::Halt}};
    Simplex& signal = cluster.tree.add("/s", "Signal");
    Probe& writer = cluster.probe("/writer");
    Probe& resting = cluster.probe("/resting");
    Probe& slow = cluster.probe("/slow");
    slow.runEvery(10);
    cluster.tree.relate(writer, "out", signal);
    writer.onPopulate = [](Probe& self) {
        Data<double> out = self.output("out").data<double>("value");
        self.onActive = [out](Probe&, const Tick&) mutable { out = 3; };
    };
    int after = 0;
    resting.onStandby = [&](Probe&, const Tick&) { ++after; };
    cluster.start();
    cluster.startup(writer);
    cluster.startup(slow);
    cs::ClusterTesting::playLate(*cluster.trigger, 1);
    cluster.step();
    after = 0;

    cluster.step();

    EXPECT_EQ(cluster.state("/writer"), State::Fault);
    EXPECT_EQ(cluster.state("/slow"), State::Fault);
    EXPECT_EQ(cluster.integer("/writer", "faultCode"), -5);
    EXPECT_EQ(cluster.number("/s", "value"), 0);
    EXPECT_EQ(cluster.state("/resting"), State::Standby);
    cluster.step(4);
    EXPECT_EQ(after, 5);
    EXPECT_EQ(cluster.cluster->ended(), cs::Ended::Halted);
    EXPECT_EQ(cluster.call("/writer", "clearFaults").outcome, Outcome::Done);
    cluster.startup(writer);
    EXPECT_EQ(cluster.state("/writer"), State::Active);
}

// Of each 1 + `missed` ticks one is run.
void stepLate(ProbeCluster& cluster, int cycles, std::int64_t missed) {
    for (int i = 0; i < cycles; ++i) {
        cs::ClusterTesting::playLate(*cluster.trigger, missed);
        cluster.step();
    }
}

TEST(Overflow, ALoopThatMissesMoreThanATenthOfItsTicksForTwoSecondsIsOverloaded) {
    ProbeCluster cluster;
    cluster.probe("/a");
    cluster.start();
    const LoopPace& pace = cluster.cluster->agent().pace();
    stepLate(cluster, 150, 9);  // one second of it is no overload yet
    EXPECT_EQ(pace.rate(), 100);
    EXPECT_FALSE(pace.overloaded());

    stepLate(cluster, 60, 9);
    EXPECT_TRUE(pace.overloaded());
    EXPECT_TRUE(
        cluster.hasEvent("/test: overloaded: 100 cycles a second instead of 1000; all motion has "
                         "30 % of its speed"));
    EXPECT_FALSE(cluster.hasEvent("no longer"));

    cluster.step(3'000);
    EXPECT_FALSE(pace.overloaded());
    EXPECT_EQ(pace.rate(), 1000);
    EXPECT_TRUE(cluster.hasEvent("no longer overloaded: 1000 cycles a second"));
    EXPECT_FALSE(cluster.hasEvent("1000 cycles a second instead")) << "it is what is wanted";
}

TEST(Overflow, AnOverloadOfHalfTheMotionIsToldAnew) {
    ProbeCluster cluster;
    cluster.probe("/a");
    cluster.start();
    stepLate(cluster, 400, 9);
    EXPECT_FALSE(cluster.hasEvent("overloaded: 50 cycles"));
    stepLate(cluster, 120, 39);
    EXPECT_TRUE(cluster.hasEvent("overloaded: 25 cycles a second instead of 1000; all motion has "
                                 "8 % of its speed") ||
                cluster.hasEvent("overloaded: 25 cycles a second instead of 1000; all motion has "
                                 "7 % of its speed"));
    const auto told = [&cluster] {
        return std::ranges::count_if(cluster.events(), [](const std::string& each) {
            return each.find(": overloaded") != std::string::npos;
        });
    };
    EXPECT_EQ(told(), 2);
    stepLate(cluster, 120, 39);
    EXPECT_EQ(told(), 2) << "it is as it was";
}

// A count that began late was short by the clock, and its cycles were no more for that.
TEST(Overflow, ALoopThatIsOverloadedNeverTellsOfMoreCyclesThanItWasToRun) {
    constexpr std::int64_t period = 200'000'000;  // 5 Hz
    cs::PaceJudge judge{period};
    std::int64_t nominal = 0;
    const auto add = [&](std::int64_t now) {
        return judge.add({.nominalTime = nominal, .elapsed = period}, now);
    };
    add(0);
    double most = 0;
    for (int count = 0; count < 6; ++count) {
        const std::int64_t end = nominal + 10 * period;
        for (int i = 0; i < 4; ++i) {
            nominal += period;
            add(end);
        }
        nominal = end;
        ASSERT_TRUE(add(end + (count % 2 == 0 ? 8 * period : 0)));
        most = std::max(most, judge.rate());
    }
    EXPECT_TRUE(judge.overloaded());
    EXPECT_LT(most, 5);
}

TEST(Overflow, OneLongCycleIsNoOverload) {
    ProbeCluster cluster;
    cluster.probe("/a");
    cluster.start();
    stepLate(cluster, 1, 900);
    cluster.step(3'000);

    EXPECT_FALSE(cluster.hasEvent("overloaded"));
}

TEST(Overflow, WarnTellsEachCycleAboveItsDutyThreshold) {
    ProbeCluster cluster{{.warnDuty = 1e-6}};
    cluster.probe("/a");
    cluster.start();
    cluster.step(3);

    EXPECT_TRUE(cluster.hasEvent("% is above 1e-06 %"));
}

}  // namespace

}  // namespace cortex::test
