// SPDX-License-Identifier: Apache-2.0
#include "loop/watchdog.hpp"

namespace cortex::cs {

HungHook findHungHook(const TaskRunner& runner, AgentRuntime& agent) {
    for (std::uint32_t worker = 0; worker < agent.threadCount(); ++worker) {
        const Position& position = runner.position(worker);
        const std::uint32_t simplex = position.simplex.load(std::memory_order_relaxed);
        const Hook hook = position.hook.load(std::memory_order_relaxed);
        if (simplex == noSimplex || hook == Hook::None) continue;
        return {agent.structure().simplexes[simplex].path, name(hook)};
    }
    return {"/" + agent.name(), "the framework, an interface, a heartbeat or the trigger"};
}

Watchdog::Watchdog(const TaskRunner& runner, AgentRuntime& agent, std::chrono::nanoseconds limit,
                   Report report)
    : runner_{runner}, agent_{agent}, limit_{limit}, report_{std::move(report)}, thread_{[this] {
          run();
      }} {}

Watchdog::~Watchdog() {
    {
        const std::lock_guard lock{mutex_};
        stopping_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

void Watchdog::run() {
    std::int64_t seen = 0;
    auto since = std::chrono::steady_clock::now();
    std::unique_lock lock{mutex_};
    while (!wake_.wait_for(lock, limit_ / 4, [this] { return stopping_; })) {
        const std::int64_t cycle = executing();
        if (cycle != seen) {
            seen = cycle;
            since = std::chrono::steady_clock::now();
        } else if (cycle != 0 && reported() != cycle &&
                   std::chrono::steady_clock::now() - since >= limit_) {
            reported_.store(cycle, std::memory_order_release);
            report_({cycle, nominalTime_.load(std::memory_order_relaxed)},
                    findHungHook(runner_, agent_));
        }
    }
}

}  // namespace cortex::cs
