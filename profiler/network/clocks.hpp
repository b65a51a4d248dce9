// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/trigger_source.hpp"

#include <atomic>
#include <cstdint>
#include <functional>

#include <sched.h>

namespace cortex::network {

// A clock of 1 kHz that starts cycles for a second and then calls `instead` for a second, in turn,
// at the same deadlines and on the same thread.
class TakingTurns final : public cs::TriggerSource {
public:
    explicit TakingTurns(std::function<void()> instead) : instead_{std::move(instead)} {}

    void start() override;
    cs::Trigger waitForTick() override;
    void interrupt() override { interrupted_ = true; }
    std::int64_t period() const override { return Period; }

private:
    static constexpr std::int64_t Period = 1'000'000, perSecond = 1000;

    const std::function<void()> instead_;
    std::int64_t origin_ = 0, next_ = 0;
    std::atomic<bool> interrupted_{false};
};

// Puts this thread, and those that it makes from then on, on the n-th CPU that it may use, as long
// as there are more than n, until the end of this object. Other than cs::OnCpu it does not look up
// which CPUs the process may use: the loop of a cluster that is made later stays there, too.
class OnCpu {
public:
    explicit OnCpu(int number);
    ~OnCpu();
    OnCpu(const OnCpu&) = delete;
    OnCpu& operator=(const OnCpu&) = delete;

private:
    cpu_set_t before_{};
};

}  // namespace cortex::network
