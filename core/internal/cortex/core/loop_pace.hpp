// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

#include <atomic>

namespace cortex {

// How fast a loop really is, and whether that is too slow: written in the tick by the loop, read by
// those who tell others.
class LoopPace {
public:
    void set(double rate, bool overloaded) CORTEX_REALTIME {
        rate_.store(rate, std::memory_order_relaxed);
        overloaded_.store(overloaded, std::memory_order_relaxed);
    }
    double rate() const { return rate_.load(std::memory_order_relaxed); }  // Hz; 0: not known yet
    bool overloaded() const { return overloaded_.load(std::memory_order_relaxed); }

private:
    std::atomic<double> rate_{0};
    std::atomic<bool> overloaded_{false};
};

}  // namespace cortex
