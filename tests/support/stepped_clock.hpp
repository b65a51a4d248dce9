// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/trigger_source.hpp"

#include <chrono>
#include <cstdint>

namespace cortex::test {

// Ticks by hand, in a loop that takes them for real. `lateness`: of the ticks to come, ns; set
// between two steps.
struct SteppedClock final : cs::TriggerSource {
    cs::ManualTrigger trigger{std::chrono::milliseconds{1}};
    std::int64_t lateness = 0;

    void start() override { trigger.start(); }
    cs::Trigger waitForTick() override {
        cs::Trigger tick = trigger.waitForTick();
        tick.lateness = lateness;
        return tick;
    }
    void interrupt() override { trigger.interrupt(); }
    std::int64_t period() const override { return trigger.period(); }
    std::int64_t missed() override { return trigger.missed(); }
    void skipMissed(bool skip) override { trigger.skipMissed(skip); }
};

}  // namespace cortex::test
