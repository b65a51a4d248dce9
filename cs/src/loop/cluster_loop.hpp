// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"
#include "cortex/cs/cluster_cs.hpp"
#include "cortex/cs/testing.hpp"

#include "loop/group_commands.hpp"
#include "loop/lateness_judge.hpp"
#include "loop/metrics.hpp"
#include "loop/pace_judge.hpp"
#include "loop/rescheduler.hpp"
#include "loop/watchdog.hpp"
#include "tasks/task_runner.hpp"
#include "threads/cpu_claims.hpp"
#include "threads/realtime_thread.hpp"
#include "threads/thread_pool.hpp"

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace cortex::cs {

// The loop of a cluster: waitForTick, beginCycle, tasks, endCycle, heartbeat, on a thread of its
// own; its overflow policy, watchdog and orderly end. start() and stop() on the program's thread.
class ClusterLoop {
public:
    ClusterLoop(AgentRuntime& agent, TriggerSource& trigger, const ClusterOptions& options,
                Schedule schedule, StartOrder startOrder,
                std::vector<std::function<void(const Heartbeat&)>> heartbeats,
                std::vector<std::string> realtimeReport);
    ~ClusterLoop();

    void start();
    bool joinable() const { return thread_.joinable(); }
    bool running() const {  // not stopped, nor ended by its trigger
        return joinable() && !finished_.load(std::memory_order_acquire);
    }
    // Shuts down and joins; the hook that prevents it if there is one.
    std::optional<HungHook> stop();

    // Who did not get through the shutdown, and why; demands that are not safe yet. After stop().
    std::vector<std::string> notFollowed() const;
    Ended ended() const { return ended_.load(std::memory_order_acquire); }
    const std::vector<std::string>& realtimeReport() const { return realtimeReport_; }
    std::uint32_t threads() const { return threads_.load(std::memory_order_relaxed); }
    void testWith(TestOptions options) { test_ = std::move(options); }  // before start()
    // Before start(): makes schedules for what is measured; with threads to share the work only.
    void rescheduleBy(ScheduleMaker makeSchedule) { makeSchedule_ = std::move(makeSchedule); }
    bool offerPlan(Schedule schedule);  // see ClusterTesting

private:
    void run();
    void prepareThread();
    void claimCpus();
    void threadStarts(std::uint32_t worker);
    void addThreads(Plan& plan);
    void startRescheduler();
    std::unique_ptr<Plan> makePlan(Schedule schedule);
    Outcome reschedule(Call& call) CORTEX_REALTIME;
    void adoptPlan() CORTEX_REALTIME;
    void loop();
    void beat(const Heartbeat& heartbeat);
    void reportFailure(const char* source, const char* what);
    void cycle(const Trigger& trigger) CORTEX_REALTIME;
    void checkOverflow() CORTEX_REALTIME;
    void countMissed(std::int64_t missed) CORTEX_REALTIME;
    void reportMissed() CORTEX_REALTIME;
    void nameLongest(EventText& text) CORTEX_REALTIME;
    void warnDuty() CORTEX_REALTIME;
    void judgePace(const Tick& tick, std::int64_t begin) CORTEX_REALTIME;
    void judgeLateness(const Tick& tick) CORTEX_REALTIME;
    void halt(const char* why) CORTEX_REALTIME;
    void tell(Severity severity, const EventText& text) CORTEX_REALTIME;
    void shutDown();
    void tellUnsafe();
    void tell(Watchdog::Finding finding, const Tick& tick, std::int64_t since);
    void standsStill(const Tick& tick, const HungHook& where, std::string_view text);
    void post(const Tick& tick, std::uint32_t simplex, std::string_view text);

    AgentRuntime& agent_;
    TriggerSource& trigger_;
    ClusterOptions options_;
    TestOptions test_;
    std::vector<std::function<void(const Heartbeat&)>> heartbeats_;
    std::vector<std::string> realtimeReport_;
    std::optional<AwakeCpus> awakeCpus_;
    CpuClaims claims_;
    bool pin_ = true;
    std::unique_ptr<Plan> plan_;
    TaskRunner runner_;
    GroupCommands group_;
    ClusterMetrics metrics_;
    PaceJudge pace_;
    LatenessJudge late_, tooLate_;
    ScheduleMaker makeSchedule_;
    std::unique_ptr<Rescheduler> rescheduler_;  // null: one thread
    bool mayReschedule_ = false;
    std::unique_ptr<Watchdog> watchdog_;
    std::atomic<std::uint32_t> threads_{1};
    std::atomic<std::thread::native_handle_type> loopThread_{};
    std::thread thread_;
    std::atomic<std::int64_t> timedOutAfter_{-1};  // the cycle after which no tick came
    std::atomic<bool> ready_{false}, finished_{false};
    std::exception_ptr failure_;  // of the start, for start() to throw
    std::atomic<Ended> ended_{Ended::NotStarted};

    // Loop thread only.
    std::vector<std::string> unsafe_;  // after stop(): demands that did not become safe
    Trigger last_;
    std::int64_t cycle_ = 0;
    std::int64_t lastNominal_ = 0;
    std::int64_t lastWakeUp_ = 0;
    std::int64_t counted_ = 0;     // missed ticks counted but not yet passed over or caught up
    std::int64_t caughtUp_ = 0;    // in a row
    std::int64_t unreported_ = 0;  // missed ticks that no event tells yet
};

}  // namespace cortex::cs
