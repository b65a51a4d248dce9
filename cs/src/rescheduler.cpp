// SPDX-License-Identifier: Apache-2.0
#include "rescheduler.hpp"

#include <algorithm>
#include <utility>

namespace cortex::cs {

namespace {

constexpr std::chrono::milliseconds longestPause{60'000};
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
    std::unique_lock lock{mutex_};
    while (!wake_.wait_for(lock, pause_, [this] { return stopping_; })) {
        delete returned_.exchange(nullptr, std::memory_order_acq_rel);
        if (offered_.load(std::memory_order_acquire) == nullptr) look();
        pause_ = std::min(2 * pause_, longestPause);
    }
}

void Rescheduler::look() {
    const std::vector<double> costs = measuredCosts();
    if (costs.empty()) return;
    Schedule schedule = maker_.schedule(costs);
    const bool better =
        expectedMicroseconds(schedule, costs) < worthwhile * expectedMicroseconds(inUse_, costs);
    if (!better || schedule.tasks != inUse_.tasks) return;
    inUse_ = schedule;
    offered_.store(maker_.plan(std::move(schedule)).release(), std::memory_order_release);
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
