// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_self.hpp"
#include "agent/agent_wake.hpp"

#include <atomic>
#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

constexpr std::int64_t millisecond = 1'000'000, hour = 3'600'000 * millisecond;
constexpr std::int64_t longestLead = millisecond / 20;

TEST(Wake, EndsAWaitAndIsNotForgotten) {
    Wake wake;
    wake.signal();
    wake.waitUntil(steadyNow() + hour);  // it came before

    std::atomic<bool> stop{false};
    std::thread sleeper{[&] {
        while (!stop) wake.waitUntil(steadyNow() + hour);
    }};
    for (int i = 0; i < 1000; ++i) wake.signal();
    stop = true;
    wake.signal();
    sleeper.join();
}

TEST(Wake, AnAwaitedSignalThatCameBeforeIsNotForgotten) {
    Wake wake;
    wake.signalAwaited();
    EXPECT_TRUE(wake.await(steadyNow() + hour));
    wake.signalAwaited();
    wake.waitUntil(steadyNow() + hour);
}

// Not every time: on a busy machine it may come before he sleeps, or after he gave up.
TEST(Wake, AnAwaitedSignalLeavesWhoComesByHimselfAsleep) {
    Wake wake;
    int leftAsleep = 0;
    for (int i = 0; i < 20; ++i) {
        const std::int64_t time = steadyNow() + 20 * millisecond;
        std::thread sleeper{[&] {
            const bool came = wake.await(time);
            if (came && steadyNow() >= time - longestLead) ++leftAsleep;
        }};
        while (!wake.isSleeping() && steadyNow() < time) std::this_thread::yield();
        while (steadyNow() < time - 10 * millisecond) std::this_thread::yield();
        wake.signalAwaited();
        sleeper.join();
        wake.waitUntil(0);
    }
    EXPECT_GT(leftAsleep, 0);
}

TEST(Wake, AnAwaitedSignalWakesWhoDidNotExpectIt) {
    Wake wake;
    std::thread sleeper{[&] { wake.waitUntil(steadyNow() + hour); }};
    while (!wake.isSleeping()) std::this_thread::yield();
    wake.signalAwaited();
    sleeper.join();
}

TEST(Wake, AnyOtherSignalWakesWhoComesByHimself) {
    Wake wake;
    for (int i = 0; i < 100; ++i) {
        std::thread sleeper{[&] { EXPECT_TRUE(wake.await(steadyNow() + hour)); }};
        while (!wake.isSleeping()) std::this_thread::yield();
        if (i % 2 == 0) wake.signalAwaited();  // leaves him asleep
        wake.signal();
        sleeper.join();
        wake.waitUntil(0);
    }
}

TEST(Wake, WhatDoesNotComeEndsTheWait) {
    Wake wake;
    EXPECT_FALSE(wake.await(steadyNow() + millisecond));
    wake.signal();
    EXPECT_FALSE(wake.await(steadyNow() - millisecond));  // too late: to be waited for as usual
    wake.waitUntil(steadyNow() + hour);
}

}  // namespace
}  // namespace cortex::comms
