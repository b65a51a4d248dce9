// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"
#include "cortex/core/clock.hpp"

#include "loop/running_time.hpp"
#include "support/probe.hpp"
#include "support/waiting.hpp"

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

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
    std::int64_t hungSince = -1;
    cluster.cluster->addEventSink([&](const Event& event, const Structure&) {
        if (event.kind == EventKind::Watchdog) hungSince = event.time;
    });
    cluster.probe("/a").onLoopStart = [&](Probe&, const Tick&) { blocker(); };
    cluster.start();
    cluster.step();
    blocker.block.store(true);

    std::thread stepping{[&] { cluster.step(); }};
    EXPECT_TRUE(comesTrue("the report", [&] { return reported.load(); }));
    const auto standstill = cluster.cluster->agent().standstill().get();
    blocker.released.store(true);
    stepping.join();
    EXPECT_TRUE(comesTrue("the end of the standstill",
                          [&] { return !cluster.cluster->agent().standstill().get(); }));

    ASSERT_TRUE(standstill);
    EXPECT_EQ(standstill->why, "hangs in /a.loopStart");
    EXPECT_LE(standstill->since, monotonicNow());

    EXPECT_EQ(hung, "/a loopStart");
    EXPECT_TRUE(cluster.hasEvent("/a: /a does not return from loopStart"));
    EXPECT_EQ(hungSince, 1'000'000);  // nominal time of the second cycle
    cluster.step();
    EXPECT_FALSE(cluster.cluster->image().get<bool>("/test", "alive"));
    cluster.step();
    EXPECT_TRUE(cluster.cluster->image().get<bool>("/test", "alive"));
}

// A loop whose ticks come from the test.
struct ToldLoop {
    ProbeCluster cluster;
    cs::ExternalTrigger* trigger = nullptr;
    std::atomic<bool> dead{false};
    std::string hung;

    explicit ToldLoop(double triggerTimeout) : cluster{{.triggerTimeout = triggerTimeout}} {
        cluster.trigger = nullptr;
        trigger =
            &cluster.cluster->setTriggerSource<cs::ExternalTrigger>(std::chrono::milliseconds{1});
        cluster.cluster->addHeartbeat([this](const cs::Heartbeat& beat) {
            if (beat.alive) return;
            hung = std::string{beat.hungPath} + ": " + std::string{beat.hungHook};
            dead.store(true);
        });
    }
    std::int64_t cycle() { return cluster.cluster->image().cycle(); }
    void tick() {
        const std::int64_t before = cycle();
        trigger->notify();
        waitUntil("a cycle", [&] { return cycle() != before; });
    }
    void startup(const std::string& path) {
        cluster.cluster->send(path, "startup");
        waitUntil("the start-up of " + path, [&] {
            if (cluster.state(path) == State::Active) return true;
            tick();
            return false;
        });
    }
};

TEST(Watchdog, TellsThatNoTickComesUntilOneDoes) {
    ToldLoop loop{1000};
    loop.cluster.probe("/a");
    loop.cluster.start();
    loop.startup("/a");
    ASSERT_TRUE(comesTrue("the report", [&] { return loop.dead.load(); }));
    AgentRuntime& agent = loop.cluster.cluster->agent();

    EXPECT_EQ(loop.hung, "/test: the trigger");
    ASSERT_TRUE(agent.standstill().get());
    EXPECT_EQ(agent.standstill().get()->why, "has had no tick");
    EXPECT_TRUE(loop.cluster.hasEvent("/test: no tick has come for longer than the watchdog"));
    EXPECT_EQ(loop.cluster.state("/a"), State::Active);
    loop.tick();
    EXPECT_FALSE(loop.cluster.cluster->image().get<bool>("/test", "alive"));
    EXPECT_TRUE(comesTrue("the end of the standstill", [&] {
        if (!agent.standstill().get()) return true;
        loop.tick();
        return false;
    }));
    EXPECT_TRUE(loop.cluster.cluster->image().get<bool>("/test", "alive"));
}

TEST(Watchdog, FaultsAllThatIsActiveWhenNoTickComesWithinTheTimeout) {
    ToldLoop loop{0.1};
    Probe& writer = loop.cluster.probe("/a");
    Simplex& demand = loop.cluster.tree.add("/d", "Demand");
    loop.cluster.tree.relate(writer, "demand", demand);
    loop.cluster.tree.relate(writer, "observed", loop.cluster.tree.add("/o", "Observation"));
    Data<double> velocity;
    writer.onPopulate = [&](Probe& self) {
        velocity = self.output("demand").data<double>("velocity");
    };
    writer.onActive = [&](Probe&, const Tick&) { velocity = 1.5; };
    loop.cluster.start();
    loop.cluster.cluster->send("/a", "startup");
    bool wasActive = false;
    ASSERT_TRUE(comesTrue("the fault", [&] {
        if (loop.cluster.state("/a") == State::Fault) return true;
        if (!wasActive) loop.tick();
        wasActive = wasActive || loop.cluster.state("/a") == State::Active;
        return false;
    }));

    EXPECT_EQ(loop.cluster.integer("/a", "faultCode"), -7);
    EXPECT_EQ(loop.cluster.number("/d", "velocity"), 0) << "the safe demand";
    EXPECT_TRUE(loop.cluster.hasEvent("/a: fault -7: no tick came within the trigger's timeout"));
    const std::int64_t then = loop.cycle();
    loop.tick();
    EXPECT_EQ(loop.cycle(), then + 1) << "the loop goes on with the next tick";
    EXPECT_EQ(loop.cluster.state("/a"), State::Fault) << "and starts nothing by itself";
}

TEST(RunningTime, CountsLittleOfAPauseInWhichTheProcessWasStopped) {
    using namespace std::chrono_literals;
    cs::RunningTime time{10ms};
    const std::int64_t start = monotonicNow();
    time.lookAt(start);
    const auto before = time.lookAt(start);
    const std::int64_t hour = 3'600'000'000'000;

    EXPECT_EQ(time.lookAt(start + 3'000'000) - before, 3ms);
    EXPECT_EQ(time.lookAt(start + hour) - before, 13ms);
    EXPECT_EQ(time.lookAt(start + hour + 1'000'000) - before, 14ms);
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
            waitUntil("a hook that hangs", [&] { return hanging.load(); });
            cluster.cluster->stop();
        },
        testing::ExitedWithCode(3), "cluster test does not stop: /a does not return from loopEnd");
}

}  // namespace

}  // namespace cortex::test
