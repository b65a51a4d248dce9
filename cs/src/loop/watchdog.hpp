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
    bool inTask = false;  // false: outside of all tasks, and `hook` says where that may be
    std::string text() const { return path + " does not return from " + hook; }
    std::string standstill() const;  // "hangs in /ctl.stateActive"
};
HungHook findHungHook(const TaskRunner& runner, AgentRuntime& agent);

// What a watchdog looks for. Without `triggerTimeout` nobody waits for the next tick.
struct WatchdogLimits {
    std::chrono::nanoseconds limit{};           // for a cycle to end, and for the next to begin
    std::chrono::nanoseconds triggerTimeout{};  // for the next to begin, before all is made safe
};

// Sees a cycle that does not end and a trigger that does not come, on a thread of its own, and says
// so once for each. Only the time in which this process runs counts.
class Watchdog {
public:
    enum class Finding : std::uint8_t { Hangs, NoTick, TimedOut, GoesOn };
    // `since`: when the cycle counter moved last, ns of the monotonic clock.
    using Report = std::function<void(Finding, const Tick&, std::int64_t since)>;

    Watchdog(WatchdogLimits limits, Report report);
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
    // The last cycle that hung, or after which no tick came.
    std::int64_t reported() const { return reported_.load(std::memory_order_acquire); }

private:
    void run();
    void look(std::int64_t runs, std::int64_t last, std::chrono::nanoseconds stood);
    void tell(Finding finding, std::int64_t cycle);

    WatchdogLimits limits_;
    Report report_;
    std::atomic<std::int64_t> executing_{0}, begun_{0}, nominalTime_{0};
    std::atomic<std::int64_t> reported_{-1};
    std::int64_t since_ = 0;
    bool told_ = false, timedOut_ = false;  // of this standstill; the watchdog's thread only
    std::mutex mutex_;
    std::condition_variable wake_;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace cortex::cs
