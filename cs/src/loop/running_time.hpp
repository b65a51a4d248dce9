// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/clock.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace cortex::cs {

// How long this process ran. Of the time between two looks at most `most` counts: what is longer
// was spent stopped, by a debugger, a signal, or with the whole machine.
class RunningTime {
public:
    explicit RunningTime(std::chrono::nanoseconds most) : most_{most.count()} {}

    void restart() {
        passed_ = 0;
        last_ = monotonicNow();
    }
    std::chrono::nanoseconds look() { return lookAt(monotonicNow()); }
    std::chrono::nanoseconds lookAt(std::int64_t now) {
        passed_ += std::min(now - last_, most_);
        last_ = now;
        return std::chrono::nanoseconds{passed_};
    }

private:
    std::int64_t most_;
    std::int64_t passed_ = 0, last_ = monotonicNow();
};

}  // namespace cortex::cs
