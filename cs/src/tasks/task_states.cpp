// SPDX-License-Identifier: Apache-2.0
#include "tasks/task_states.hpp"

#include "tasks/hook.hpp"
#include "tasks/state_machine.hpp"

#include <cmath>

namespace cortex::cs {

void TaskStates::beginCycle() {
    halted_ = haltNext_;
    haltNext_ = false;
    anyMayMove_ = halted_ || forced_ || watching_;
    for (const SetPoint& each : set_.setPoints) judge(each);
}

// A device at rest gives its safe value, and not what people have set.
void TaskStates::judge(const SetPoint& setPoint) {
    SlotState& state = set_.states[setPoint.demand];
    const std::uint32_t device = setPoint.device->index();
    const bool rests = isResting(setPoint.device->state_);
    if (rests && state.quality == Quality::Good) {
        state.quality = Quality::Stale;
        state.cause = device;
    } else if (!rests && state.quality == Quality::Stale && state.cause == device) {
        state.quality = Quality::Good;
        state.cause = noSimplex;
    }
}

void TaskStates::registerWatched(std::uint32_t simplex, Watched& watched) {
    watched_[simplex] = &watched;
}

void TaskStates::checkTimeout(Task& task, const Tick& tick) {
    SimplexCS& simplex = *task.simplex;
    const double timeout = simplex.type().transitionTimeout;
    std::int64_t& since = set_.detailsOf(task).stateSince;
    // It did not look while the loop stood still.
    if (since < tick.nominalTime) since += tick.passed - tick.elapsed;
    const std::int64_t waited = tick.nominalTime - since;
    if (simplex.pending_.done || waited < std::llround(timeout * 1e9)) return;
    EventText text{name(hookOf(simplex.state_))};
    text << " was not done within " << timeout << " s";
    simplex.enterFault(TransitionTimeout, text.view());
}

void TaskStates::transition(Task& task, const Tick& tick) {
    SimplexCS& simplex = *task.simplex;
    simplex.pending_.quality = false;  // of the cycle before
    if (Watched* watched = watchedOf(task)) watched->ran = true;
    if (simplex.pending_.demandRefused) demands_.faultForRefused(task);
    simplex.pending_.demandRefused = false;
    if (halted_ && simplex.state_ == State::Active) {
        simplex.enterFault(haltCode_, haltWhy_);
    }
    if (simplex.pending_.fault) return enterFault(task, tick);
    if (forced_ && !isResting(simplex.state_)) return enter(task, State::Standby, tick);
    if (forced_) return;
    const LifeCycle command = set_.agent.takeLifeCycle(task.index, *simplex.thread_->loop);
    if (command != LifeCycle::None && lifeCycle(task, command, tick)) return;
    if (!simplex.pending_.done) return;
    if (const auto to = next(simplex.state_, Move::Done)) enter(task, *to, tick);
}

// False: the command does not lead anywhere from this state, which is said unless it is harmless.
bool TaskStates::lifeCycle(Task& task, LifeCycle command, const Tick& tick) {
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
        simplex.thread_->text
            << "the fault is not over; its text, or the description of its type, says what ends it";
    } else if (command != LifeCycle::Startup || mayStart(task)) {  // or mayStart gives the reason
        enter(task, *to, tick);
        return true;
    }
    set_.agent.post(*simplex.thread_->loop, tooLate ? Severity::Info : Severity::Warning,
                    EventKind::Refusal, task.index, simplex.thread_->text);
    set_.agent.refuseLifeCycle(task.index, command, simplex.thread_->text, *simplex.thread_->loop);
    noteReason(task);
    return false;
}

bool TaskStates::mayStart(Task& task) {
    SimplexCS& simplex = *task.simplex;
    for (const TaskInput& input : set_.inputsOf(task)) {
        const SimplexInfo& target = set_.structure.simplexes[input.target];
        if (target.remote && input.rule->min > 0 && !set_.agent.isLinked(input.target)) {
            const bool silent =
                set_.agent.everOffered(input.target) && set_.agent.neverLinked(input.target);
            simplex.thread_->text << "startup needs " << input.rule->name << ", but " << target.path
                                  << " of another agent "
                                  << (silent ? "has sent no value yet" : "is not there");
            return false;
        }
    }
    for (const TaskOutput& output : set_.outputsOf(task)) {
        if (output.safe == nullptr || output.safe->observationIsGood()) continue;
        simplex.thread_->text << "startup needs a good observation of what "
                              << set_.structure.simplexes[output.target].path << " demands";
        return false;
    }
    return true;
}

void TaskStates::enter(Task& task, State to, const Tick& tick) {
    SimplexCS& simplex = *task.simplex;
    TaskDetails& details = set_.detailsOf(task);
    const State from = simplex.state_;
    EventText left{to == State::Fault ? "its simplex went to Fault: " : "its simplex left Active"};
    if (to == State::Fault) left << simplex.thread_->text.view();
    if ((from == State::Active || to == State::Fault) &&
        !set_.agent.cancelActivity(task.index, *simplex.thread_->loop, !simplex.dead_,
                                   left.view())) {
        if (to != State::Fault) {
            simplex.enterFault(HookThrew,
                               "the handler of its long command threw while it was cancelled");
        }
        simplex.dead_ = true;
    }
    const bool comesToRest = to == State::Standby && from != State::Fault;
    if (from == State::Active || to == State::StartingUp || to == State::Fault || comesToRest) {
        demands_.latchSafe(
            task, to == State::StartingUp ? SafeDemands::Latch::Startup : SafeDemands::Latch::Stop);
        demands_.writeSafe(task);
    }
    if (from == State::Fault) {
        simplex.dead_ = false;
        details.faultCode = 0;
        details.faultText = std::string_view{};
    }
    simplex.state_ = to;
    simplex.pending_.done = false;
    details.state = static_cast<std::int64_t>(to);
    details.stateSince = tick.nominalTime;
    details.toldInVain = false;
    if (to == State::Active) ++simplex.thread_->startups;
    if (to == State::Fault) return;  // has an event of its own
    EventText text{name(from)};
    text << " -> " << name(to);
    set_.agent.post(*simplex.thread_->loop, Severity::Info, EventKind::StateChange, task.index,
                    text);
}

void TaskStates::enterFault(Task& task, const Tick& tick) {
    SimplexCS& simplex = *task.simplex;
    simplex.pending_.fault = false;
    const bool faultedBefore = simplex.state_ == State::Fault;
    if (faultedBefore && simplex.thread_->faultCode != HookThrew) return;
    if (!faultedBefore) enter(task, State::Fault, tick);
    TaskDetails& details = set_.detailsOf(task);
    details.faultCode = simplex.thread_->faultCode;
    details.faultText = simplex.thread_->brief.view();
    EventText text{"fault "};
    text << simplex.thread_->faultCode << ": " << simplex.thread_->text.view();
    noteReason(task);
    set_.agent.post(*simplex.thread_->loop, Severity::Error, EventKind::Fault, task.index, text);
}

void TaskStates::noteReason(const Task& task) {
    if (Watched* watched = watchedOf(task)) watched->reason = task.simplex->thread_->text;
}

}  // namespace cortex::cs
