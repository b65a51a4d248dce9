// SPDX-License-Identifier: Apache-2.0
#include "cortex/cs/trigger_source.hpp"

#include "cortex/core/error.hpp"

#include "support/waiting.hpp"
#include "threads/realtime_thread.hpp"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

using namespace std::chrono_literals;

// Spinning for nothing, a part of a period, all of it: what is returned is the same.
class InternalClock : public testing::TestWithParam<std::chrono::nanoseconds> {};

INSTANTIATE_TEST_SUITE_P(Spinning, InternalClock, testing::Values(0ns, 300us, 1h));

TEST_P(InternalClock, KeepsItsGridWithoutDrift) {
    cs::InternalClock clock{1ms, GetParam()};
    clock.start();
    std::int64_t expected = 0;
    for (int i = 0; i < 50; ++i) {
        const cs::Trigger trigger = clock.waitForTick();
        expected += trigger.periods * 1'000'000;
        EXPECT_EQ(trigger.nominalTime, expected - 1'000'000);
        EXPECT_GE(trigger.lateness, 0);
    }
}

TEST_P(InternalClock, SaysWhenTheNextTickIsDue) {
    cs::InternalClock clock{1ms, GetParam()};
    clock.start();
    clock.waitForTick();
    for (int i = 0; i < 10; ++i) {
        const std::int64_t due = clock.nextDeadline();
        const cs::Trigger trigger = clock.waitForTick();
        const std::int64_t now = std::chrono::steady_clock::now().time_since_epoch().count();
        const std::int64_t deadline = due + (trigger.periods - 1) * 1'000'000;
        EXPECT_GE(now, deadline + trigger.lateness);
        EXPECT_EQ(clock.nextDeadline(), deadline + 1'000'000);
    }
}

TEST_P(InternalClock, IsInterruptedFromAnotherThread) {
    cs::InternalClock clock{1h, GetParam()};
    clock.start();
    clock.waitForTick();
    std::thread interrupting{[&] { clock.interrupt(); }};
    EXPECT_TRUE(clock.waitForTick().stopped);
    interrupting.join();
}

TEST_P(InternalClock, CountsTheDeadlinesThatItWasNotAskedFor) {
    cs::InternalClock clock{1ms, GetParam()};
    clock.start();
    clock.waitForTick();
    ASSERT_TRUE(test::comesTrue("two missed deadlines", [&] { return clock.missed() >= 2; }));

    const cs::Trigger late = clock.waitForTick();

    EXPECT_GE(late.periods, 3);
    EXPECT_EQ(late.nominalTime, late.periods * 1'000'000);
}

TEST(SpinningClock, SaysWhatSpinningCostsOthersAndTheSleepingOneNothing) {
    EXPECT_TRUE(cs::InternalClock{1ms}.report().empty());
    const auto place = cs::placeOfThisThread();
    const auto lines = cs::InternalClock(1ms, 1h).report();
    EXPECT_EQ(lines, cs::spinReport(place, 1'000'000, 1'000'000));
    EXPECT_THROW(cs::InternalClock(1ms, -1ns), Error);
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
