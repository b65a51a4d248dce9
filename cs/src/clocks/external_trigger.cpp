// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"
#include "cortex/cs/trigger_source.hpp"

namespace cortex::cs {

ExternalTrigger::ExternalTrigger(std::chrono::nanoseconds nominalPeriod)
    : period_{nominalPeriod.count()} {
    if (period_ <= 0) throw Error("the nominal period of an ExternalTrigger must be positive");
}

void ExternalTrigger::notify() {
    notified_.fetch_add(1, std::memory_order_release);
    notified_.notify_one();
}

void ExternalTrigger::start() {}

Trigger ExternalTrigger::waitForTick() {
    std::uint32_t notified = notified_.load(std::memory_order_acquire);
    while (notified == static_cast<std::uint32_t>(seen_) &&
           !interrupted_.load(std::memory_order_acquire)) {
        notified_.wait(notified, std::memory_order_acquire);
        notified = notified_.load(std::memory_order_acquire);
    }
    Trigger trigger;
    trigger.timedOut = timedOut_.exchange(false, std::memory_order_acq_rel);
    trigger.stopped = interrupted_.load(std::memory_order_acquire);
    if (skip_) trigger.periods = notified - static_cast<std::uint32_t>(seen_);
    seen_ += trigger.periods;
    trigger.nominalTime = (seen_ - 1) * period_;
    return trigger;
}

void ExternalTrigger::interrupt() {
    interrupted_.store(true, std::memory_order_release);
    notify();
}

// The cycle that follows counts as a tick of its own.
bool ExternalTrigger::timeOut() {
    timedOut_.store(true, std::memory_order_release);
    notify();
    return true;
}

std::int64_t ExternalTrigger::missed() {
    return notified_.load(std::memory_order_acquire) - static_cast<std::uint32_t>(seen_);
}

}  // namespace cortex::cs
