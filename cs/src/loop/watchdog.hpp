// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"

#include "tasks/task_runner.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace cortex::cs {

// Which hook does not return: found from the threads' positions.
struct HungHook {
    std::string path, hook;
    std::string text() const { return path + " does not return from " + hook; }
};
HungHook findHungHook(const TaskRunner& runner, AgentRuntime& agent);

// Sees a cycle that does not end, on a thread of its own, and says so once for each.
class Watchdog {
public:
    using Report = std::function<void(const Tick&, const HungHook&)>;

    Watchdog(const TaskRunner& runner, AgentRuntime& agent, std::chrono::nanoseconds limit,
             Report report);
    ~Watchdog();

    // Loop thread.
    void cycleBegins(const Tick& tick) CORTEX_REALTIME {
        nominalTime_.store(tick.nominalTime, std::memory_order_relaxed);
        executing_.store(tick.cycle, std::memory_order_release);
        begun_.store(tick.cycle, std::memory_order_release);
    }
    void cycleEnds() CORTEX_REALTIME { executing_.store(0, std::memory_order_release); }
    // The cycle now executing, 0 between cycles. Any thread.
    std::int64_t executing() const { return executing_.load(std::memory_order_acquire); }
    std::int64_t begun() const { return begun_.load(std::memory_order_acquire); }  // the last
    std::int64_t reported() const { return reported_.load(std::memory_order_acquire); }

private:
    void run();

    const TaskRunner& runner_;
    AgentRuntime& agent_;
    std::chrono::nanoseconds limit_;
    Report report_;
    std::atomic<std::int64_t> executing_{0}, begun_{0}, nominalTime_{0};
    std::atomic<std::int64_t> reported_{0};  // last cycle that hung
    std::mutex mutex_;
    std::condition_variable wake_;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace cortex::cs
