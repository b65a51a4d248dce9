// SPDX-License-Identifier: Apache-2.0
#include "tasks/task_runner.hpp"

#include "tasks/state_machine.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <exception>
#include <span>
#include <utility>

namespace cortex::cs {

namespace {

std::int64_t monotonicNow() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

void at(Position& position, Hook hook) { position.hook.store(hook, std::memory_order_relaxed); }

bool isTransitional(State state) {
    return state == State::StartingUp || state == State::ShuttingDown;
}

constexpr std::array hookOfState{Hook::Standby, Hook::StartingUp, Hook::Active, Hook::ShuttingDown,
                                 Hook::Fault};

}  // namespace

const char* name(Hook hook) {
    constexpr std::array names{"no hook",           "a command",       "loopStart",
                               "stateStandby",      "stateStartingUp", "stateActive",
                               "stateShuttingDown", "stateFault",      "loopEnd"};
    return names[static_cast<std::size_t>(hook)];
}

void TaskRunner::beginCycle(const Tick& tick) {
    halted_ = haltNext_;
    haltNext_ = false;
    anyMayMove_ = halted_ || forced_ || listenedTo_ != noSimplex;
    tick_ = tick;
    if (!chunks_.empty())
        timedChunk_ = (timedChunk_ + 1) % static_cast<std::uint32_t>(chunks_.size());
}

void TaskRunner::run(std::uint32_t chunk, std::uint32_t worker) {
    TaskThread& thread = threads_[worker];
    Position& position = positions_[worker];
    thread.loop->clock = {tick_.cycle, monotonicNow()};
    const std::span tasks{tasks_.data() + chunks_[chunk].first, chunks_[chunk].count};
    for (Task& task : tasks) {
        if (chunk == timedChunk_)
            runTimed(task, thread, position);
        else
            runTask(task, thread, position);
    }
    position.simplex.store(noSimplex, std::memory_order_relaxed);
    at(position, Hook::None);
}

void TaskRunner::runTimed(Task& task, TaskThread& thread, Position& position) {
    const std::int64_t start = monotonicNow();
    if (!runTask(task, thread, position)) return;
    details(task).taskTime = static_cast<double>(monotonicNow() - start) * 1e-3;
}

// Whether step (1) may change the state; mostly nothing has happened that could.
bool TaskRunner::mayMove(const SimplexCS& simplex, std::uint8_t calls) const {
    return anyMayMove_ || simplex.pending_.any() || AgentRuntime::hasLifeCycle(calls);
}

bool TaskRunner::runTask(Task& task, TaskThread& thread, Position& position) {
    if (!task.everyCycle) return runAtTimes(task, thread, position);
    if (task.simplex == nullptr) {
        arbitrate(*details(task).arbiter, thread);
        return false;
    }
    runSimplex(task, tick_, thread, position);
    return true;
}

bool TaskRunner::runAtTimes(Task& task, TaskThread& thread, Position& position) {
    TaskDetails& is = details(task);
    const bool itsTurn = static_cast<std::uint64_t>(tick_.cycle - 1) % is.every == is.phase;
    if (!itsTurn && !halted_ && !forced_) return false;
    Tick tick = tick_;
    tick.elapsed = tick.nominalTime - std::exchange(is.lastRun, tick.nominalTime);
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
    at(position, Hook::Commands);
    states_[task.index] = {tick.cycle, tick.nominalTime, noSimplex, Quality::Good};
    try {
        const std::uint8_t calls = agent_.calls(task.index);
        if (mayMove(simplex, calls)) transition(task, tick);
        if (AgentRuntime::hasCommandWork(calls)) {
            agent_.processCommands(task.index, simplex.state_, *thread.loop, simplex.dead_);
        }
        if (task.inputCount != 0) states_[task.index] = readInputs(task, tick);
        if (!simplex.pending_.fault) runHooks(task, simplex, tick, position);
    } catch (const std::exception& error) {
        simplex.fault(HookThrew, error.what());
        simplex.dead_ = true;
    } catch (...) {
        simplex.fault(HookThrew, "a hook threw something that is no std::exception");
        simplex.dead_ = true;
    }
    if (simplex.pending_.fault) enterFault(task, tick);
    if (task.limits) limitOutputs(task, tick);
    settleQuality(task, simplex, tick);
    for (std::uint32_t i = 0; i < task.outputCount; ++i) {
        *outputs_[task.firstOutput + i].state = states_[task.index];
    }
}

inline void TaskRunner::runHooks(Task& task, SimplexCS& simplex, const Tick& tick,
                                 Position& position) {
    if (simplex.state_ == State::Standby || simplex.state_ == State::Fault) writeSafe(task);
    if (simplex.dead_) return;
    at(position, Hook::LoopStart);
    simplex.loopStart(tick);
    if (simplex.state_ == State::Active) {
        at(position, Hook::Active);
        if (simplex.safeByLoss_)
            writeSafe(task);
        else
            simplex.stateActive(tick);
    } else if (simplex.state_ == State::Standby) {
        at(position, Hook::Standby);
        simplex.stateStandby(tick);
    } else {
        runPassing(simplex, tick, position);
    }
    at(position, Hook::LoopEnd);
    simplex.loopEnd(tick);
    if (isTransitional(simplex.state_)) checkTimeout(task, tick);
}

// The functions that say when they are done.
void TaskRunner::runPassing(SimplexCS& simplex, const Tick& tick, Position& position) {
    at(position, hookOfState[static_cast<std::size_t>(simplex.state_)]);
    if (simplex.state_ == State::StartingUp)
        simplex.pending_.done = simplex.stateStartingUp(tick);
    else if (simplex.state_ == State::ShuttingDown)
        simplex.pending_.done = simplex.stateShuttingDown(tick);
    else
        simplex.pending_.done = simplex.stateFault(tick);
}

// What its own state, and what the task said itself, make of the quality of its inputs.
inline void TaskRunner::settleQuality(const Task& task, const SimplexCS& simplex,
                                      const Tick& tick) const {
    SlotState& state = states_[task.index];
    if (task.measures && !simplex.dead_) {
        state = {tick.cycle, tick.nominalTime, noSimplex, Quality::Good};
    } else if (simplex.state_ != State::Active) {
        const Quality most = simplex.state_ == State::Fault ? Quality::Bad : Quality::Stale;
        if (state.quality < most) {
            state.quality = most;
            state.cause = task.index;
        }
    }
    if (!simplex.pending_.quality) return;
    state.quality = simplex.quality_;
    state.time = simplex.thread_->measuredAt;
    state.cause = simplex.quality_ == Quality::Good ? noSimplex : task.index;
}

void TaskRunner::checkTimeout(Task& task, const Tick& tick) {
    SimplexCS& simplex = *task.simplex;
    const double timeout = simplex.type().transitionTimeout;
    const std::int64_t passed = tick.nominalTime - details(task).stateSince;
    if (simplex.pending_.done || passed < std::llround(timeout * 1e9)) return;
    EventText text{name(hookOfState[static_cast<std::size_t>(simplex.state_)])};
    text << " was not done within " << timeout << " s";
    simplex.fault(TransitionTimeout, text.view());
}

void TaskRunner::transition(Task& task, const Tick& tick) {
    SimplexCS& simplex = *task.simplex;
    simplex.pending_.quality = false;  // of the cycle before
    if (task.index == listenedTo_) heardRun_ = true;
    for (std::uint32_t i = 0; simplex.pending_.demandRefused && i < task.outputCount; ++i) {
        TaskOutput& output = outputs_[task.firstOutput + i];
        if (output.refused.faulting == nullptr) continue;
        simplex.fault(output.refused.notFinite ? DemandNotFinite : DemandOutOfRange,
                      refusal(output.refused, output.target).view());
        output.refused = {};
    }
    simplex.pending_.demandRefused = false;
    if (halted_ && simplex.state_ == State::Active) {
        simplex.fault(ClusterHalted, "the loop overran its period and overflow is \"halt\"");
    }
    if (simplex.pending_.fault) return enterFault(task, tick);
    const bool resting = simplex.state_ == State::Standby || simplex.state_ == State::Fault;
    if (forced_ && !resting) return enter(task, State::Standby, tick);
    if (forced_) return;
    const LifeCycle command = agent_.takeLifeCycle(task.index, *simplex.thread_->loop);
    if (command != LifeCycle::None && lifeCycle(task, command, tick)) return;
    if (!simplex.pending_.done) return;
    if (const auto to = next(simplex.state_, Move::Done)) enter(task, *to, tick);
}

// False: the command does not lead anywhere from this state, which is said unless it is harmless.
bool TaskRunner::lifeCycle(Task& task, LifeCycle command, const Tick& tick) {
    SimplexCS& simplex = *task.simplex;
    const auto to = next(simplex.state_, moveOf(command));
    if (!to && command == LifeCycle::Shutdown) return false;  // on its way, or not running
    simplex.thread_->text = EventText{};
    const bool tooLate = stopping_ && command == LifeCycle::Startup;
    if (tooLate) {
        simplex.thread_->text << "no startup: the cluster is stopping";
    } else if (!to) {
        simplex.thread_->text << (command == LifeCycle::Startup ? "startup needs Standby, is "
                                                                : "clearFaults needs Fault, is ")
                              << name(simplex.state_);
    } else if (command == LifeCycle::ClearFaults && !simplex.dead_ && !simplex.pending_.done) {
        simplex.thread_->text << "the fault is not over: stateFault has not returned true";
    } else if (command != LifeCycle::Startup || mayStart(task)) {  // mayStart says why not
        enter(task, *to, tick);
        return true;
    }
    agent_.post(*simplex.thread_->loop, tooLate ? Severity::Info : Severity::Warning,
                EventKind::Refusal, task.index, simplex.thread_->text);
    agent_.refuseLifeCycle(task.index, command, simplex.thread_->text, *simplex.thread_->loop);
    tell(task);
    return false;
}

bool TaskRunner::mayStart(Task& task) {
    SimplexCS& simplex = *task.simplex;
    for (std::uint32_t i = 0; i < task.inputCount; ++i) {
        const TaskInput& input = inputs_[task.firstInput + i];
        const SimplexInfo& target = structure_.simplexes[input.target];
        if (target.remote && input.rule->min > 0 && input.state->quality == Quality::Lost) {
            simplex.thread_->text << "startup needs " << input.rule->name << ", but " << target.path
                                  << " of another agent is not there";
            return false;
        }
    }
    for (std::uint32_t i = 0; i < task.outputCount; ++i) {
        const TaskOutput& output = outputs_[task.firstOutput + i];
        if (output.safe == nullptr || output.safe->observationIsGood()) continue;
        simplex.thread_->text << "startup needs a good observation of what "
                              << structure_.simplexes[output.target].path << " demands";
        return false;
    }
    return true;
}

void TaskRunner::enter(Task& task, State to, const Tick& tick) {
    SimplexCS& simplex = *task.simplex;
    TaskDetails& is = details(task);
    const State from = simplex.state_;
    const char* left = to == State::Fault ? "its simplex went to Fault" : "its simplex left Active";
    if ((from == State::Active || to == State::Fault) &&
        !agent_.cancelActivity(task.index, *simplex.thread_->loop, !simplex.dead_, left)) {
        if (to != State::Fault) {
            simplex.fault(HookThrew,
                          "the handler of its long command threw while it was cancelled");
        }
        simplex.dead_ = true;
    }
    const bool comesToRest = to == State::Standby && from != State::Fault;
    if (from == State::Active || to == State::StartingUp || to == State::Fault || comesToRest) {
        latchSafe(task);
        writeSafe(task);
    }
    if (from == State::Fault) {
        simplex.dead_ = false;
        is.faultCode = 0;
        is.faultText = std::string_view{};
    }
    simplex.state_ = to;
    simplex.pending_.done = false;
    is.state = static_cast<std::int64_t>(to);
    is.stateSince = tick.nominalTime;
    if (to == State::Active) ++simplex.thread_->startups;
    if (to == State::Fault) return;  // has an event of its own
    EventText text{name(from)};
    text << " -> " << name(to);
    agent_.post(*simplex.thread_->loop, Severity::Info, EventKind::StateChange, task.index, text);
}

void TaskRunner::enterFault(Task& task, const Tick& tick) {
    SimplexCS& simplex = *task.simplex;
    simplex.pending_.fault = false;
    const bool faultedBefore = simplex.state_ == State::Fault;
    if (faultedBefore) writeSafe(task);
    if (faultedBefore && simplex.thread_->faultCode != HookThrew) return;
    if (!faultedBefore) enter(task, State::Fault, tick);
    TaskDetails& is = details(task);
    is.faultCode = simplex.thread_->faultCode;
    is.faultText = simplex.thread_->text.view();
    EventText text{"fault "};
    text << simplex.thread_->faultCode << ": " << simplex.thread_->text.view();
    tell(task);
    agent_.post(*simplex.thread_->loop, Severity::Error, EventKind::Fault, task.index, text);
}

void TaskRunner::tell(const Task& task) {
    if (task.index == listenedTo_) heard_ = task.simplex->thread_->text;
}

void TaskRunner::latchSafe(Task& task) {
    for (std::uint32_t i = 0; i < task.outputCount; ++i) {
        const TaskOutput& output = outputs_[task.firstOutput + i];
        if (output.safe != nullptr) output.safe->latch();
    }
}

void TaskRunner::writeSafe(Task& task) {
    for (std::uint32_t i = 0; i < task.outputCount; ++i) {
        const TaskOutput& output = outputs_[task.firstOutput + i];
        if (output.safe != nullptr) output.safe->write();
    }
}

RunnerCounts TaskRunner::counts() const {
    RunnerCounts sum;
    for (const TaskThread& thread : threads_) {
        sum.limits += thread.limits;
        sum.conflicts += thread.conflicts;
        sum.startups += thread.startups;
    }
    return sum;
}

}  // namespace cortex::cs
