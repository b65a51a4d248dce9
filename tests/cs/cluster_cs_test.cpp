// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"

#include "support/probe.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

using namespace std::chrono_literals;

std::string refusal(ProbeCluster& cluster) {
    try {
        cluster.start();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(ClusterCS, RefusesAModelThatBreaksARuleAndStaysStopped) {
    ProbeCluster cluster;
    cluster.tree.add<Probe>("/drive", "Drive");

    const std::string text = refusal(cluster);

    EXPECT_NE(text.find("/drive: "), std::string::npos) << text;
    EXPECT_NE(text.find("'demand'"), std::string::npos) << text;
    EXPECT_NE(text.find("'observation'"), std::string::npos) << text;
    EXPECT_EQ(cluster.cluster->ended(), cs::Ended::NotStarted);
}

TEST(ClusterCS, RefusesAnActiveTypeWithoutAClassAndSaysWhatHelps) {
    ProbeCluster cluster;
    cluster.tree.add("/a", "Probe");

    const std::string text = refusal(cluster);

    EXPECT_NE(text.find("/a: no C++ class implements the active type Probe"), std::string::npos)
        << text;
    EXPECT_NE(text.find("--plugin"), std::string::npos) << text;
}

TEST(ClusterCS, TellsEveryFailureOfPopulateWithItsPath) {
    ProbeCluster cluster;
    for (const char* path : {"/a", "/b"}) {
        cluster.probe(path).onPopulate = [](Probe& self) { self.output("out"); };
    }
    const std::string text = refusal(cluster);

    EXPECT_NE(text.find("/a: "), std::string::npos) << text;
    EXPECT_NE(text.find("/b: "), std::string::npos) << text;
}

TEST(ClusterCS, RefusesALoopWithoutDelayAndPrintsItWhole) {
    ProbeCluster cluster;
    Probe& a = cluster.probe("/a");
    Probe& b = cluster.probe("/b");
    Simplex& s = cluster.tree.add("/s", "Signal");
    Simplex& t = cluster.tree.add("/t", "Signal");
    cluster.tree.relate(a, "out", s);
    cluster.tree.relate(b, "in", s);
    cluster.tree.relate(b, "out", t);
    cluster.tree.relate(a, "in", t);

    const std::string text = refusal(cluster);

    for (const char* path : {"/a", "/s", "/b", "/t", "delayed"}) {
        EXPECT_NE(text.find(path), std::string::npos) << text;
    }
}

TEST(ClusterCS, NeedsATreeATriggerAndIsStartedOnce) {
    cs::ClusterCS bare{"bare"};
    EXPECT_THROW(bare.start(), Error);
    EXPECT_THROW(bare.agent(), Error);
    EXPECT_THROW(cs::ClusterCS{"not a name"}, Error);
    ProbeCluster cluster;
    cluster.start();
    EXPECT_THROW(cluster.start(), Error);
    EXPECT_THROW(cluster.cluster->addSimplexTree(cluster.tree), Error);
}

TEST(ClusterCS, HasItsMetricsSimplexAtItsName) {
    ProbeCluster cluster;
    cluster.probe("/a");
    cluster.start();
    cluster.step(3);

    EXPECT_EQ(cluster.cluster->image().cycle(), 3);
    EXPECT_EQ(cluster.integer("/test", "overflowCount"), 0);
    EXPECT_TRUE(cluster.cluster->image().get<bool>("/test", "alive"));
}

TEST(ClusterCS, MetricsOfACycleStandInTheNextImage) {
    ProbeCluster cluster;
    cluster.probe("/a").onLoopStart = [](Probe&, const Tick&) {};
    cluster.start();

    cluster.step();
    EXPECT_EQ(cluster.number("/test", "dutyCycleLast"), 0);
    cluster.step();
    EXPECT_GT(cluster.number("/test", "dutyCycleLast"), 0);
    EXPECT_GT(cluster.number("/test", "dutyCycleMean"), 0);
    cluster.step(200);
    for (const char* name : {"cycleDuration", "dutyCycle"}) {
        const std::string metric{name};
        const double p50 = cluster.number("/test", metric + "P50");
        const double p99 = cluster.number("/test", metric + "P99");
        const double p999 = cluster.number("/test", metric + "P999");
        EXPECT_GT(p50, 0) << name;
        EXPECT_LE(p50, p99) << name;
        EXPECT_LE(p99, p999) << name;
        EXPECT_LE(p999, cluster.number("/test", metric + "Max")) << name;
    }
}

TEST(ClusterCS, CountsCommandsAndTheirLatencyInCyclesAndMicroseconds) {
    ProbeCluster cluster;
    cluster.probe("/a");
    cluster.start();
    const CallResult done = cluster.call("/a", "poke");
    const CallResult rejected = cluster.call("/a", "add", {{"amount", std::vector{1.0}}});
    cluster.step(70);

    EXPECT_EQ(done.outcome, Outcome::Done);
    EXPECT_EQ(done.latencyCycles, 0);
    EXPECT_EQ(rejected.outcome, Outcome::Rejected);
    EXPECT_EQ(cluster.integer("/test", "commandCount"), 1);
    EXPECT_EQ(cluster.integer("/test", "rejectedCount"), 1);
    EXPECT_GT(cluster.number("/test", "commandLatencyMax"), 0);
}

TEST(ClusterCS, TimesEachTaskInTurn) {
    ProbeCluster cluster;
    for (int i = 0; i < 5; ++i) cluster.probe("/p" + std::to_string(i));
    cluster.start();
    cluster.step(20);

    for (int i = 0; i < 5; ++i) {
        EXPECT_GT(cluster.number("/p" + std::to_string(i), "taskTime"), 0) << i;
    }
}

TEST(ClusterCS, StopShutsDownInReverseOrderWithSafeDemandsAndALastImage) {
    ProbeCluster cluster;
    std::vector<std::string> order;
    Simplex& signal = cluster.tree.add("/s", "Signal");
    Probe& first = cluster.probe("/first");
    Probe& second = cluster.probe("/second");
    cluster.tree.relate(first, "out", signal);
    cluster.tree.relate(second, "in", signal);
    for (Probe* probe : {&first, &second}) {
        probe->onShuttingDown = [&order](Probe& self, const Tick&) {
            order.push_back(self.path());
            return true;
        };
    }
    first.onPopulate = [](Probe& self) {
        Data<double> out = self.output("out").data<double>("value");
        self.onActive = [out](Probe&, const Tick&) mutable { out = 3; };
    };
    cluster.start();
    cluster.startup(first);
    cluster.startup(second);
    ASSERT_EQ(cluster.number("/s", "value"), 3);

    EXPECT_TRUE(cluster.cluster->stop());

    EXPECT_EQ(order, (std::vector<std::string>{"/second", "/first"}));
    EXPECT_EQ(cluster.number("/s", "value"), 0);
    EXPECT_EQ(cluster.state("/first"), State::Standby);
    EXPECT_EQ(cluster.cluster->ended(), cs::Ended::Stopped);
}

TEST(ClusterCS, StopForcesStandbyWithSafeDemandsWhereAShutdownDoesNotEnd) {
    ProbeCluster cluster;
    Simplex& signal = cluster.tree.add("/s", "Signal");
    Probe& stubborn = cluster.probe("/stubborn");
    stubborn.runEvery(7);
    cluster.tree.relate(stubborn, "out", signal);
    stubborn.onShuttingDown = [](Probe&, const Tick&) { return false; };
    cluster.start();
    cluster.startup(stubborn);

    EXPECT_TRUE(cluster.cluster->stop());

    EXPECT_EQ(cluster.state("/stubborn"), State::Standby);
}

TEST(ClusterCS, CallsHeartbeatsAfterEachCycle) {
    ProbeCluster cluster;
    std::vector<std::int64_t> beats;
    cluster.cluster->addHeartbeat([&](const cs::Heartbeat& beat) {
        EXPECT_TRUE(beat.alive);
        beats.push_back(beat.cycle);
    });
    cluster.start();
    cluster.step(3);

    EXPECT_EQ(beats, (std::vector<std::int64_t>{1, 2, 3}));
}

TEST(Overflow, SkipGoesOnAtTheNextTickOfTheGridAndCountsEachMissedOne) {
    ProbeCluster cluster;
    std::vector<std::int64_t> times;
    std::vector<std::int64_t> elapsed;
    cluster.probe("/a").onLoopStart = [&](Probe&, const Tick& tick) {
        times.push_back(tick.nominalTime / 1'000'000);
        elapsed.push_back(tick.elapsed / 1'000'000);
    };
    cluster.start();
    cluster.step(2);
    cluster.trigger->lateBy(3);
    cluster.step(3);

    EXPECT_EQ(times, (std::vector<std::int64_t>{0, 1, 2, 6, 7}));
    EXPECT_EQ(elapsed, (std::vector<std::int64_t>{1, 1, 1, 4, 1}));
    EXPECT_EQ(cluster.integer("/test", "overflowCount"), 3);
    EXPECT_TRUE(cluster.hasEvent("/test: missed 3 ticks, 3 since the start"));
}

TEST(Overflow, CatchUpRunsTheMissedTicksAtOnceAndCountsThemOnce) {
    ProbeCluster cluster{{.overflow = cs::Overflow::CatchUp, .catchUpCycles = 5}};
    std::vector<std::int64_t> times;
    cluster.probe("/a").onLoopStart = [&](Probe&, const Tick& tick) {
        times.push_back(tick.nominalTime / 1'000'000);
    };
    cluster.start();
    cluster.step(2);
    cluster.trigger->lateBy(3);
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
    cluster.trigger->lateBy(5);
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
    cluster.trigger->lateBy(1);
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

TEST(Overflow, WarnTellsEachCycleAboveItsDutyThreshold) {
    ProbeCluster cluster{{.warnDuty = 1e-6}};
    cluster.probe("/a");
    cluster.start();
    cluster.step(3);

    EXPECT_TRUE(cluster.hasEvent("% is above 1e-06 %"));
}

TEST(GroupCommands, StartAWholePlantInCanonicalOrderEachWaitingForThoseBefore) {
    ProbeCluster cluster;
    std::vector<std::string> active;
    Simplex& signal = cluster.tree.add("/plant/s", "Signal");
    Probe& last = cluster.probe("/plant/a-last");
    Probe& first = cluster.probe("/plant/z-first");
    Probe& outside = cluster.probe("/elsewhere");
    cluster.tree.relate(first, "out", signal);
    cluster.tree.relate(last, "in", signal);
    int starting = 0;
    first.onStartingUp = [&](Probe&, const Tick&) { return ++starting == 3; };
    last.onStartingUp = [&](Probe&, const Tick&) {
        EXPECT_EQ(first.state(), State::Active);
        return true;
    };
    cluster.start();

    const CallResult result =
        cluster.call("/test", "startup", {{"prefix", std::vector<std::string>{"/plant"}}});

    EXPECT_EQ(result.outcome, Outcome::Done) << result.text();
    EXPECT_EQ(last.state(), State::Active);
    EXPECT_EQ(outside.state(), State::Standby);
}

TEST(GroupCommands, NameWhoDidNotFollowAndStartNothingThatComesAfter) {
    ProbeCluster cluster;
    Simplex& signal = cluster.tree.add("/s", "Signal");
    Probe& first = cluster.probe("/first");
    Probe& after = cluster.probe("/after");
    cluster.tree.relate(first, "out", signal);
    cluster.tree.relate(after, "in", signal);
    first.onStartingUp = [](Probe& self, const Tick&) {
        self.fault(9, "no pressure");
        return false;
    };
    cluster.start();

    const CallResult result =
        cluster.call("/test", "startup", {{"prefix", std::vector<std::string>{"/"}}});

    EXPECT_EQ(result.outcome, Outcome::Failed);
    EXPECT_NE(result.why.find("/first did not follow: no pressure"), std::string::npos)
        << result.text();
    EXPECT_EQ(after.state(), State::Standby);

    first.onStartingUp = nullptr;
    EXPECT_EQ(
        cluster.call("/test", "clearFaults", {{"prefix", std::vector<std::string>{"/"}}}).outcome,
        Outcome::Done);
    EXPECT_EQ(first.state(), State::Standby);
}

TEST(GroupCommands, LeaveManagedSimplexesToTheirManager) {
    ProbeCluster cluster;
    Probe& manager = cluster.probe("/manager");
    Probe& choice = cluster.probe("/choice");
    cluster.tree.relate(manager, "after", choice);
    Probe::LifeCycleSender sender;
    manager.onPopulate = [&](Probe& self) { sender = self.lifeCycle(self.output("after"), true); };
    manager.onActive = [&](Probe&, const Tick& tick) {
        if (tick.cycle > 20 && sender.state() == State::Standby) sender.startup();
    };
    manager.onShuttingDown = [&](Probe&, const Tick&) {
        if (sender.state() == State::Standby) return true;
        sender.shutdown();
        return false;
    };
    cluster.start();
    const ProgramInterface::Arguments all{{"prefix", std::vector<std::string>{"/"}}};

    EXPECT_EQ(cluster.call("/test", "startup", all).outcome, Outcome::Done);
    EXPECT_EQ(choice.state(), State::Standby);
    cluster.step(25);
    EXPECT_EQ(choice.state(), State::Active);
    EXPECT_EQ(cluster.call("/test", "shutdown", all).outcome, Outcome::Done);
    EXPECT_EQ(choice.state(), State::Standby);
    EXPECT_EQ(manager.state(), State::Standby);
}

TEST(GroupCommands, AShutdownReplacesAStartupThatIsStillGoingOn) {
    ProbeCluster cluster;
    Probe& slow = cluster.probe("/slow");
    slow.onStartingUp = [](Probe&, const Tick&) { return false; };
    cluster.start();
    const ProgramInterface::Arguments all{{"prefix", std::vector<std::string>{"/"}}};
    cluster.cluster->send("/test", "startup", all);
    cluster.step(5);
    ASSERT_EQ(slow.state(), State::StartingUp);

    cluster.call("/test", "shutdown", all);

    EXPECT_EQ(slow.state(), State::Standby);
}

// A hook that blocks until the test lets it go.
struct Blocker {
    std::atomic<bool> block{false}, released{false};
    void operator()() {
        if (!block.load()) return;
        while (!released.load()) std::this_thread::yield();
        block.store(false);
    }
};

TEST(Watchdog, NamesTheHookThatDoesNotReturnAndTheLoopResumesWhenItDoes) {
    ProbeCluster cluster;
    Blocker blocker;
    std::atomic<bool> reported{false};
    std::string hung;
    cluster.cluster->addHeartbeat([&](const cs::Heartbeat& beat) {
        if (beat.alive) return;
        hung = std::string{beat.hungPath} + " " + std::string{beat.hungHook};
        reported.store(true);
    });
    cluster.probe("/a").onLoopStart = [&](Probe&, const Tick&) { blocker(); };
    cluster.start();
    cluster.step();
    blocker.block.store(true);

    std::thread stepping{[&] { cluster.step(); }};
    while (!reported.load()) std::this_thread::yield();
    blocker.released.store(true);
    stepping.join();

    EXPECT_EQ(hung, "/a loopStart");
    EXPECT_TRUE(cluster.hasEvent("/a: /a does not return from loopStart"));
    cluster.step();
    EXPECT_FALSE(cluster.cluster->image().get<bool>("/test", "alive"));
    cluster.step();
    EXPECT_TRUE(cluster.cluster->image().get<bool>("/test", "alive"));
}

using WatchdogDeathTest = testing::Test;

TEST(WatchdogDeathTest, StopGivesUpNamesTheHookAndEndsTheProcess) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(
        {
            ProbeCluster cluster;
            std::atomic<bool> hanging{false};
            cluster.probe("/a").onLoopEnd = [&](Probe&, const Tick& tick) {
                while (tick.cycle == 2) hanging.store(true);
            };
            cluster.start();
            cluster.step();
            std::thread stepping{[&] { cluster.step(); }};
            while (!hanging.load()) std::this_thread::yield();
            cluster.cluster->stop();
        },
        testing::ExitedWithCode(3), "cluster test does not stop: /a does not return from loopEnd");
}

TEST(InternalClock, KeepsItsGridWithoutDrift) {
    cs::InternalClock clock{1ms};
    clock.start();
    std::int64_t expected = 0;
    for (int i = 0; i < 50; ++i) {
        const cs::Trigger trigger = clock.waitForTick();
        expected += trigger.periods * 1'000'000;
        EXPECT_EQ(trigger.nominalTime, expected - 1'000'000);
        EXPECT_GE(trigger.lateness, 0);
    }
}

TEST(InternalClock, IsInterruptedFromAnotherThread) {
    cs::InternalClock clock{1h};
    clock.start();
    clock.waitForTick();
    std::thread interrupting{[&] { clock.interrupt(); }};
    EXPECT_TRUE(clock.waitForTick().stopped);
    interrupting.join();
}

TEST(ExternalTrigger, RunsACycleForEachNotificationAndCountsWhatItMissed) {
    cs::ExternalTrigger trigger{1ms};
    trigger.start();
    trigger.notify();
    EXPECT_EQ(trigger.waitForTick().nominalTime, 0);
    trigger.notify();
    trigger.notify();
    trigger.notify();
    EXPECT_EQ(trigger.missed(), 3);
    const cs::Trigger late = trigger.waitForTick();
    EXPECT_EQ(late.periods, 3);
    EXPECT_EQ(late.nominalTime, 3'000'000);
    std::thread interrupting{[&] { trigger.interrupt(); }};
    EXPECT_TRUE(trigger.waitForTick().stopped);
    interrupting.join();
}

TEST(ClusterCS, RunsOnTheInternalClockUntilStopped) {
    SimplexTree tree{TypeModel::load(std::string{CORTEX_SOURCE_DIR} + "/tests/data/cs-rules.xml")};
    std::atomic<int> runs{0};
    auto& probe = tree.add<Probe>("/a", "Probe");
    probe.onLoopStart = [&](Probe&, const Tick&) { ++runs; };
    cs::ClusterCS cluster{"live", {.threads = 2}};
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<cs::InternalClock>(1ms);
    cluster.start();
    const CallResult result = cluster.call("/a", "startup");
    while (runs.load() < 20) std::this_thread::yield();

    EXPECT_EQ(result.outcome, Outcome::Done) << result.text();
    EXPECT_TRUE(cluster.stop());
    EXPECT_EQ(cluster.image().get<std::int64_t>("/a", "state"), 0);
}

TEST(StopSignals, EndTheWaitAndAreNotLost) {
    cs::blockStopSignals();
    raise(SIGTERM);
    EXPECT_TRUE(cs::waitForInterrupt());
    EXPECT_FALSE(cs::waitForInterrupt(0, [] { return true; }));
    EXPECT_FALSE(cs::waitForInterrupt(0.001));
}

}  // namespace

}  // namespace cortex::test
