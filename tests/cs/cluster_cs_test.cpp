// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"

#include "support/awake_cpus.hpp"
#include "support/probe.hpp"
#include "support/safe_plant.hpp"
#include "support/stepped_clock.hpp"
#include "support/waiting.hpp"
#include "threads/realtime_thread.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>
#include <utility>
#include <vector>

#include <sched.h>

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
    cluster.probe("/c").onPopulate = [](Probe&) { throw 42; };
    const std::string text = refusal(cluster);

    EXPECT_NE(text.find("/a: "), std::string::npos) << text;
    EXPECT_NE(text.find("/b: "), std::string::npos) << text;
    EXPECT_NE(text.find("/c: populate() threw what is no std::exception"), std::string::npos)
        << text;
}

// A probe that writes its `executed` and the `value` of its output in populate().
struct Overwriting {
    ProbeCluster cluster;
    Simplex& signal = cluster.tree.add("/s", "Signal");
    Probe& probe = cluster.probe("/probe");

    Overwriting() {
        cluster.tree.relate(probe, "out", signal);
        probe.onPopulate = [](Probe& self) {
            self.data<std::int64_t>("executed") = 55;
            self.output("out").data<double>("value") = 2.5;
        };
    }
};

TEST(ClusterCS, RefusesAStartValueThatPopulateReplaces) {
    Overwriting test;
    test.probe.set("executed", 33, {"--set", 0});
    test.signal.set("value", 7.0, {"plant.xml", 12});

    const std::string text = refusal(test.cluster);

    EXPECT_NE(text.find("/probe: populate() writes 55 over executed, which is given as 33 [--set]; "
                        "read it, or write only where hasValue(\"executed\") is false"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("/probe: populate() writes 2.5 over value of /s, which is given as 7 "
                        "[plant.xml:12]"),
              std::string::npos)
        << text;
}

TEST(ClusterCS, RefusesAStartValueOfADemandThatNeverActs) {
    ProbeCluster cluster;
    Simplex& word = cluster.tree.add("/d", "DriveWord");
    cluster.tree.relate(cluster.probe("/a"), "out", word);
    word.set("speed", 5.0, {"plant.xml", 7});
    EXPECT_NE(refusal(cluster).find("/d: speed is given as 5, and begins at 0, where the demand is "
                                    "safe [plant.xml:7]; leave it out"),
              std::string::npos);

    SafePlant observed;
    observed.cluster.tree.at("/d").set("position", 2.0);
    EXPECT_NE(refusal(observed.cluster)
                  .find("/d: position is given as 2, and begins at 0.25, where the demand is safe; "
                        "leave it out, or give it to the simplex that observes the demand"),
              std::string::npos);
}

TEST(ClusterCS, TakesAStartValueOfADemandThatActs) {
    ProbeCluster cluster;
    Simplex& valve = cluster.tree.add("/v", "Valve");
    cluster.tree.relate(cluster.probe("/a"), "out", valve);
    valve.set("opening", 100.0);  // its safe value
    valve.set("last", 4.0);       // which it holds
    EXPECT_EQ(refusal(cluster), "");
}

TEST(ClusterCS, RefusesItAlsoWhereSeveralWriteTheSameSimplex) {
    ProbeCluster cluster;
    Simplex& shared = cluster.tree.add("/s", "SharedSignal");
    shared.set("value", 7.0);
    for (const char* path : {"/w1", "/w2"}) {
        Probe& writer = cluster.probe(path);
        cluster.tree.relate(writer, "out", shared);
        if (writer.path() == "/w1") continue;
        writer.onPopulate = [](Probe& self) { self.output("out").data<double>("value") = 2.5; };
    }
    const std::string text = refusal(cluster);

    EXPECT_NE(text.find("/w2: populate() writes 2.5 over value of /s"), std::string::npos) << text;
    EXPECT_EQ(text.find("/w1"), std::string::npos) << text;
}

TEST(ClusterCS, TakesWhatPopulateWritesWhereNothingElseWasGiven) {
    Overwriting equal;
    equal.probe.set("executed", 55);
    EXPECT_EQ(refusal(equal.cluster), "") << "the same value replaces nothing";

    Overwriting asks;
    asks.signal.set("level", 7.0);
    asks.probe.onPopulate = [](Probe& self) {
        if (!self.hasValue("executed")) self.data<std::int64_t>("executed") = 55;
        const OutputSimplex out = self.output("out");
        if (!out.hasValue("level")) out.data<double>("level") = 2.5;
        EXPECT_THROW(self.hasValue("execute"), Error);
    };
    EXPECT_EQ(refusal(asks.cluster), "");
    EXPECT_EQ(asks.cluster.integer("/probe", "executed"), 55);
    EXPECT_EQ(asks.cluster.number("/s", "level"), 7);
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

TEST(ClusterCS, IsTheStartThatItIsTold) {
    test::ProbeCluster told{{.epoch = 1'700'000'000'000'000}};
    told.start();
    EXPECT_EQ(told.cluster->image().structure().epoch, 1'700'000'000'000'000);
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

TEST(ClusterCS, PercentilesOfASlowLoopAreAboutASecondOld) {
    ProbeCluster cluster;
    cluster.trigger =
        &cluster.cluster->setTriggerSource<cs::ManualTrigger>(std::chrono::milliseconds{110});
    cluster.probe("/a");
    cluster.start();
    cluster.step(12);

    EXPECT_GT(cluster.number("/test", "cycleDurationP50"), 0);
    EXPECT_GT(cluster.number("/test", "dutyCycleP50"), 0);
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

    EXPECT_FALSE(cluster.cluster->stop());

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
    EXPECT_TRUE(comesTrue("20 cycles", [&] { return runs.load() >= 20; }));

    EXPECT_EQ(result.outcome, Outcome::Done) << result.text();
    EXPECT_TRUE(cluster.stop());
    EXPECT_EQ(cluster.image().get<std::int64_t>("/a", "state"), 0);
}

// Tasks whose cost nobody could know before: one thread to begin with, then as many as pay.
class CostlyTasks : public testing::TestWithParam<bool> {};

TEST_P(CostlyTasks, AreSharedAmongThreadsOnceTheyWereLookedAt) {
    SimplexTree tree{TypeModel::load(std::string{CORTEX_SOURCE_DIR} + "/tests/data/cs-rules.xml")};
    std::atomic<std::int64_t> lastCycle{0};
    std::atomic<int> outOfOrder{0};
    for (const char* path : {"/a", "/b", "/c", "/d"}) {
        tree.add<Probe>(path, "Probe").onLoopStart = [&](Probe&, const Tick& tick) {
            if (tick.cycle < lastCycle.exchange(tick.cycle)) ++outOfOrder;
            const auto end = std::chrono::steady_clock::now() + 500us;
            while (std::chrono::steady_clock::now() < end) {
            }
        };
    }
    for (int i = 1000; i < 1300; ++i) tree.add<Probe>("/p" + std::to_string(i), "Probe");
    if (cs::usableCpus().size() < 2) GTEST_SKIP() << "one CPU";
    // The CPUs are named, as loops beside this one may have claimed those that are free to all.
    cs::ClusterCS cluster{"live",
                          {.threads = 2,
                           .cpus = cs::usableCpus(),
                           .acrossCaches = true,
                           .overflow = cs::Overflow::Skip}};
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<cs::InternalClock>(4ms);
    cluster.start();
    EXPECT_EQ(cluster.threadsInUse(), 1U);
    // A look while others use the CPUs may find nothing better: then there is another one.
    const auto limit = std::chrono::steady_clock::now() + 60s;
    while (cluster.threadsInUse() == 1 && std::chrono::steady_clock::now() < limit) {
        if (GetParam()) {
            EXPECT_EQ(cluster.call("/live", "reschedule").outcome, Outcome::Done);
        } else {
            EXPECT_EQ(cluster.call("/a", "startup").outcome, Outcome::Done);
        }
        const auto looked = std::chrono::steady_clock::now() + 5s;
        while (cluster.threadsInUse() == 1 && std::chrono::steady_clock::now() < looked) {
            std::this_thread::yield();
        }
        if (cluster.threadsInUse() == 1 && !GetParam()) cluster.call("/a", "shutdown");
    }
    EXPECT_EQ(cluster.threadsInUse(), 2U);
    const std::int64_t before = cluster.image().cycle();
    std::size_t torn = 0;
    EXPECT_TRUE(comesTrue("20 more cycles", [&] {
        const Image image = cluster.image();
        for (int i = 1000; i < 1300; ++i) {
            const std::uint32_t index = image.structure().find("/p" + std::to_string(i));
            if (image.state(index).cycle != image.cycle()) ++torn;
        }
        return image.cycle() >= before + 20;
    }));
    EXPECT_EQ(torn, 0U);
    EXPECT_EQ(cluster.image().get<std::int64_t>("/live", "threads"), 2);
    EXPECT_EQ(outOfOrder.load(), 0);
    EXPECT_TRUE(cluster.stop());
}

INSTANTIATE_TEST_SUITE_P(Either, CostlyTasks, testing::Bool(), [](const auto& test) {
    return test.param ? "WhenAsked" : "AfterTheStartup";
});

// Nobody has asked for a look, and the loop has only the time that it is given.
TEST(ClusterCS, SharesCostlyTasksAmongThreadsUnderAManualTriggerToo) {
    if (cs::usableCpus().size() < 2) GTEST_SKIP() << "one CPU";
    // The CPUs are named, as loops beside this one may have claimed those that are free to all.
    ProbeCluster cluster{{.threads = 2, .cpus = cs::usableCpus(), .acrossCaches = true}};
    for (const char* path : {"/a", "/b", "/c", "/d"}) {
        cluster.probe(path).onLoopStart = [](Probe&, const Tick&) {
            const auto end = std::chrono::steady_clock::now() + 500us;
            while (std::chrono::steady_clock::now() < end) {
            }
        };
    }
    cluster.start();
    EXPECT_EQ(cluster.cluster->threadsInUse(), 1U);

    const auto limit = std::chrono::steady_clock::now() + 60s;
    while (cluster.cluster->threadsInUse() == 1 && std::chrono::steady_clock::now() < limit) {
        cluster.step(10);
        // A look while others use the CPUs may find nothing better.
        if (cluster.cluster->image().cycle() % 500 == 0) {
            cluster.cluster->send("/test", "reschedule");
        }
    }

    EXPECT_EQ(cluster.cluster->threadsInUse(), 2U);
    EXPECT_EQ(cluster.integer("/test", "threads"), 2);
    EXPECT_NE(cluster.cluster->image().get<std::string_view>("/test", "cpus"), "");
}

TEST(ClusterCS, UsesOneThreadForManyTasksThatCostNothing) {
    ProbeCluster cluster{{.threads = 2, .acrossCaches = true}};
    for (int i = 0; i < 2000; ++i) cluster.probe("/p" + std::to_string(1000 + i));

    cluster.start();

    EXPECT_EQ(cluster.cluster->threadsInUse(), 1U);
}

// Each relates to the one before it, so that the schedule makes one chunk of all.
TEST(ClusterCS, TimesAFewTasksInACycleHoweverTheyAreChained) {
    constexpr int count = 200;
    ProbeCluster cluster;
    for (int i = 0; i < count; ++i) {
        Probe& probe = cluster.probe("/p" + std::to_string(1000 + i));
        if (i == 0) continue;
        cluster.tree.relate(probe, "before", cluster.tree.at("/p" + std::to_string(1000 + i - 1)));
    }
    cluster.start();
    const auto timed = [&] {
        int sum = 0;
        for (int i = 0; i < count; ++i) {
            sum += cluster.number("/p" + std::to_string(1000 + i), "taskTime") > 0 ? 1 : 0;
        }
        return sum;
    };
    int before = 0;
    for (int cycle = 1; before < count && cycle <= count; ++cycle) {
        cluster.step();
        const int now = timed();
        EXPECT_GT(now, before) << "each comes in turn";
        EXPECT_LE(now - before, 64) << cycle;
        before = now;
    }
    EXPECT_EQ(before, count);
}

TEST(ClusterCS, RefusesToRescheduleWhereThereIsNothingToShareAnew) {
    ProbeCluster cluster;
    cluster.probe("/a");
    cluster.start();

    const CallResult result = cluster.call("/test", "reschedule");

    EXPECT_EQ(result.outcome, Outcome::Failed);
    EXPECT_NE(result.text().find("nothing to share anew"), std::string::npos) << result.text();
}

TEST(ClusterCS, TakesOtherCommandsWhileItLooksAtWhatTasksCost) {
    if (cs::usableCpus().size() < 2) GTEST_SKIP() << "one CPU";
    ProbeCluster cluster{{.threads = 2, .acrossCaches = true}};
    cluster.probe("/a");
    cluster.trigger = &cluster.cluster->setTriggerSource<SteppedClock>().trigger;
    cluster.start();

    EXPECT_EQ(cluster.call("/test", "reschedule").outcome, Outcome::Done);
    const CallResult startup = cluster.call("/test", "startup");
    EXPECT_EQ(startup.outcome, Outcome::Done) << startup.text();
    EXPECT_TRUE(comesTrue("what came of the look", [&] {
        cluster.step(10);
        return cluster.hasEvent("/test: reschedule: stays with 1 thread, no other plan is better");
    }));
}

std::size_t realTimeThreads() {
    std::size_t count = 0;
    for (const auto& task : std::filesystem::directory_iterator{"/proc/self/task"}) {
        if (sched_getscheduler(std::stoi(task.path().filename())) == SCHED_FIFO) ++count;
    }
    return count;
}

// A thread that makes plans or watches would hold the loop up at the loop's own priority.
TEST(ClusterCS, GivesItsPriorityToTheThreadsOfTheLoopOnly) {
    if (cs::usableCpus().size() < 2) GTEST_SKIP() << "one CPU";
    SimplexTree tree{TypeModel::load(std::string{CORTEX_SOURCE_DIR} + "/tests/data/cs-rules.xml")};
    tree.add<Probe>("/a", "Probe");
    // The CPUs are named, as tests beside this one may have claimed those that are free to all.
    cs::ClusterCS cluster{"live",
                          {.threads = 2,
                           .priority = 10,
                           .lockMemory = false,
                           .keepCpusAwake = false,
                           .cpus = cs::usableCpus()}};
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<cs::InternalClock>(1ms);
    cluster.start();
    if (!cluster.realtimeReport().empty()) GTEST_SKIP() << cluster.realtimeReport().front();
    ASSERT_EQ(cluster.threadsInUse(), 1U);

    EXPECT_EQ(realTimeThreads(), 1U);
}

int awakeCpuRequestsWhileRunning(cs::ClusterOptions options) {
    SimplexTree tree{TypeModel::load(std::string{CORTEX_SOURCE_DIR} + "/tests/data/cs-rules.xml")};
    tree.add<Probe>("/a", "Probe");
    cs::ClusterCS cluster{"live", std::move(options)};
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<cs::InternalClock>(1ms);
    cluster.start();
    const int requests = test::awakeCpuRequests();
    EXPECT_TRUE(cluster.stop());
    EXPECT_EQ(test::awakeCpuRequests(), 0);
    return requests;
}

TEST(ClusterCS, KeepsCpusAwakeWhileItsLoopRunsWithAPriority) {
    if (const std::string why = test::whyNoAwakeCpus(); !why.empty()) GTEST_SKIP() << why;

    EXPECT_EQ(awakeCpuRequestsWhileRunning({.priority = 10, .lockMemory = false}), 1);
    EXPECT_EQ(
        awakeCpuRequestsWhileRunning({.priority = 10, .lockMemory = false, .keepCpusAwake = false}),
        0);
    EXPECT_EQ(awakeCpuRequestsWhileRunning({}), 0);
}

TEST(ClusterCS, ReportsWhatSpeaksAgainstASpinningClock) {
    std::atomic<int> runs{0};
    SimplexTree tree{TypeModel::load(std::string{CORTEX_SOURCE_DIR} + "/tests/data/cs-rules.xml")};
    tree.add<Probe>("/a", "Probe").onStandby = [&](Probe&, const Tick&) { ++runs; };
    cs::ClusterCS cluster{"live"};
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<cs::InternalClock>(1ms, 100us);
    cluster.start();
    EXPECT_TRUE(comesTrue("5 cycles", [&] { return runs.load() >= 5; }));

    EXPECT_EQ(cluster.realtimeReport(),
              cs::spinReport(cs::placeOfThisThread(), 100'000, 1'000'000));
    EXPECT_TRUE(cluster.stop());
}

TEST(StopSignals, EndTheWaitAndAreNotLost) {
    cs::blockStopSignals();
    raise(SIGTERM);
    EXPECT_TRUE(cs::waitForInterrupt());
    EXPECT_FALSE(cs::waitForInterrupt(0, [] { return true; }));
    EXPECT_FALSE(cs::waitForInterrupt(0.001));
}

TEST(ClusterCS, StartsNothingUpWhileItStops) {
    ProbeCluster cluster;
    Probe& eager = cluster.probe("/eager");
    Probe& slow = cluster.probe("/slow");
    int startups = 0;
    eager.onStartingUp = [&](Probe&, const Tick&) { return ++startups > 0; };
    int ticks = 0;
    slow.onShuttingDown = [&](Probe&, const Tick&) {
        cluster.cluster->agent().postLifeCycle(eager.index(), LifeCycle::Startup, false);
        return ++ticks == 5;
    };
    cluster.start();
    cluster.startup(slow);

    EXPECT_TRUE(cluster.cluster->stop());

    EXPECT_EQ(ticks, 5);
    EXPECT_EQ(startups, 0);
    EXPECT_EQ(cluster.state("/eager"), State::Standby);
    EXPECT_TRUE(cluster.hasEvent("/eager: no startup: the cluster is stopping"));
}

TEST(ClusterCS, RefusesAClassWithoutAHandlerForACommandOfItsType) {
    ProbeCluster cluster;
    cluster.tree.add<cs::SimplexCS>("/mute", "Probe");
    cluster.probe("/a");
    const std::string text = refusal(cluster);
    const auto says = [&](const char* words) { return text.find(words) != std::string::npos; };

    EXPECT_TRUE(says("/mute: its type Probe has the command 'poke', but its class has no handler"))
        << text;
    EXPECT_TRUE(says("register one in populate(): on<&Class::function>(\"add\")")) << text;
    EXPECT_FALSE(says("/a: ")) << text;
    EXPECT_FALSE(says("'startup'")) << text;
}

TEST(ClusterCS, RefusesASenderThatLeavesOutAParameterWithoutDefault) {
    for (const bool takesIt : {false, true}) {
        ProbeCluster cluster;
        Probe& a = cluster.probe("/a");
        cluster.tree.relate(a, "after", cluster.probe("/b"));
        a.onPopulate = [&](Probe& self) {
            CommandSender sender = self.output("after").command("add");
            if (takesIt) sender.argument<double>("amount");
        };
        const std::string text = refusal(cluster);
        EXPECT_EQ(text.find("/a: it sends 'add' to /b without 'amount', which has no default") ==
                      std::string::npos,
                  takesIt)
            << text;
    }
}

TEST(ClusterCS, TellsTheWarningsOfItsModelAsEvents) {
    ProbeCluster cluster;
    Simplex& order = cluster.tree.add("/order", "Order");
    cluster.tree.relate(cluster.probe("/a"), "out", order, true);
    cluster.start();

    EXPECT_TRUE(cluster.hasEvent("/a: rule 'out' delays a demand: /order is a modification"));
}

}  // namespace

}  // namespace cortex::test
