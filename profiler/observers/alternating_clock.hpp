// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/trigger_source.hpp"

#include "baselines/bare_sleeper.hpp"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace cortex::observers {

// Lateness of single wake-ups, ns, second by second.
struct Lateness {
    std::vector<std::vector<std::int64_t>> seconds;

    std::vector<double> p99s() const;  // us, second by second
    double medianOfP99() const;        // us
    std::string tail() const;          // p99.9, p99.99 and maximum of all
    // How much of every two seconds the first differ from the others, 1 or more.
    double nullRatio() const;
    Lateness every(std::size_t second) const;  // of two: 0 or 1
};

// A clock of 1 kHz that lets the loop run for a second and then only sleeps for a second, in turn:
// the loop's lateness beside that of a bare sleeper, on the same thread. Loop thread; take() any.
class AlternatingClock final : public cs::TriggerSource {
public:
    void start() override;
    cs::Trigger waitForTick() override;
    void interrupt() override { interrupted_ = true; }
    std::int64_t period() const override { return Period; }

    // What was measured since the last call, whole seconds only.
    struct Measured {
        Lateness loop, sleeper;
        std::int64_t missed = 0, missedBySleeper = 0;  // ticks
    };
    Measured take();

private:
    static constexpr std::int64_t Period = 1'000'000;
    void finishSecond();

    std::optional<profiler::BareSleeper> sleeper_;
    std::int64_t loopMissed_ = 0, sleeperMissed_ = 0;  // in this second
    bool sleeping_ = false;
    std::vector<std::int64_t> second_;
    std::atomic<bool> interrupted_{false};
    std::mutex mutex_;
    Measured measured_;
};

}  // namespace cortex::observers
