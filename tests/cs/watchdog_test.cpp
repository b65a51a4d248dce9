// SPDX-License-Identifier: Apache-2.0
#include "support/probe.hpp"

#include <atomic>
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
    while (!reported.load()) std::this_thread::yield();
    blocker.released.store(true);
    stepping.join();

    EXPECT_EQ(hung, "/a loopStart");
    EXPECT_TRUE(cluster.hasEvent("/a: /a does not return from loopStart"));
    EXPECT_EQ(hungSince, 1'000'000);  // nominal time of the second cycle
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

}  // namespace

}  // namespace cortex::test
