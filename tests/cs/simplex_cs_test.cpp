// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"
#include "cortex/cs/testing.hpp"

#include "support/probe.hpp"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

TEST(SimplexCS, IsPopulatedOnceAfterValidationAndStartsInStandby) {
    ProbeCluster cluster;
    int populated = 0;
    Probe& probe = cluster.probe("/a");
    probe.onPopulate = [&](Probe&) { ++populated; };

    cluster.start();
    cluster.step(3);

    EXPECT_EQ(populated, 1);
    EXPECT_EQ(cluster.state("/a"), State::Standby);
}

TEST(SimplexCS, RunsCommandsThenLoopStartThenTheStateFunctionThenLoopEnd) {
    ProbeCluster cluster;
    std::string order;
    Probe& probe = cluster.probe("/a");
    probe.onPoke = [&](Probe&, Call&) {
        order += "c";
        return Outcome::Done;
    };
    probe.onLoopStart = [&](Probe&, const Tick&) { order += "s"; };
    probe.onStandby = [&](Probe&, const Tick&) { order += "f"; };
    probe.onLoopEnd = [&](Probe&, const Tick&) { order += "e"; };
    cluster.start();
    cluster.cluster->send("/a", "poke");

    cluster.step();

    EXPECT_EQ(order, "csfe");
}

TEST(SimplexCS, GoesOverStartingUpToActiveAndOverShuttingDownToStandby) {
    ProbeCluster cluster;
    std::vector<State> seen;
    Probe& probe = cluster.probe("/a");
    probe.onLoopStart = [&](Probe& self, const Tick&) { seen.push_back(self.state()); };
    cluster.start();

    cluster.cluster->send("/a", "startup");
    cluster.step(3);
    cluster.cluster->send("/a", "shutdown");
    cluster.step(2);

    EXPECT_EQ(seen, (std::vector{State::StartingUp, State::Active, State::Active,
                                 State::ShuttingDown, State::Standby}));
}

TEST(SimplexCS, StaysInATransitionalStateUntilItsFunctionIsDone) {
    ProbeCluster cluster;
    int calls = 0;
    Probe& probe = cluster.probe("/a");
    probe.onStartingUp = [&](Probe&, const Tick&) { return ++calls == 4; };
    cluster.start();
    cluster.cluster->send("/a", "startup");

    cluster.step(4);
    EXPECT_EQ(cluster.state("/a"), State::StartingUp);
    cluster.step();
    EXPECT_EQ(cluster.state("/a"), State::Active);
    EXPECT_EQ(calls, 4);
}

TEST(SimplexCS, CanBeShutDownWhileStartingUp) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    probe.onStartingUp = [](Probe&, const Tick&) { return false; };
    cluster.start();
    cluster.cluster->send("/a", "startup");
    cluster.step(2);

    cluster.cluster->send("/a", "shutdown");
    cluster.step();

    EXPECT_EQ(cluster.state("/a"), State::ShuttingDown);
    cluster.step();
    EXPECT_EQ(cluster.state("/a"), State::Standby);
}

TEST(SimplexCS, FaultsWhenATransitionTakesLongerThanItsTypeAllows) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a", "QuickProbe");  // 5 ms
    probe.onStartingUp = [](Probe&, const Tick&) { return false; };
    cluster.start();
    cluster.cluster->send("/a", "startup");

    cluster.step(5);
    EXPECT_EQ(cluster.state("/a"), State::StartingUp);
    cluster.step();

    EXPECT_EQ(cluster.state("/a"), State::Fault);
    EXPECT_TRUE(cluster.hasEvent("stateStartingUp was not done within 0.005 s"));
}

TEST(SimplexCS, DoesNotCountAStandstillAmongTheTimeOfATransition) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a", "QuickProbe");
    probe.onStartingUp = [](Probe&, const Tick&) { return false; };
    cluster.start();
    cluster.cluster->send("/a", "startup");
    cs::ClusterTesting::playLate(*cluster.trigger, 50);

    cluster.step(3);  // the second is worth 3 ms
    EXPECT_EQ(cluster.state("/a"), State::StartingUp);
    cluster.step();

    EXPECT_EQ(cluster.state("/a"), State::Fault);
}

TEST(SimplexCS, ShutdownOutranksAStartupOfTheSameCycle) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    cluster.start();
    cluster.startup(probe);
    AgentRuntime& agent = cluster.cluster->agent();

    agent.postLifeCycle(probe.index(), LifeCycle::Shutdown, false);
    agent.postLifeCycle(probe.index(), LifeCycle::Startup, false);
    cluster.step();

    EXPECT_EQ(cluster.state("/a"), State::ShuttingDown);
}

TEST(SimplexCS, EntersFaultWithCodeAndTextAndClearsToStandbyNeverToActive) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    bool broken = false;
    probe.onActive = [&](Probe& self, const Tick&) {
        if (broken) self.fault(42, "the belt is torn");
    };
    cluster.start();
    cluster.startup(probe);
    broken = true;

    cluster.step();
    EXPECT_EQ(cluster.state("/a"), State::Fault);
    EXPECT_EQ(cluster.integer("/a", "faultCode"), 42);
    EXPECT_TRUE(cluster.hasEvent("/a: fault 42: the belt is torn"));

    EXPECT_EQ(cluster.call("/a", "startup").outcome, Outcome::Rejected);
    EXPECT_EQ(cluster.call("/a", "clearFaults").outcome, Outcome::Done);
    EXPECT_EQ(cluster.state("/a"), State::Standby);
    EXPECT_EQ(cluster.integer("/a", "faultCode"), 0);
}

TEST(SimplexCS, KeepsTheFirstFaultOfACycle) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    probe.onActive = [](Probe& self, const Tick&) {
        self.fault(1, "first");
        self.fault(2, "second");
    };
    cluster.start();
    cluster.startup(probe);
    cluster.step();

    EXPECT_EQ(cluster.integer("/a", "faultCode"), 1);
}

TEST(SimplexCS, RefusesToClearAFaultWhoseCauseRemains) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    bool gone = false;
    probe.onActive = [](Probe& self, const Tick&) { self.fault(7, "no power"); };
    probe.onFault = [&](Probe&, const Tick&) { return gone; };
    cluster.start();
    cluster.startup(probe);
    cluster.step(2);
    ASSERT_EQ(cluster.state("/a"), State::Fault);

    cluster.cluster->send("/a", "clearFaults");
    cluster.step(2);
    EXPECT_EQ(cluster.state("/a"), State::Fault);
    EXPECT_TRUE(cluster.hasEvent("the fault is not over"));

    gone = true;
    cluster.step();
    cluster.cluster->send("/a", "clearFaults");
    cluster.step();
    EXPECT_EQ(cluster.state("/a"), State::Standby);
}

class ThrowingHook : public testing::TestWithParam<std::string> {};

TEST_P(ThrowingHook, FaultsThatSimplexOnlyAndSilencesItsHooksUntilCleared) {
    ProbeCluster cluster;
    Probe& bad = cluster.probe("/bad");
    Probe& good = cluster.probe("/good");
    bool armed = false;
    int badHooks = 0;
    int goodHooks = 0;
    const auto throwIf = [&](const char* hook) {
        if (armed && GetParam() == hook) throw std::runtime_error{"cannot go on"};
        ++badHooks;
    };
    bad.onLoopStart = [&](Probe&, const Tick&) { throwIf("loopStart"); };
    bad.onActive = [&](Probe&, const Tick&) { throwIf("stateActive"); };
    bad.onLoopEnd = [&](Probe&, const Tick&) { throwIf("loopEnd"); };
    bad.onPoke = [&](Probe&, Call&) {
        throwIf("command");
        return Outcome::Done;
    };
    good.onLoopStart = [&](Probe&, const Tick&) { ++goodHooks; };
    cluster.start();
    cluster.startup(bad);
    armed = true;
    if (GetParam() == "command") cluster.cluster->send("/bad", "poke");

    cluster.step();
    EXPECT_EQ(cluster.state("/bad"), State::Fault);
    EXPECT_EQ(cluster.integer("/bad", "faultCode"), -1);
    EXPECT_TRUE(cluster.hasEvent("/bad: fault -1: cannot go on"));

    const int badBefore = badHooks;
    const int goodBefore = goodHooks;
    cluster.step(5);
    EXPECT_EQ(badHooks, badBefore);
    EXPECT_EQ(goodHooks, goodBefore + 5);

    armed = false;
    EXPECT_EQ(cluster.call("/bad", "clearFaults").outcome, Outcome::Done);
    cluster.step();
    EXPECT_GT(badHooks, badBefore);
}

INSTANTIATE_TEST_SUITE_P(Hooks, ThrowingHook,
                         testing::Values("loopStart", "stateActive", "loopEnd", "command"),
                         [](const auto& hook) { return hook.param; });

TEST(SimplexCS, FaultsOnAThrownThingThatIsNoException) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    probe.onActive = [](Probe&, const Tick&) { throw 5; };
    cluster.start();
    cluster.startup(probe);
    cluster.step();

    EXPECT_EQ(cluster.state("/a"), State::Fault);
}

TEST(SimplexCS, RunsEveryNthCycleWithItsPhaseAndIsToldWhatElapsed) {
    ProbeCluster cluster;
    std::vector<std::int64_t> cycles;
    std::vector<std::int64_t> elapsed;
    Probe& probe = cluster.probe("/a");
    probe.runEvery(4, 1);
    probe.onLoopStart = [&](Probe&, const Tick& tick) {
        cycles.push_back(tick.cycle);
        elapsed.push_back(tick.elapsed);
    };
    cluster.start();
    cluster.step(10);

    EXPECT_EQ(cycles, (std::vector<std::int64_t>{2, 6, 10}));
    EXPECT_EQ(elapsed, (std::vector<std::int64_t>{4'000'000, 4'000'000, 4'000'000}));
}

TEST(SimplexCS, OfARateIsWorthThreeOfItsOwnPeriodsAfterAStandstill) {
    ProbeCluster cluster;
    std::vector<std::int64_t> passed, elapsed;
    Probe& probe = cluster.probe("/a");
    probe.runEvery(4, 0);
    probe.onLoopStart = [&](Probe&, const Tick& tick) {
        passed.push_back(tick.passed / 1'000'000);
        elapsed.push_back(tick.elapsed / 1'000'000);
    };
    cluster.start();
    for (const std::int64_t late : {0, 5, 100, 0}) {
        cs::ClusterTesting::playLate(*cluster.trigger, late);
        cluster.step(4);
    }

    EXPECT_EQ(passed, (std::vector<std::int64_t>{4, 4, 9, 104}));
    EXPECT_EQ(elapsed, (std::vector<std::int64_t>{4, 4, 9, 12}));
}

TEST(SimplexCS, SpreadsPhasesOverTheRateByCanonicalOrder) {
    ProbeCluster cluster;
    std::vector<std::int64_t> runs(4);
    for (int i = 0; i < 4; ++i) {
        Probe& probe = cluster.probe("/p" + std::to_string(i));
        probe.runEvery(4);
        probe.onLoopStart = [&runs](Probe&, const Tick& tick) {
            ++runs[static_cast<std::size_t>((tick.cycle - 1) % 4)];
        };
    }
    cluster.start();
    cluster.step(4);

    EXPECT_EQ(runs, (std::vector<std::int64_t>{1, 1, 1, 1}));
}

TEST(SimplexCS, StartsAndStopsARelatedSimplexInTheSameCycleAlongAnOutput) {
    ProbeCluster cluster;
    Probe& leader = cluster.probe("/a");
    Probe& follower = cluster.probe("/z");
    cluster.tree.relate(leader, "after", follower);
    Probe::LifeCycleSender sender;
    std::vector<State> seenByLeader;
    leader.onPopulate = [&](Probe& self) { sender = self.lifeCycle(self.output("after")); };
    leader.onStandby = [&](Probe&, const Tick& tick) {
        seenByLeader.push_back(sender.state());
        if (tick.cycle == 2) sender.startup();
    };
    cluster.start();

    cluster.step(2);
    EXPECT_EQ(cluster.state("/z"), State::StartingUp);
    cluster.step(2);
    EXPECT_EQ(cluster.state("/z"), State::Active);
    EXPECT_EQ(seenByLeader[2], State::StartingUp);  // as it was when the leader ran
    EXPECT_EQ(seenByLeader[3], State::Active);
}

TEST(SimplexCS, ReachesARelatedSimplexInTheNextCycleAlongADelayedOutput) {
    ProbeCluster cluster;
    Probe& leader = cluster.probe("/a");
    Probe& follower = cluster.probe("/z");
    cluster.tree.relate(leader, "late", follower);
    Probe::LifeCycleSender sender;
    leader.onPopulate = [&](Probe& self) { sender = self.lifeCycle(self.output("late")); };
    leader.onStandby = [&](Probe&, const Tick& tick) {
        if (tick.cycle == 2) sender.startup();
    };
    cluster.start();

    cluster.step(2);
    EXPECT_EQ(cluster.state("/z"), State::Standby);
    cluster.step();
    EXPECT_EQ(cluster.state("/z"), State::StartingUp);
}

TEST(SimplexCS, CommandsOfOneWhoseHookThrewAreRefusedUntilCleared) {
    ProbeCluster cluster;
    Probe& bad = cluster.probe("/bad");
    int pokes = 0;
    bad.onPoke = [&](Probe&, Call&) { return ++pokes, Outcome::Done; };
    bad.onActive = [](Probe&, const Tick&) { throw std::runtime_error{"cannot go on"}; };
    cluster.start();
    cluster.startup(bad);
    cluster.step();
    ASSERT_EQ(cluster.state("/bad"), State::Fault);

    const CallResult refused = cluster.call("/bad", "poke");  // which is available in Fault

    EXPECT_EQ(refused.text(), "Rejected (state): one of its hooks threw: clearFaults comes first");
    EXPECT_EQ(pokes, 0);
    EXPECT_EQ(cluster.call("/bad", "clearFaults").outcome, Outcome::Done);
    EXPECT_EQ(cluster.call("/bad", "poke").outcome, Outcome::Done);
}

TEST(SimplexCS, LongCommandBegunInStandbyIsCancelledByAFault) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a", "LongProbe");
    probe.onWork = [](Probe&, Call& call) {
        return call.cancelling() ? Outcome::Cancelled : Outcome::Running;
    };
    bool broken = false;
    probe.onStandby = [&](Probe& self, const Tick&) {
        if (broken) self.fault(3, "no pressure");
    };
    cluster.start();
    const std::uint64_t sequence = cluster.cluster->send("/a", "watch");
    cluster.step(3);
    broken = true;
    cluster.step(2);

    CallResult result;
    ASSERT_TRUE(cluster.cluster->program().poll(sequence, result));
    EXPECT_EQ(result.text(), "Cancelled: its simplex went to Fault: no pressure");
}

TEST(SimplexCS, StartupThatIsOutrankedIsAnsweredSo) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    cluster.start();
    const std::uint64_t sequence = cluster.cluster->send("/a", "startup");
    cluster.cluster->agent().postLifeCycle(probe.index(), LifeCycle::Shutdown, false);
    cluster.step();

    CallResult result;
    ASSERT_TRUE(cluster.cluster->program().poll(sequence, result));
    EXPECT_EQ(result.text(), "Rejected (state): another life-cycle command outranks it");
    cluster.step();
    EXPECT_EQ(cluster.integer("/test", "rejectedCount"), 1);
}

TEST(SimplexCS, CommandsKnowTheTimeOfTheirCycleEvenBeforeTheFirstHook) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a", "LongProbe");
    std::vector<double> times, elapsed;
    probe.onPoke = [&](Probe&, Call& call) {
        times.push_back(call.seconds());
        return Outcome::Done;
    };
    probe.onWork = [&](Probe&, Call& call) {
        elapsed.push_back(call.elapsedSeconds());
        return call.elapsedSeconds() < 0.002 ? Outcome::Running : Outcome::Done;
    };
    cluster.start();
    cluster.step(4000);
    cluster.call("/a", "poke");
    cluster.call("/a", "watch");

    EXPECT_EQ(times, (std::vector<double>{4.0}));
    EXPECT_EQ(elapsed, (std::vector<double>{0, 0.001, 0.002}));
}

}  // namespace

}  // namespace cortex::test
