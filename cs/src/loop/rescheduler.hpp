// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"
#include "cortex/core/event_count.hpp"

#include "loop/plan.hpp"
#include "threads/scheduler.hpp"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <thread>
#include <vector>

namespace cortex::cs {

// How long a cycle takes if tasks (by node) cost so much: each thread runs its chunks in order, as
// soon as their predecessors have run.
double expectedMicroseconds(const Schedule& schedule, std::span<const double> costMicroseconds);

// Makes a schedule for what tasks cost, in microseconds by node.
using ScheduleMaker = std::function<Schedule(std::span<const double> costs)>;

// Looks at what tasks cost, and offers the loop a plan made for these costs where it is better by
// more than a fifth: once every task was timed, once more some time after the last startup, and
// whenever it is asked to. Its thread sleeps otherwise. The order of tasks, and so every result,
// stays as it is.
class Rescheduler {
public:
    struct Maker {
        ScheduleMaker schedule;
        std::function<std::unique_ptr<Plan>(Schedule)> plan;
    };
    // Made on a thread without real-time priority: its own has what the maker's has.
    Rescheduler(AgentRuntime& agent, const Schedule& inUse, Maker maker);
    ~Rescheduler();

    // Loop thread, between cycles. `startups` of simplexes since the start; `now`: nominal time;
    // `timedAll`: whether every task was timed.
    void follow(std::uint64_t startups, std::int64_t now, bool timedAll) CORTEX_REALTIME;
    void look() CORTEX_REALTIME;
    void lookAndTell() CORTEX_REALTIME;  // what came of it, or of the present look, is an event
    bool isLooking() const CORTEX_REALTIME { return stage() != Stage::Idle; }
    // Where a better plan is offered it takes the place of `plan`.
    bool exchange(std::unique_ptr<Plan>& plan) CORTEX_REALTIME;

    // While the loop rests: offers this plan. False: it is looking, or the order is another.
    bool offer(std::unique_ptr<Plan> plan);

    static constexpr std::int64_t settlingTime = 2'000'000'000;  // ns after the last startup

private:
    // Who has the word: the loop in Idle and Offered, the thread in Asked and Returned.
    enum class Stage : std::uint8_t { Idle, Asked, Offered, Returned };
    Stage stage() const { return stage_.load(std::memory_order_acquire); }
    void hand(Stage stage) CORTEX_REALTIME {
        stage_.store(stage, std::memory_order_release);
        signals_.advance();
    }

    void run();
    std::unique_ptr<Plan> betterPlan();
    std::unique_ptr<Plan> betterPlanIfPossible();
    std::vector<double> measuredCosts();
    void tellIfAsked();
    bool addSample(std::vector<std::vector<double>>& samples) const;

    AgentRuntime& agent_;
    const std::vector<std::uint32_t> tasks_;  // in the order of execution
    Maker maker_;
    std::atomic<Stage> stage_{Stage::Idle};
    std::unique_ptr<Plan> plan_;  // offered to the loop, or returned by it
    Schedule inUse_;
    std::atomic<bool> tells_{false};  // what came of the present look, when it ends
    struct Result {
        bool isBetter = false;
        std::uint32_t threads = 1;
    } last_;  // of the last look; its thread
    EventCount signals_;
    std::atomic<bool> stopping_{false};

    // Loop thread only.
    std::uint64_t startups_ = 0;
    std::int64_t due_ = 0;  // nominal time of the look after the last startup; 0: none
    bool hasLookedFirst_ = false, hasLooked_ = false;

    std::thread thread_;
};

}  // namespace cortex::cs
