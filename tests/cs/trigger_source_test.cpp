// SPDX-License-Identifier: Apache-2.0
#include "cortex/cs/trigger_source.hpp"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

using namespace std::chrono_literals;

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

TEST(ExternalTrigger, ReturnsMissedNotificationsAtOnceWhereTheyAreToBeCaughtUp) {
    cs::ExternalTrigger trigger{1ms};
    trigger.start();
    trigger.skipMissed(false);
    for (int i = 0; i < 3; ++i) trigger.notify();

    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(trigger.missed(), 3 - i);
        const cs::Trigger tick = trigger.waitForTick();
        EXPECT_EQ(tick.periods, 1);
        EXPECT_EQ(tick.nominalTime, i * 1'000'000);
    }
    EXPECT_EQ(trigger.missed(), 0);
}

}  // namespace

}  // namespace cortex::test
