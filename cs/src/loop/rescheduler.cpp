// SPDX-License-Identifier: Apache-2.0
#include "loop/rescheduler.hpp"

#include <algorithm>
#include <utility>

namespace cortex::cs {

namespace {

constexpr std::chrono::milliseconds longestPause{60'000};
constexpr std::chrono::milliseconds exchangePause{100};  // until the loop has taken an offer
constexpr double worthwhile = 0.8;  // of the time that the plan in use is expected to take

// Timing a task takes two readings of the clock, of which one falls into the time.
double timingCost() {
    using Clock = std::chrono::steady_clock;
    constexpr int readings = 200;
    const auto begin = Clock::now();
    for (int i = 0; i < readings; ++i) Clock::now();
    return std::chrono::duration<double, std::micro>(Clock::now() - begin).count() / readings;
}

}  // namespace

double expectedMicroseconds(const Schedule& schedule, std::span<const double> costMicroseconds) {
    const std::uint32_t count = std::max(1U, schedule.threads);
    std::vector<double> threads(count), finished;
    finished.reserve(schedule.chunks.size());
    for (const Chunk& chunk : schedule.chunks) {
        double& thread = threads[homeOf(chunk, count)];
        for (std::uint32_t i = 0; i < chunk.predecessorCount; ++i) {
            thread = std::max(thread, finished[schedule.predecessors[chunk.firstPredecessor + i]]);
        }
        for (std::uint32_t i = chunk.first; i < chunk.first + chunk.count; ++i) {
            const double cost = costMicroseconds[schedule.tasks[i]];
            thread += cost > 0 ? cost : AssumedTaskMicroseconds;
        }
        finished.push_back(thread);
    }
    const double wake = count > 1 ? WakeMicroseconds : 0;
    return *std::max_element(threads.begin(), threads.end()) + wake;
}

Rescheduler::Rescheduler(AgentRuntime& agent, const Schedule& inUse, Maker maker,
                         std::chrono::milliseconds first)
    : agent_{agent},
      inUse_{inUse},
      maker_{std::move(maker)},
      pause_{first},
      costs_(agent.structure().simplexes.size()),
      thread_{[this] { run(); }} {}

Rescheduler::~Rescheduler() {
    {
        const std::lock_guard lock{mutex_};
        stopping_ = true;
    }
    wake_.notify_all();
    thread_.join();
    delete offered_.load();
    delete returned_.load();
}

bool Rescheduler::exchange(Plan*& plan) {
    if (offered_.load(std::memory_order_relaxed) == nullptr) return false;
    returned_.store(std::exchange(plan, offered_.exchange(nullptr, std::memory_order_acq_rel)),
                    std::memory_order_release);
    return true;
}

void Rescheduler::run() {
    bool offered = false;
    std::unique_lock lock{mutex_};
    while (!wake_.wait_for(lock, offered ? exchangePause : pause_, [this] { return stopping_; })) {
        if (offered) {
            const std::unique_ptr<Plan> old{returned_.exchange(nullptr, std::memory_order_acq_rel)};
            offered = old == nullptr;
            continue;
        }
        look();
        offered = offered_.load(std::memory_order_relaxed) != nullptr;
        pause_ = std::min(2 * pause_, longestPause);
    }
}

// Where the system has no thread or memory left for another plan, the one in use stays.
void Rescheduler::look() {
    try {
        offer();
    } catch (const std::exception& error) {
        EventText text{"no other plan for the loop: "};
        Event event;
        event.severity = Severity::Warning;
        event.simplex = agent_.agentSimplex();
        event.text = text << error.what();
        agent_.events().postOutside(event);
    }
}

void Rescheduler::offer() {
    const std::vector<double> costs = measuredCosts();
    if (costs.empty()) return;
    Schedule schedule = maker_.schedule(costs);
    const bool better =
        expectedMicroseconds(schedule, costs) < worthwhile * expectedMicroseconds(inUse_, costs);
    if (!better || schedule.tasks != inUse_.tasks) return;
    std::unique_ptr<Plan> plan = maker_.plan(schedule);
    inUse_ = std::move(schedule);
    offered_.store(plan.release(), std::memory_order_release);
}

// What the simplexes say of their task time, no further than a factor of two from what they said at
// the look before: one sample may have met anything. Empty: there is no image to read it from.
std::vector<double> Rescheduler::measuredCosts() {
    static const double timing = timingCost();
    const Image image = agent_.images().newest();
    if (!image) return {};
    for (const std::uint32_t simplex : inUse_.tasks) {
        const ItemLayout* item = agent_.structure().simplexes[simplex].layout->find("taskTime");
        if (item == nullptr) continue;
        const double time = image.slice(simplex).floats[item->offset] - timing;
        double& cost = costs_[simplex];
        if (time > 0) cost = cost == 0 ? time : std::clamp(time, cost / 2, cost * 2);
    }
    return costs_;
}

}  // namespace cortex::cs
