// SPDX-License-Identifier: Apache-2.0
#include "loop/watchdog.hpp"

#include "loop/running_time.hpp"

#include <utility>

namespace cortex::cs {

HungHook findHungHook(const TaskRunner& runner, AgentRuntime& agent) {
    for (std::uint32_t worker = 0; worker < agent.threadCount(); ++worker) {
        const Position& position = runner.position(worker);
        const std::uint32_t simplex = position.simplex.load(std::memory_order_relaxed);
        const Hook hook = position.hook.load(std::memory_order_relaxed);
        if (simplex == noSimplex || hook == Hook::None) continue;
        return {agent.structure().simplexes[simplex].path, name(hook), true};
    }
    return {"/" + agent.name(), "the framework, an interface, a heartbeat or the trigger", false};
}

std::string HungHook::standstill() const {
    if (!inTask) return "hangs in " + hook;
    return hook == name(Hook::Commands) ? "hangs in " + hook + " of " + path
                                        : "hangs in " + path + "." + hook;
}

Watchdog::Watchdog(WatchdogLimits limits, Report report)
    : limits_{limits}, report_{std::move(report)}, thread_{[this] { run(); }} {}

Watchdog::~Watchdog() {
    {
        const std::lock_guard lock{mutex_};
        stopping_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

void Watchdog::run() {
    std::int64_t runs = 0, last = 0;  // cycles
    RunningTime stood{limits_.limit / 2};
    std::unique_lock lock{mutex_};
    while (!wake_.wait_for(lock, limits_.limit / 4, [this] { return stopping_; })) {
        const std::int64_t before = std::exchange(runs, executing());
        if (std::exchange(last, begun()) == last && runs == before) {
            look(runs, last, stood.look());
            continue;
        }
        stood.restart();
        since_ = monotonicNow();
        if (told_) tell(Finding::GoesOn, last);
        told_ = timedOut_ = false;
    }
}

void Watchdog::look(std::int64_t runs, std::int64_t last, std::chrono::nanoseconds stood) {
    const bool waits = runs == 0 && last != 0 && limits_.triggerTimeout.count() > 0;
    if ((runs == 0 && !waits) || stood < limits_.limit) return;
    if (!told_) {
        told_ = true;
        reported_.store(last, std::memory_order_release);
        tell(waits ? Finding::NoTick : Finding::Hangs, last);
    }
    if (!waits || timedOut_ || stood < limits_.triggerTimeout) return;
    timedOut_ = true;
    tell(Finding::TimedOut, last);
}

void Watchdog::tell(Finding finding, std::int64_t cycle) {
    report_(finding, {cycle, nominalTime_.load(std::memory_order_relaxed)}, since_);
}

}  // namespace cortex::cs
