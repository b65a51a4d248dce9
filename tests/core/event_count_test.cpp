// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/event_count.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

namespace cortex {
namespace {

constexpr std::int64_t hour = 3'600'000'000'000;

std::int64_t now() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

TEST(EventCount, LetsASleeperGoWhenTheValueChanges) {
    EventCount count;
    std::atomic<bool> stop{false};
    std::thread sleeper{[&] {
        std::uint32_t seen = 0;
        while (!stop) {
            count.sleepWhile(seen, now() + hour);
            seen = count.value();
        }
    }};
    for (int i = 0; i < 1000; ++i) count.advance();
    stop = true;
    count.advance();
    sleeper.join();
}

TEST(EventCount, LetsEverySleeperGo) {
    EventCount count;
    std::atomic<int> woken{0};
    const auto sleep = [&] {
        while (count.value() == 0) count.sleepWhile(0);
        ++woken;
    };
    std::thread first{sleep}, second{sleep}, third{sleep};
    count.publish(8);
    first.join();
    second.join();
    third.join();
    EXPECT_EQ(woken, 3);
    EXPECT_EQ(count.value(), 8U);
}

TEST(EventCount, DoesNotLetAThreadSleepForAChangeThatCameBefore) {
    EventCount count;
    count.advance();
    EXPECT_TRUE(count.sleepWhile(0, now() + hour));
    count.napWhile(0, now() + hour);
    EXPECT_EQ(count.value(), EventCount::step);
}

TEST(EventCount, SaysWhenASleeperWasNotWokenBeforeItsTime) {
    EventCount count;
    const std::int64_t soon = now() + 1'000'000;
    while (count.sleepWhile(0, soon)) {  // a signal may end it
    }
    EXPECT_GE(now(), soon);
    EXPECT_FALSE(count.sleepWhile(0, 1));
}

TEST(EventCount, LeavesAThreadThatNapsAsleepUntilItsTime) {
    EventCount count;
    const std::int64_t time = now() + 20'000'000;
    std::int64_t woken = 0;
    std::thread napper{[&] {
        // A wait may end early; once the value has changed no other begins.
        while (now() < time && count.value() == 0) count.napWhile(0, time);
        woken = now();
    }};
    while (now() < time - 10'000'000) std::this_thread::yield();
    count.advance();
    napper.join();
    EXPECT_EQ(count.value(), EventCount::step);
    EXPECT_GT(woken, 0);
}

TEST(EventCount, WakesAThreadThatNapsWhereItIsAskedTo) {
    EventCount count;
    std::thread napper{[&] {
        while (count.value() == 0) count.napWhile(0, now() + hour);
    }};
    count.wake();
    napper.join();
}

}  // namespace
}  // namespace cortex
