// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/clock.hpp"
#include "cortex/core/error.hpp"
#include "cortex/cs/trigger_source.hpp"

#include "threads/pause_briefly.hpp"
#include "threads/realtime_thread.hpp"

#include <algorithm>
#include <cerrno>
#include <ctime>

namespace cortex::cs {

namespace {

// An interrupt is seen after at most this, however long the period.
constexpr std::int64_t longestSleep = nsPerSecond / 10;

void sleepUntil(std::int64_t deadline) {
    const timespec time{static_cast<time_t>(deadline / nsPerSecond),
                        static_cast<long>(deadline % nsPerSecond)};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR) {
    }
}

}  // namespace

InternalClock::InternalClock(std::chrono::nanoseconds period, std::chrono::nanoseconds spin)
    : period_{period.count()}, spin_{spin.count()} {
    if (period_ <= 0) throw Error("the period of an InternalClock must be positive");
    if (spin_ < 0) throw Error("an InternalClock cannot spin for a negative time");
}

void InternalClock::start() {
    origin_ = monotonicNow();
    next_ = 0;
}

Trigger InternalClock::waitForTick() {
    Trigger trigger;
    if (skip_) {
        const std::int64_t late = missed();
        next_ += late;
        trigger.periods += late;
    }
    const std::int64_t deadline = origin_ + next_ * period_;
    std::int64_t now = monotonicNow();
    while (now < deadline && !interrupted_.load(std::memory_order_relaxed)) {
        if (now < deadline - spin_)
            sleepUntil(std::min(deadline - spin_, now + longestSleep));
        else
            pauseBriefly();
        now = monotonicNow();
    }
    trigger.stopped = interrupted_.load(std::memory_order_acquire);
    trigger.nominalTime = next_ * period_;
    trigger.lateness = now - deadline;
    ++next_;
    return trigger;
}

std::vector<std::string> InternalClock::report() const {
    if (spin_ == 0) return {};
    return spinReport(placeOfThisThread(), std::min(spin_, period_), period_);
}

void InternalClock::interrupt() { interrupted_.store(true, std::memory_order_release); }

std::int64_t InternalClock::missed() {
    const std::int64_t late = monotonicNow() - (origin_ + next_ * period_);
    // The first deadline is not missed: the loop cannot have run before it.
    return late < 0 || next_ == 0 ? 0 : late / period_ + 1;
}

}  // namespace cortex::cs
