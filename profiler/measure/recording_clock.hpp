// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/trigger_source.hpp"

#include "baselines/register_work.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace cortex::profiler {

// What a RecordingClock does: in each block the loop runs for `loopPeriods`, then its thread only
// sleeps to `sleeperPeriods` deadlines, then at `workingPeriods` it and as many others as the loop
// has do RegisterWork for as long as a cycle of the loop took so far. Before the first block the
// loop runs in; the first cycles of each later block, when caches are cold from the pause, are
// marked as settling. All functions are called on the loop's thread, between two cycles.
struct RecordingPlan {
    int blocks = 1;
    std::int64_t loopPeriods = 1000, sleeperPeriods = 0, workingPeriods = 0, runIn = 20,
                 settling = 0;
    std::uint32_t workThreads = 1;
    int workPriority = 0;
    std::function<void()> prepares{};  // before all
    std::function<void()> begins{};    // before the first cycle that is recorded
    std::function<void()> ends{};      // after the last one
    std::function<void()> wakes{};     // after each wake-up of the sleeper
};

// All times in ns on the monotonic clock.
struct Recording {
    struct Wake {
        std::int64_t at = 0, lateness = 0;
        std::int64_t missed = 0;  // deadlines that passed from this one to the next wake-up
        int block = 0;
    };
    struct Cycle : Wake {
        std::int64_t duration = 0;  // from the return of waitForTick to its next call
        bool settling = false;
    };
    std::vector<Cycle> cycles;
    std::vector<Wake> sleeps;
    std::vector<Cycle> works;
    bool complete = false;
};

// Absolute deadlines, like cs::InternalClock, that records each cycle without allocating, in turn
// with a bare sleeper and bare work on the same thread. Between plans the loop rests.
class RecordingClock final : public cs::TriggerSource {
public:
    explicit RecordingClock(std::chrono::nanoseconds period) : period_{period.count()} {}

    void record(const RecordingPlan& plan);  // program's thread
    bool waitUntilDone(std::chrono::milliseconds limit) const;
    void abandon() { abandoned_ = true; }  // ends the plan early; waitUntilDone() tells when
    const Recording& recording() const { return recording_; }  // when it is done

    void start() override {}
    cs::Trigger waitForTick() override;
    void interrupt() override;
    std::int64_t period() const override { return period_; }
    std::int64_t missed() override;
    std::int64_t nextDeadline() const override { return deadline(); }

private:
    enum class Phase { Resting, RunningIn, Looping, Sleeping, Working };
    std::int64_t deadline() const { return origin_ + next_ * period_; }
    std::int64_t sleep();  // to the next deadline; its lateness
    void rest();
    void finishCycle(std::int64_t end);
    void advance();  // to the phase of the next deadline
    void enterBlock();
    void finish(bool complete);
    void endCounting();
    void recordSleep();
    void recordWork();
    std::int64_t skipPassed();  // deadlines; how many
    std::int64_t meanDuration() const;

    const std::int64_t period_;
    std::int64_t origin_ = 0;                   // ns; deadline n is origin_ + n * period_
    std::int64_t next_ = 0;                     // number of the next deadline
    std::int64_t phaseEnds_ = 0, settled_ = 0;  // numbers of deadlines
    std::int64_t wokenAt_ = 0;                  // ns
    std::int64_t skipped_ = 0;                  // deadlines that passed since the last cycle
    std::unique_ptr<RegisterWork> work_;
    std::int64_t rounds_ = 0;  // of work
    int block_ = 0;
    bool counting_ = false;  // from begins() to ends()
    Phase phase_ = Phase::Resting;
    RecordingPlan plan_;
    Recording recording_;
    std::atomic<bool> asked_{false}, done_{true}, abandoned_{false}, interrupted_{false};
};

}  // namespace cortex::profiler
