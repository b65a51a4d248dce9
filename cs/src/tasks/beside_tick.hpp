// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event.hpp"
#include "cortex/core/event_count.hpp"
#include "cortex/cs/io_exchange.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

namespace cortex::cs {

// The thread of a simplex beside the tick. begin() to waitForEnd() on the program's thread; death()
// and goOn() in ticks.
//
// **Invariants**
// 1. `deaths_` counts how often the function returned unasked or threw. Only the thread counts.
// 2. `resumed_` is the number of deaths after which the thread may go on. Only the tick writes it.
// 3. The thread runs the function only while both are equal. So it is dead, and waits, while they
//    differ.
// 4. `why_` is written by the thread before it counts a death, and read by the tick only while the
//    thread is dead: release and acquire of `deaths_` and `resumed_` order the two.
// 5. The tick never wakes the thread: a dead one looks 20 times a second.
// 6. `ending_` is set once and never cleared, and the descriptor is readable from then on.
// 7. `hasEnded_` is the last thing that the thread does, so that it can be joined without waiting.
struct ThreadedSimplex::Thread {
    explicit Thread(std::string name) : name_{std::move(name)} {}
    ~Thread();
    Thread(const Thread&) = delete;
    Thread& operator=(const Thread&) = delete;

    // `whileDead`: called 20 times a second, while it waits to go on.
    void begin(std::function<void()> function, std::function<void()> whileDead);
    void askToEnd();
    bool waitForEnd(std::int64_t until);  // ns of the monotonic clock

    const std::string& name() const { return name_; }
    bool isEnding() const { return ending_.load(std::memory_order_acquire); }
    int endDescriptor() const { return endDescriptor_; }
    bool waitFor(std::chrono::nanoseconds time) const;  // false: it is to end

    // Tick: why it died, until goOn(); null while it lives.
    const EventText* death() const CORTEX_REALTIME {
        return deaths_.load(std::memory_order_acquire) == resumed_.load(std::memory_order_acquire)
                   ? nullptr
                   : &why_;
    }
    void goOn() CORTEX_REALTIME {
        resumed_.store(deaths_.load(std::memory_order_relaxed), std::memory_order_release);
    }

private:
    void run();
    void die(std::string_view why);

    const std::string name_;
    std::function<void()> function_, whileDead_;
    std::thread thread_;
    int endDescriptor_ = -1;
    EventText why_;
    std::atomic<std::uint32_t> deaths_{0}, resumed_{0};
    std::atomic<bool> ending_{false}, hasEnded_{false};
    EventCount end_;
};

}  // namespace cortex::cs
