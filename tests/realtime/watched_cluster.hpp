// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/cluster_cs.hpp"
#include "cortex/cs/hook_checker.hpp"
#include "cortex/cs/testing.hpp"

#include "support/waiting.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>

namespace cortex::test {

inline cs::HookChecker& checker() { return cs::HookChecker::ofProcess(); }

// What ticks and hooks did that they must not, one line each; "": nothing. The first cycles may
// meet pages: whoever looks at those as well compares counts.
inline std::string violations() {
    std::string text;
    for (const cs::HookViolation& each : checker().violations()) {
        if (each.what != "page fault") text += each.text() + "\n";
    }
    return text;
}

// The internal clock; a tick lasts from the return of waitForTick to its next call.
class WatchedClock final : public cs::TriggerSource {
public:
    void start() override { clock_.start(); }
    cs::Trigger waitForTick() override {
        checker().leaveTick();
        const cs::Trigger trigger = clock_.waitForTick();
        if (!trigger.stopped) checker().enterTick();
        return trigger;
    }
    void interrupt() override { clock_.interrupt(); }
    std::int64_t period() const override { return clock_.period(); }
    std::int64_t missed() override { return clock_.missed(); }
    std::int64_t nextDeadline() const override { return clock_.nextDeadline(); }
    void skipMissed(bool skip) override { clock_.skipMissed(skip); }

private:
    cs::InternalClock clock_{std::chrono::milliseconds{1}};
};

inline cs::ClusterOptions optionsOf(std::uint32_t threads, int priority) {
    cs::ClusterOptions options;
    options.threads = threads;
    options.priority = priority;
    return options;
}

// Before start().
inline void watch(cs::ClusterCS& cluster, std::uint32_t threads) {
    cs::TestOptions options;
    options.forceThreads = threads > 1;
    options.onThreadStart = [](std::uint32_t thread) {
        if (thread > 0) checker().enterTick();  // a worker between cycles only waits
    };
    cs::ClusterTesting::set(cluster, std::move(options));
    checker().watch(cluster);
}

// Of all threads together in so many cycles, where nothing keeps a thread off its CPU: each worker
// waits for the cycle and twice for others, and is woken as often; the loop waits for the end.
inline std::uint64_t mostFutexCalls(std::int64_t cycles, std::uint32_t threads) {
    constexpr std::uint64_t mostOfThread = 6;
    return threads == 1 ? 0 : static_cast<std::uint64_t>(cycles) * threads * mostOfThread;
}

// Waits until the cluster has run so many cycles more.
inline void runCycles(cs::ClusterCS& cluster, std::int64_t cycles) {
    const auto cycle = [&] { return cluster.image().cycle(); };
    const std::int64_t last = cycle() + cycles;
    waitUntil(
        "cycle " + std::to_string(last), [&] { return cycle() >= last; },
        [&] { return std::to_string(cycle()); });
}

}  // namespace cortex::test
