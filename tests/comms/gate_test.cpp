// SPDX-License-Identifier: Apache-2.0
#include "dds/gate.hpp"

#include <atomic>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

TEST(Gate, LetsThroughOneAtATimeOnceItIsOpen) {
    Gate gate;
    gate.open();
    std::unique_lock first = gate.pass();
    ASSERT_TRUE(first.owns_lock());
    std::atomic<bool> passed{false};
    std::thread next{[&] { passed = gate.pass().owns_lock(); }};
    for (int i = 0; i < 1'000; ++i) std::this_thread::yield();
    EXPECT_FALSE(passed);

    first.unlock();
    next.join();
    EXPECT_TRUE(passed);
}

TEST(Gate, LetsNothingThroughWhileItIsHeld) {
    Gate gate;
    gate.open();
    std::atomic<bool> passed{false};
    std::unique_lock held = gate.hold();
    std::thread next{[&] { passed = gate.pass().owns_lock(); }};
    for (int i = 0; i < 1'000; ++i) std::this_thread::yield();
    EXPECT_FALSE(passed);

    held.unlock();
    next.join();
    EXPECT_TRUE(passed);
}

TEST(Gate, LetsNothingThroughOnceItIsClosed) {
    Gate gate;
    gate.open();
    gate.close();
    EXPECT_FALSE(gate.pass().owns_lock());
}

}  // namespace
}  // namespace cortex::comms
