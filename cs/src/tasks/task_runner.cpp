// SPDX-License-Identifier: Apache-2.0
#include "tasks/task_runner.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/error.hpp"

#include "tasks/refused_exit.hpp"
#include "tasks/state_machine.hpp"
#include "tasks/unbound_handle.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <span>
#include <utility>

namespace cortex::cs {

namespace {

// Tasks that are timed in a cycle: to time one takes some 20 ns.
constexpr std::uint32_t timedWhole = 64;  // of so few all, while time is that of the machine
constexpr std::uint32_t timedInTurn = 32;

}  // namespace

TaskRunner::TaskRunner(AgentRuntime& agent, const Schedule& schedule, std::int64_t period)
    : set_{agent, schedule, period},
      demands_{set_},
      inputs_{set_, demands_},
      states_{set_, demands_},
      values_{set_},
      chunks_{schedule.chunks},
      positions_{std::make_unique<Position[]>(agent.threadCount())},
      escapes_{std::make_unique<Escape[]>(agent.threadCount())},
      timed_{agent.options().realTime && set_.tasks.size() <= timedWhole ? timedWhole
                                                                         : timedInTurn} {}

void TaskRunner::beginCycle(const Tick& tick, std::int64_t next) {
    states_.beginCycle();
    tick_ = tick;
    noteStandstill(tick);
    const bool slow = longest().time > set_.period / 2;
    for (TaskThread& thread : set_.threads) {
        thread.longest = {};
        thread.nextDeadline = next;
        thread.stoodUntil = set_.standstill.end;
    }
    if (tick.cycle == 1 || (slow && timedAll_)) return;  // a slow one is timed again
    firstTimed_ += timed_;
    if (firstTimed_ < set_.tasks.size()) return;
    firstTimed_ = 0;
    timedAll_ = true;
}

// By the clock of the machine, because nominal time may stand still as well. A loop that is stepped
// by hand has nominal time alone.
void TaskRunner::noteStandstill(const Tick& tick) {
    constexpr std::int64_t usualPeriods = 3;
    const bool realTime = set_.agent.options().realTime;
    const std::int64_t now =
        realTime ? set_.agent.thread(0).clock.nanoseconds : tick.nominalTime + set_.period;
    const std::int64_t length = now - std::exchange(lastBegin_, now);
    if (length > usualPeriods * set_.period && length != now) {
        set_.standstill = {tick.nominalTime, length, realTime ? now : 0};
    }
}

void TaskRunner::run(std::uint32_t chunk, std::uint32_t worker) {
    set_.threads[worker].loop->clock = {tick_.cycle, monotonicNow()};
    const std::uint32_t first = chunks_[chunk].first, end = first + chunks_[chunk].count;
    // Locals keep their values over the jump, as none is changed after this.
    if (_setjmp(escapes_[worker].place) == 0)
        runTasks(first, end, worker);
    else
        runTasks(endEscaped(first, end, worker), end, worker);
}

void TaskRunner::runTasks(std::uint32_t from, std::uint32_t end, std::uint32_t worker) {
    TaskThread& thread = set_.threads[worker];
    Position& position = positions_[worker];
    for (std::uint32_t i = from; i < end; ++i) {
        if (i - firstTimed_ < timed_)  // for those before it this is a large number
            runTimed(set_.tasks[i], thread, position);
        else
            runTask(set_.tasks[i], thread, position);
    }
    position.simplex.store(noSimplex, std::memory_order_relaxed);
    position.setHook(Hook::None);
}

std::uint32_t TaskRunner::endEscaped(std::uint32_t from, std::uint32_t end, std::uint32_t worker) {
    const std::uint32_t simplex = positions_[worker].simplex.load(std::memory_order_relaxed);
    while (from < end && set_.tasks[from].index != simplex) ++from;
    if (from == end) return end;
    Task& task = set_.tasks[from];
    task.simplex->enterFault(HookThrew, refusedExitText());
    task.simplex->dead_ = true;
    endTask(task, *task.simplex, tick_);
    return from + 1;
}

void TaskRunner::runTimed(Task& task, TaskThread& thread, Position& position) {
    const std::int64_t start = monotonicNow();
    if (!runTask(task, thread, position)) return;
    const std::int64_t time = monotonicNow() - start;
    set_.detailsOf(task).taskTime = static_cast<double>(time) * 1e-3;
    if (time > thread.longest.time) thread.longest = {task.index, time};
}

bool TaskRunner::runTask(Task& task, TaskThread& thread, Position& position) {
    if (!task.everyCycle) return runAtTimes(task, thread, position);
    if (task.simplex == nullptr) {
        demands_.arbitrate(*set_.detailsOf(task).arbiter, tick_, thread);
        return false;
    }
    runSimplex(task, tick_, thread, position);
    return true;
}

bool TaskRunner::runAtTimes(Task& task, TaskThread& thread, Position& position) {
    TaskDetails& details = set_.detailsOf(task);
    const bool itsTurn =
        static_cast<std::uint64_t>(tick_.cycle - 1) % details.every == details.phase;
    if (!itsTurn && !states_.allRun()) return false;
    Tick tick = tick_;
    tick.passed = tick.nominalTime - std::exchange(details.lastRun, tick.nominalTime);
    tick.elapsed = std::min(tick.passed, Tick::mostPeriods * details.every * set_.period);
    runSimplex(task, tick, thread, position);
    return true;
}

// Of the simplex and its task nothing is written here that has not changed: what is only read need
// not go back to the memory.
inline void TaskRunner::runSimplex(Task& task, const Tick& tick, TaskThread& thread,
                                   Position& position) {
    SimplexCS& simplex = *task.simplex;
    if (simplex.thread_ != &thread) simplex.thread_ = &thread;
    position.simplex.store(task.index, std::memory_order_relaxed);
    position.setHook(Hook::Commands);
    if (task.measures) inputs_.noteSilence(task, tick);
    set_.states[task.index] = {tick.cycle, tick.nominalTime, noSimplex, Quality::Good};
    try {
        const std::uint8_t calls = set_.agent.calls(task.index);
        if (states_.mayMove(simplex, calls)) states_.transition(task, tick);
        if (isPassing(simplex.state_)) demands_.put(task, tick);
        if (AgentRuntime::hasCommandWork(calls)) {
            set_.agent.processCommands(task.index, simplex.state_, *thread.loop, simplex.dead_);
            if (task.demands != Task::Demands::None) demands_.tellHandlersInVain(task);
        }
        if (task.inputCount != 0) set_.states[task.index] = inputs_.read(task, tick);
        if (!simplex.pending_.fault) runHooks(task, simplex, tick, position);
    } catch (const UnboundHandle& unbound) {
        const Hook hook = position.hook.load(std::memory_order_relaxed);
        simplex.enterFault(HookThrew, textOf(unbound, simplex, set_.agent.tables(), hook).view(),
                           briefOf(unbound, hook).view());
        simplex.dead_ = true;
    } catch (const std::exception& error) {
        simplex.enterFault(HookThrew, error.what());
        simplex.dead_ = true;
    } catch (...) {
        simplex.enterFault(HookThrew, "a hook threw something that is no std::exception");
        simplex.dead_ = true;
    }
    endTask(task, simplex, tick);
}

// After its hooks, however they ended. In line, as it runs for each task of each cycle.
[[gnu::always_inline]] inline void TaskRunner::endTask(Task& task, SimplexCS& simplex,
                                                       const Tick& tick) {
    if (simplex.pending_.fault) states_.enterFault(task, tick);
    if (task.demands != Task::Demands::None) finishDemands(task, tick);
    TaskInputs::settleQuality(set_.states[task.index], task, simplex, tick);
    for (const TaskOutput& output : set_.outputsOf(task)) {
        *output.state =
            output.standsSafe ? ofSafeDemand(task.index, tick) : set_.states[task.index];
    }
    if (task.values != Task::Values::Right) values_.check(task);
}

inline void TaskRunner::runHooks(Task& task, SimplexCS& simplex, const Tick& tick,
                                 Position& position) {
    if (simplex.dead_) return;
    position.setHook(Hook::LoopStart);
    simplex.loopStart(tick);
    if (simplex.state_ == State::Active) {
        position.setHook(Hook::Active);
        if (!simplex.safeByLoss_) simplex.stateActive(tick);
    } else if (simplex.state_ == State::Standby) {
        position.setHook(Hook::Standby);
        simplex.stateStandby(tick);
    } else {
        runPassing(simplex, tick, position);
    }
    position.setHook(Hook::LoopEnd);
    simplex.loopEnd(tick);
    if (isPassing(simplex.state_)) states_.checkTimeout(task, tick);
}

// The functions that say when they are done.
void TaskRunner::runPassing(SimplexCS& simplex, const Tick& tick, Position& position) {
    position.setHook(hookOf(simplex.state_));
    if (simplex.state_ == State::StartingUp)
        simplex.pending_.done = simplex.stateStartingUp(tick);
    else if (simplex.state_ == State::ShuttingDown)
        simplex.pending_.done = simplex.stateShuttingDown(tick);
    else
        simplex.pending_.done = simplex.stateFault(tick);
}

// After all hooks, whoever of them wrote: safe values where they stand, then limits. What is not a
// number or faults the task becomes safe, and is limited once more.
void TaskRunner::finishDemands(Task& task, const Tick& tick) {
    demands_.settle(task, tick);
    bool again = demands_.limit(task, tick);
    if (task.simplex->pending_.fault) {
        states_.enterFault(task, tick);
        demands_.settle(task, tick);
        again = true;
    }
    demands_.accept(task, tick, again);
}

LongestTask TaskRunner::longest() const {
    LongestTask longest;
    for (const TaskThread& thread : set_.threads) {
        if (thread.longest.time > longest.time) longest = thread.longest;
    }
    return longest;
}

RunnerCounts TaskRunner::counts() const {
    RunnerCounts sum;
    for (const TaskThread& thread : set_.threads) {
        sum.limits += thread.limits;
        sum.conflicts += thread.conflicts;
        sum.startups += thread.startups;
    }
    return sum;
}

}  // namespace cortex::cs
