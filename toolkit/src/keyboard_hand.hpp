// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

namespace cortex::toolkit {

// The operator's hand, moved by the keys of a terminal. A thread of its own reads the keys, and the
// loop only reads atomics. A key moves its axis for as long as the terminal repeats it. In each
// pair the first key moves forward and the second one back:
//   w s  x   a d  y   q e  z   u o  roll   i k  pitch   j l  yaw
// The blank presses the button, and releases it the next time.
class KeyboardHand {
public:
    static constexpr std::size_t axisCount = 6;  // x y z roll pitch yaw

    KeyboardHand();  // throws Error if the standard input is no terminal
    ~KeyboardHand();
    KeyboardHand(const KeyboardHand&) = delete;
    KeyboardHand& operator=(const KeyboardHand&) = delete;

    // -1, 0 or 1 for each axis; `cycleTime`: nominal time, ns, of the loop.
    std::array<double, axisCount> motion(std::int64_t cycleTime) CORTEX_REALTIME;
    // Whether the button is pressed.
    bool pressed() const CORTEX_REALTIME { return pressed_.load(std::memory_order_relaxed); }

private:
    void run();
    void take(char key);

    struct Axis {
        std::atomic<std::int64_t> strokes{0};  // how many keys came
        std::atomic<int> direction{0};
        // Used by the loop only: the strokes that it has seen, and when the last one ends, in ns.
        std::int64_t seen = 0, until = 0;
    };
    std::array<Axis, axisCount> axes_;
    std::atomic<bool> pressed_{false};
    std::atomic<bool> ending_{false};
    std::thread thread_;
};

}  // namespace cortex::toolkit
