// SPDX-License-Identifier: Apache-2.0
#include "measure/recording_clock.hpp"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace cortex::profiler {
namespace {

using namespace std::chrono_literals;

// A loop that does nothing but wait for ticks.
struct Loop {
    RecordingClock clock{200us};
    std::int64_t cycles = 0;
    std::thread thread{[this] {
        clock.start();
        while (!clock.waitForTick().stopped) ++cycles;
    }};

    ~Loop() { end(); }
    void end() {
        clock.interrupt();
        if (thread.joinable()) thread.join();
    }
};

TEST(RecordingClock, RecordsAsManyCyclesSleepsAndWorksAsPlanned) {
    Loop loop;
    int begun = 0, ended = 0;
    std::size_t woken = 0;
    RecordingPlan plan{.blocks = 3, .loopPeriods = 20, .sleeperPeriods = 10, .workingPeriods = 5};
    plan.prepares = [&] { EXPECT_EQ(begun, 0); };
    plan.begins = [&] { ++begun; };
    plan.ends = [&] { ++ended; };
    plan.wakes = [&] { ++woken; };
    loop.clock.record(plan);
    while (!loop.clock.waitUntilDone(100ms)) {
    }
    loop.end();

    const Recording& recording = loop.clock.recording();
    EXPECT_TRUE(recording.complete);
    std::int64_t periods = 0, slept = 0;
    for (const auto& cycle : recording.cycles) periods += 1 + cycle.missed;
    for (const auto& sleep : recording.sleeps) slept += 1 + sleep.missed;
    EXPECT_GE(periods, 60);
    EXPECT_GE(slept, 30);
    std::int64_t worked = 0;
    for (const auto& work : recording.works) {
        worked += 1 + work.missed;
        EXPECT_GT(work.duration, 0);
    }
    EXPECT_GE(worked, 15);
    EXPECT_EQ(begun, 1);
    EXPECT_EQ(ended, 1);
    EXPECT_EQ(woken, recording.sleeps.size());
    for (const auto& cycle : recording.cycles) {
        EXPECT_GE(cycle.lateness, 0);
        EXPECT_GE(cycle.duration, 0);
        EXPECT_LT(cycle.block, 3);
    }
}

TEST(RecordingClock, KeepsWhatThereIsWhenAPlanIsAbandoned) {
    Loop loop;
    loop.clock.record({.blocks = 1, .loopPeriods = 1'000'000});
    loop.clock.abandon();
    while (!loop.clock.waitUntilDone(100ms)) {
    }
    loop.end();

    EXPECT_FALSE(loop.clock.recording().complete);
    EXPECT_LT(loop.clock.recording().cycles.size(), 1'000'000U);
}

TEST(RecordingClock, EndsALoopThatRestsBetweenPlans) {
    Loop loop;
    loop.end();

    EXPECT_EQ(loop.cycles, 0);
}

}  // namespace
}  // namespace cortex::profiler
