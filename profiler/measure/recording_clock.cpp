// SPDX-License-Identifier: Apache-2.0
#include "recording_clock.hpp"

#include "cortex/core/clock.hpp"

#include <algorithm>
#include <thread>
#include <utility>

#include <time.h>

namespace cortex::profiler {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t longestSleep = second / 10;  // an interrupt is seen after at most this

void call(const std::function<void()>& function) {
    if (function) function();
}

}  // namespace

void RecordingClock::record(const RecordingPlan& plan) {
    plan_ = plan;
    recording_ = {};
    const auto blocks = static_cast<std::size_t>(plan.blocks);
    recording_.cycles.reserve(blocks * static_cast<std::size_t>(plan.loopPeriods + plan.settling));
    recording_.sleeps.reserve(blocks * static_cast<std::size_t>(plan.sleeperPeriods));
    recording_.works.reserve(blocks * static_cast<std::size_t>(plan.workingPeriods));
    if (plan.workingPeriods > 0)
        work_ = std::make_unique<RegisterWork>(plan.workThreads, plan.workPriority);
    abandoned_ = false;
    done_ = false;
    asked_ = true;
    asked_.notify_all();
}

bool RecordingClock::waitUntilDone(std::chrono::milliseconds limit) const {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!done_.load(std::memory_order_acquire)) {
        if (std::chrono::steady_clock::now() >= end) return false;
        std::this_thread::sleep_for(1ms);
    }
    return true;
}

// Sleeps to the next deadline and returns how late this thread woke up, in ns. A deadline that has
// passed costs no sleep.
std::int64_t RecordingClock::sleep() {
    const std::int64_t until = deadline();
    std::int64_t time = monotonicNow();
    while (time < until && !interrupted_.load(std::memory_order_relaxed)) {
        const std::int64_t end = std::min(until, time + longestSleep);
        const timespec target{static_cast<time_t>(end / second), static_cast<long>(end % second)};
        clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &target, nullptr);
        time = monotonicNow();
    }
    wokenAt_ = time;
    ++next_;
    return time - until;
}

// Waits for the next plan, or to be interrupted. Deadlines that pass meanwhile are not counted.
void RecordingClock::rest() {
    while (!asked_.exchange(false) && !interrupted_) asked_.wait(false);
    if (!interrupted_) call(plan_.prepares);
    origin_ = monotonicNow() - (next_ - 1) * period_;
    skipped_ = 0;
    phaseEnds_ = next_ + plan_.runIn;
    block_ = 0;
    phase_ = Phase::RunningIn;
}

// Completes the record of the cycle that ended at `end`. Deadlines that passed meanwhile are
// skipped, as the product's own clock does.
void RecordingClock::finishCycle(std::int64_t end) {
    const std::int64_t late = end - deadline();
    skipped_ = late < 0 ? 0 : late / period_ + 1;
    next_ += skipped_;
    if (phase_ != Phase::Looping) return;
    Recording::Cycle& cycle = recording_.cycles.back();
    cycle.duration = end - cycle.at;
    cycle.missed = skipped_;
}

void RecordingClock::enterBlock() {
    phase_ = Phase::Looping;
    settled_ = block_ == 0 ? next_ : next_ + plan_.settling;
    phaseEnds_ = settled_ + plan_.loopPeriods;
}

void RecordingClock::endCounting() {
    if (std::exchange(counting_, false)) call(plan_.ends);
}

void RecordingClock::finish(bool complete) {
    endCounting();
    recording_.complete = complete;
    phase_ = Phase::Resting;
    done_.store(true, std::memory_order_release);
}

// Each block goes Looping, Sleeping, Working; a phase without periods is left out.
void RecordingClock::advance() {
    if (abandoned_.load(std::memory_order_relaxed)) {
        finish(false);
        return;
    }
    if (next_ < phaseEnds_) return;
    if (phase_ == Phase::RunningIn) {
        call(plan_.begins);
        counting_ = true;
        enterBlock();
        return;
    }
    if (phase_ == Phase::Looping) {
        if (block_ + 1 == plan_.blocks) endCounting();
        phase_ = Phase::Sleeping;
        phaseEnds_ = next_ + plan_.sleeperPeriods;
        if (plan_.sleeperPeriods > 0) return;
    }
    if (phase_ == Phase::Sleeping) {
        phase_ = Phase::Working;
        if (plan_.workingPeriods > 0) {
            rounds_ = roundsOf(meanDuration());
            skipPassed();
            phaseEnds_ = next_ + plan_.workingPeriods;
            return;
        }
    }
    if (++block_ < plan_.blocks)
        enterBlock();
    else
        finish(true);
}

// One period of the bare sleeper.
void RecordingClock::recordSleep() {
    const std::int64_t lateness = sleep();
    const std::int64_t late = std::max<std::int64_t>(lateness, 0) / period_;
    if (recording_.sleeps.size() < recording_.sleeps.capacity()) {
        recording_.sleeps.push_back({wokenAt_, lateness, late, block_});
    }
    next_ += late;
    skipped_ = 0;
    call(plan_.wakes);
}

std::int64_t RecordingClock::skipPassed() {
    const std::int64_t passed = missed();
    next_ += passed;
    return passed;
}

// One period of the bare work.
void RecordingClock::recordWork() {
    work_->prepare(deadline());
    const std::int64_t lateness = sleep();
    const std::int64_t begin = wokenAt_;
    work_->cycle(rounds_);
    const std::int64_t end = monotonicNow();
    const std::int64_t missed = skipPassed();
    if (recording_.works.size() < recording_.works.capacity())
        recording_.works.push_back({{begin, lateness, missed, block_}, end - begin, false});
}

std::int64_t RecordingClock::meanDuration() const {
    std::int64_t sum = 0;
    for (const Recording::Cycle& cycle : recording_.cycles) sum += cycle.duration;
    return sum / std::max<std::int64_t>(1, std::ssize(recording_.cycles));
}

// Returns when the loop is to run a cycle. Every other phase happens in here, between two cycles.
cs::Trigger RecordingClock::waitForTick() {
    const std::int64_t end = monotonicNow();
    if (phase_ != Phase::Resting) finishCycle(end);
    while (!interrupted_.load(std::memory_order_acquire)) {
        if (phase_ != Phase::Resting) advance();
        if (phase_ == Phase::Resting) {
            rest();
            continue;
        }
        if (phase_ == Phase::Sleeping) {
            recordSleep();
            continue;
        }
        if (phase_ == Phase::Working) {
            recordWork();
            continue;
        }
        const std::int64_t periods = 1 + std::exchange(skipped_, 0);
        const std::int64_t nominal = next_ * period_;
        const bool settling = next_ < settled_;
        const std::int64_t lateness = sleep();
        if (phase_ == Phase::Looping)
            recording_.cycles.push_back({{wokenAt_, lateness, 0, block_}, 0, settling});
        return {nominal, lateness, periods, false};
    }
    if (!done_) finish(false);
    return {next_ * period_, 0, 1, true};
}

void RecordingClock::interrupt() {
    interrupted_ = true;
    asked_ = true;
    asked_.notify_all();
}

std::int64_t RecordingClock::missed() {
    const std::int64_t late = monotonicNow() - deadline();
    return late < 0 ? 0 : late / period_ + 1;
}

}  // namespace cortex::profiler
