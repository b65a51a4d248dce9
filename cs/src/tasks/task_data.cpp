// SPDX-License-Identifier: Apache-2.0
// What the framework does with a task's inputs before its hooks and with its outputs after them:
// loss, quality and stamps, limits, arbitration between writers.
#include "tasks/task_runner.hpp"

#include <algorithm>
#include <span>

namespace cortex::cs {

namespace {

// Worst quality with its first cause, oldest stamp.
void merge(SlotState& sum, const SlotState& state, bool ages) {
    if (state.quality > sum.quality) {
        sum.quality = state.quality;
        sum.cause = state.cause;
    }
    if (ages && state.time < sum.time) {
        sum.time = state.time;
        sum.cycle = state.cycle;
    }
}

// ns. What comes over a network ages while this cycle was late to wake up, too.
std::int64_t ageOf(const TaskInput& input, const Tick& tick) {
    const std::int64_t late = input.ownerPeriod != nullptr ? tick.lateness : 0;
    return tick.nominalTime + late - input.state->time;
}

}  // namespace

// The rare case of an input: lost, back, aged, held, or not good.
SlotState TaskRunner::readInput(Task& task, TaskInput& input, const Tick& tick) {
    const bool tooOld = input.ages && ageOf(input, tick) > input.maxAge;
    const bool lost = input.state->quality >= Quality::Bad || tooOld;
    const bool faults =
        lost && input.rule->onLoss == OnLoss::Fault && task.simplex->state_ == State::Active;
    if (lost != input.lost || faults) {
        input.lost = lost;
        inputLost(task, input, tick);
    }
    SlotState seen = *input.state;
    if (lost && seen.quality < Quality::Stale) {  // it is too old, which is its own doing
        seen.quality = Quality::Stale;
        seen.cause = input.target;
    }
    if (input.held == nullptr) return seen;
    const HeldInput& held = *input.held;
    if (!lost) {
        copySlice(held.sizes, held.from, held.to);
        return seen;
    }
    if (held.to.state->quality < Quality::Stale) {
        held.to.state->quality = Quality::Stale;
        held.to.state->cause = seen.cause;
    }
    return *held.to.state;
}

SlotState TaskRunner::readInputs(Task& task, const Tick& tick) {
    SlotState sum{tick.cycle, tick.nominalTime, noSimplex, Quality::Good};
    bool anyLost = false, safe = false;
    for (std::uint32_t i = 0; i < task.inputCount; ++i) {
        TaskInput& input = inputs_[task.firstInput + i];
        if (input.ownerPeriod != nullptr) {
            input.maxAge = std::max(input.maxAge, 3 * *input.ownerPeriod);
        }
        const bool fresh = !input.ages || ageOf(input, tick) <= input.maxAge;
        if (fresh && !input.lost && input.held == nullptr &&
            input.state->quality == Quality::Good) {
            merge(sum, *input.state, input.ages);
            continue;
        }
        merge(sum, readInput(task, input, tick), input.ages);
        anyLost = anyLost || input.lost;
        safe = safe || (input.lost && input.rule->onLoss == OnLoss::Safe);
    }
    SimplexCS& simplex = *task.simplex;
    simplex.inputLost_ = anyLost;
    if (safe || simplex.safeByLoss_) {
        safe = safe && simplex.state_ == State::Active;
        if (safe && !simplex.safeByLoss_) latchSafe(task);
        simplex.safeByLoss_ = safe;
    }
    return sum;
}

// An input was lost, or is back.
void TaskRunner::inputLost(Task& task, TaskInput& input, const Tick& tick) {
    SimplexCS& simplex = *task.simplex;
    EventText text{input.rule->name};
    text << " " << structure_.simplexes[input.target].path;
    if (!input.lost) {
        text << " is back";
        agent_.post(*simplex.thread_->loop, Severity::Info, EventKind::Message, task.index, text);
        return;
    }
    if (input.state->quality >= Quality::Bad) {
        text << " is " << name(input.state->quality);
        const std::uint32_t cause = input.state->cause;
        if (cause < structure_.simplexes.size()) {
            text << ", first cause " << structure_.simplexes[cause].path;
        }
    } else {
        text << " is " << static_cast<double>(ageOf(input, tick)) * 1e-6 << " ms old, allowed "
             << static_cast<double>(input.maxAge) * 1e-6;
    }
    if (input.rule->onLoss == OnLoss::Fault && simplex.state_ == State::Active) {
        simplex.fault(InputLost, text.view());
    } else {
        text << "; " << name(input.rule->onLoss);
        agent_.post(*simplex.thread_->loop, Severity::Warning, EventKind::Message, task.index,
                    text);
    }
}

// Each demand that this task alone writes. What is not a number or faults the task becomes safe,
// and no demand moves further than its rate allows, safe or not.
void TaskRunner::limitOutputs(Task& task, const Tick& tick) {
    SimplexCS& simplex = *task.simplex;
    const std::span outputs{outputs_.data() + task.firstOutput, task.outputCount};
    const double elapsed = tick.elapsedSeconds();
    const bool demands = simplex.state_ == State::Active && !simplex.safeByLoss_;
    bool again = false;
    for (TaskOutput& output : outputs) {
        if (output.limits == nullptr) continue;
        const LimitResult result = output.limits->apply(elapsed);
        if (!result.any) continue;
        ++simplex.thread_->limits;
        if (result.notFinite) {
            output.safe->write();
            again = true;
        }
        if (!demands) continue;
        reportLimits(*output.limits, task.index, *simplex.thread_->loop);
        if (result.faulting == nullptr) continue;
        simplex.fault(result.notFinite ? DemandNotFinite : DemandOutOfRange,
                      refusal(result, output.target).view());
    }
    if (simplex.pending_.fault) {
        enterFault(task, tick);
        again = true;
    }
    for (TaskOutput& output : outputs) {
        if (output.limits == nullptr) continue;
        if (again && output.limits->apply(elapsed).notFinite) output.limits->restore();
        output.limits->accept();
    }
}

EventText TaskRunner::refusal(const LimitResult& result, std::uint32_t target) const {
    EventText text{result.faulting->name};
    return text << " of " << structure_.simplexes[target].path
                << (result.notFinite ? " was not a number" : " was out of range");
}

// One event for each item whose episode begins.
void TaskRunner::reportLimits(const DemandLimits& limits, std::uint32_t simplex,
                              LoopThread& thread) {
    for (const DemandLimits::Beginning& each : limits.beginnings()) {
        EventText text{each.item->name};
        text << " of " << structure_.simplexes[limits.simplex()].path;
        if (each.notFinite) {
            text << " was not a number";
        } else {
            text << " limited from " << each.value << " to " << each.limit;
            if (!each.item->unit.empty()) text << " " << each.item->unit;
            if (each.byRate) text << " by its rate";
        }
        agent_.post(thread, Severity::Warning, EventKind::Limit, simplex, text);
    }
}

void TaskRunner::arbitrate(Arbiter& arbiter, TaskThread& thread) {
    std::uint32_t active = 0;
    for (std::uint32_t i = 0; i < arbiter.candidates.size(); ++i) {
        if (arbiter.candidates[i].writer->state_ != State::Active) continue;
        if (active++ == 0) arbiter.selected = i;
    }
    Arbiter::Candidate& chosen = arbiter.candidates[arbiter.selected];
    if (active > 1) {
        ++thread.conflicts;
        if (!arbiter.inConflict) {
            EventText text{"several writers are Active; taken is "};
            text << chosen.writer->path();
            agent_.post(*thread.loop, Severity::Warning, EventKind::Conflict, arbiter.target, text);
        }
    }
    arbiter.inConflict = active > 1;
    copySlice(arbiter.sizes, chosen.slice, arbiter.live);
    if (arbiter.limits == nullptr) return;
    const double elapsed = tick_.elapsedSeconds();
    const LimitResult result = arbiter.limits->apply(elapsed);
    if (result.any) ++thread.limits;
    // Events here are the shared simplex's: its writer's own may come from another thread.
    const bool demands = active > 0 && !chosen.writer->safeByLoss_;
    if (demands) reportLimits(*arbiter.limits, arbiter.target, *thread.loop);
    const bool faults = demands && result.faulting != nullptr;
    if (faults) {
        chosen.output->refused = result;
        chosen.writer->pending_.demandRefused = true;
    }
    if (faults || result.notFinite) {
        chosen.output->safe->latch();
        chosen.output->safe->write();
        copySlice(arbiter.sizes, chosen.slice, arbiter.live);
        if (arbiter.limits->apply(elapsed).notFinite) arbiter.limits->restore();
    }
    arbiter.limits->accept();
}

}  // namespace cortex::cs
