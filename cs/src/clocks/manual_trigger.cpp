// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"
#include "cortex/cs/trigger_source.hpp"

namespace cortex::cs {

ManualTrigger::ManualTrigger(std::chrono::nanoseconds period) : period_{period.count()} {
    if (period_ <= 0) throw Error("the period of a ManualTrigger must be positive");
}

void ManualTrigger::step(std::int64_t cycles) {
    std::unique_lock lock{mutex_};
    requested_ += cycles;
    const std::int64_t last = requested_;
    wake_.notify_all();
    wake_.wait(lock,
               [&] { return (finished_ >= last && late_ == 0 && !running_) || interrupted_; });
}

void ManualTrigger::start() {}

Trigger ManualTrigger::waitForTick() {
    std::unique_lock lock{mutex_};
    finished_ = started_;
    running_ = false;
    wake_.notify_all();
    Trigger trigger;
    if (skip_ && late_ > 0) {
        trigger.periods += late_;
        tick_ += late_;
        late_ = 0;
        wake_.notify_all();
    }
    const bool atOnce = late_ > 0;
    if (!atOnce) wake_.wait(lock, [&] { return requested_ > started_ || interrupted_; });
    if (interrupted_) {
        trigger.stopped = true;
        return trigger;
    }
    ++tick_;
    if (atOnce)
        --late_;
    else
        ++started_;
    running_ = true;
    trigger.nominalTime = tick_ * period_;
    return trigger;
}

void ManualTrigger::interrupt() {
    const std::lock_guard lock{mutex_};
    interrupted_ = true;
    wake_.notify_all();
}

std::int64_t ManualTrigger::missed() {
    const std::lock_guard lock{mutex_};
    late_ += requestedLate_;
    requestedLate_ = 0;
    return late_;
}

}  // namespace cortex::cs
