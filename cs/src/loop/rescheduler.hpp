// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"

#include "loop/plan.hpp"
#include "threads/scheduler.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

namespace cortex::cs {

// How long a cycle takes if tasks (by node) cost so much: each thread runs its chunks in order, as
// soon as their predecessors have run.
double expectedMicroseconds(const Schedule& schedule, std::span<const double> costMicroseconds);

// Makes a schedule for what tasks cost, in microseconds by node.
using ScheduleMaker = std::function<Schedule(std::span<const double> costs)>;

// Looks at what tasks cost, on a thread of its own, and offers a plan made for these costs where it
// is better by more than a fifth. The order of tasks, and so every result, stays as it is.
class Rescheduler {
public:
    struct Maker {
        ScheduleMaker schedule;
        std::function<std::unique_ptr<Plan>(Schedule)> plan;
    };
    // `first`: between the start and the first look; doubled after each, up to a minute. Made on a
    // thread without real-time priority: its own has what the maker's has.
    Rescheduler(AgentRuntime& agent, const Schedule& inUse, Maker maker,
                std::chrono::milliseconds first = std::chrono::seconds{1});
    ~Rescheduler();

    // Loop thread, between cycles. Where a better plan is offered `plan` is exchanged for it.
    bool exchange(Plan*& plan) CORTEX_REALTIME;

private:
    void run();
    void look();
    void offer();
    std::vector<double> measuredCosts();

    AgentRuntime& agent_;
    Schedule inUse_;
    Maker maker_;
    std::chrono::milliseconds pause_;
    std::vector<double> costs_;  // by simplex, microseconds; 0: not timed yet
    std::atomic<Plan*> offered_{nullptr}, returned_{nullptr};
    std::mutex mutex_;
    std::condition_variable wake_;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace cortex::cs
