// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

namespace cortex::toolkit {

// Reads a terminal's keys on a thread of its own; the loop only reads atomics. A key works for as
// long as the terminal repeats it:
//   w s  x   a d  y   q e  z   u o  roll   i k  pitch   j l  yaw   blank  press or release
class KeyboardHand {
public:
    static constexpr std::size_t axisCount = 6;  // x y z roll pitch yaw

    KeyboardHand();  // throws Error if the standard input is no terminal
    ~KeyboardHand();
    KeyboardHand(const KeyboardHand&) = delete;
    KeyboardHand& operator=(const KeyboardHand&) = delete;

    // -1, 0 or 1 for each axis; `cycleTime`: nominal time, ns, of the loop.
    std::array<double, axisCount> motion(std::int64_t cycleTime) CORTEX_REALTIME;
    bool pressed() const CORTEX_REALTIME { return pressed_.load(std::memory_order_relaxed); }

private:
    void run();
    void take(char key);

    struct Axis {
        std::atomic<std::int64_t> strokes{0};  // how many keys came
        std::atomic<int> direction{0};
        std::int64_t seen = 0, until = 0;  // used by the loop only
    };
    std::array<Axis, axisCount> axes_;
    std::atomic<bool> pressed_{false};
    std::atomic<bool> ending_{false};
    std::thread thread_;
};

}  // namespace cortex::toolkit
