// SPDX-License-Identifier: Apache-2.0
#include "loop/rescheduler.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace cortex::cs {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int samplesOfALook = 5;  // of which the median counts: one may have met anything
constexpr std::chrono::nanoseconds betweenSamples = std::chrono::milliseconds{100};
constexpr double worthwhile = 0.8;  // of the time that the plan in use is expected to take

// Timing a task takes two readings of the clock, of which one falls into the time.
double timingCost() {
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
            thread += std::max(costMicroseconds[schedule.tasks[i]], leastTaskMicroseconds);
        }
        finished.push_back(thread);
    }
    const double wake = count > 1 ? wakeMicroseconds : 0;
    return *std::max_element(threads.begin(), threads.end()) + wake;
}

Rescheduler::Rescheduler(AgentRuntime& agent, const Schedule& inUse, Maker maker)
    : agent_{agent}, tasks_{inUse.tasks}, maker_{std::move(maker)}, inUse_{inUse}, thread_{[this] {
          run();
      }} {}

Rescheduler::~Rescheduler() {
    stopping_.store(true);
    signals_.advance();
    thread_.join();
}

void Rescheduler::follow(std::uint64_t startups, std::int64_t now, bool timedAll) {
    if (hasLooked_) return;
    if (std::exchange(startups_, startups) != startups) due_ = now + settlingTime;
    const bool isSettled = due_ != 0 && now >= due_;
    const bool isFirst = timedAll && !hasLookedFirst_;
    if ((!isSettled && !isFirst) || isLooking()) return;
    hasLookedFirst_ = true;
    hasLooked_ = isSettled;
    look();
}

void Rescheduler::look() {
    if (!isLooking()) hand(Stage::Asked);
}

void Rescheduler::lookAndTell() {
    tells_.store(true);
    look();
}

bool Rescheduler::exchange(std::unique_ptr<Plan>& plan) {
    if (stage() != Stage::Offered) return false;
    std::swap(plan, plan_);
    hand(Stage::Returned);
    return true;
}

bool Rescheduler::offer(std::unique_ptr<Plan> plan) {
    if (isLooking() || plan->schedule.tasks != tasks_) return false;
    inUse_ = plan->schedule;
    plan_ = std::move(plan);
    hand(Stage::Offered);
    return true;
}

void Rescheduler::run() {
    while (!stopping_.load()) {
        const std::uint32_t seen = signals_.value();
        if (stage() == Stage::Asked) {
            plan_ = betterPlanIfPossible();
            last_ = {plan_ != nullptr, inUse_.threads};
            hand(last_.isBetter ? Stage::Offered : Stage::Idle);
            tellIfAsked();
        } else if (stage() == Stage::Returned) {
            plan_.reset();
            hand(Stage::Idle);
            tellIfAsked();
        } else if (!stopping_.load()) {
            signals_.sleepWhile(seen);
        }
    }
}

void Rescheduler::tellIfAsked() {
    if (!tells_.exchange(false)) return;
    EventText text{"reschedule: "};
    text << (last_.isBetter ? "takes a better plan with " : "stays with ") << last_.threads
         << (last_.threads == 1 ? " thread" : " threads")
         << (last_.isBetter ? "" : ", no other plan is better");
    Event event;
    event.simplex = agent_.agentSimplex();
    event.text = text;
    agent_.events().postOutside(event);
}

// Where the system has no thread or memory left for another plan, the one in use stays.
std::unique_ptr<Plan> Rescheduler::betterPlanIfPossible() {
    try {
        return betterPlan();
    } catch (const std::exception& error) {
        EventText text{"no other plan for the loop: "};
        Event event;
        event.severity = Severity::Warning;
        event.simplex = agent_.agentSimplex();
        event.text = text << error.what();
        agent_.events().postOutside(event);
        return nullptr;
    }
}

std::unique_ptr<Plan> Rescheduler::betterPlan() {
    const std::vector<double> costs = measuredCosts();
    if (costs.empty()) return nullptr;
    Schedule schedule = maker_.schedule(costs);
    const bool isBetter =
        expectedMicroseconds(schedule, costs) < worthwhile * expectedMicroseconds(inUse_, costs);
    if (!isBetter || schedule.tasks != tasks_) return nullptr;
    std::unique_ptr<Plan> plan = maker_.plan(schedule);
    inUse_ = std::move(schedule);
    return plan;
}

// By simplex, 0: not timed yet. Empty: there is no image to read it from, or no time left.
std::vector<double> Rescheduler::measuredCosts() {
    std::vector<std::vector<double>> samples(agent_.structure().simplexes.size());
    for (int i = 0; i < samplesOfALook; ++i) {
        const std::int64_t end = (Clock::now().time_since_epoch() + betweenSamples).count();
        while (i > 0 && !stopping_.load() && signals_.sleepWhile(signals_.value(), end)) {
        }
        if (stopping_.load() || !addSample(samples)) return {};
    }
    std::vector<double> costs(samples.size());
    for (const std::uint32_t simplex : tasks_) {
        std::vector<double>& of = samples[simplex];
        if (of.empty()) continue;
        std::ranges::sort(of);
        costs[simplex] = of[of.size() / 2];
    }
    return costs;
}

// What the simplexes say of their task time.
bool Rescheduler::addSample(std::vector<std::vector<double>>& samples) const {
    static const double timing = timingCost();
    const Image image = agent_.images().newest();
    if (!image) return false;
    for (const std::uint32_t simplex : tasks_) {
        const ItemLayout* item = agent_.structure().simplexes[simplex].layout->find("taskTime");
        if (item == nullptr) continue;
        const double time = image.slice(simplex).floats[item->offset];
        if (time > 0) samples[simplex].push_back(std::max(time - timing, leastTaskMicroseconds));
    }
    return true;
}

}  // namespace cortex::cs
