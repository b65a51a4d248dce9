// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/trigger_source.hpp"

#include <atomic>
#include <cstdint>
#include <functional>

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

}  // namespace cortex::network
