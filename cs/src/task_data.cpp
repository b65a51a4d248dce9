// SPDX-License-Identifier: Apache-2.0
// What the framework does with a task's inputs before its hooks and with its outputs after them:
// loss, quality and stamps, limits, arbitration between writers.
#include "task_runner.hpp"

#include <algorithm>

namespace cortex::cs {

namespace {

// Worst quality with its first cause, oldest stamp.
void merge(SlotState& sum, const SlotState& state, Quality quality, bool ages) {
    if (quality > sum.quality) {
        sum.quality = quality;
        sum.cause = state.cause;
    }
    if (ages && state.time < sum.time) {
        sum.time = state.time;
        sum.cycle = state.cycle;
    }
}

}  // namespace

SlotState TaskRunner::readInputs(Task& task, const Tick& tick) {
    SlotState sum{tick.cycle, tick.nominalTime, noSimplex, Quality::Good};
    bool safe = false;
    for (std::uint32_t i = 0; i < task.inputCount; ++i) {
        TaskInput& input = inputs_[task.firstInput + i];
        const bool tooOld = input.ages && tick.nominalTime - input.state->time > input.maxAge;
        const bool lost = input.state->quality >= Quality::Bad || tooOld;
        const bool faults =
            lost && input.rule->onLoss == OnLoss::Fault && task.simplex->state_ == State::Active;
        if (lost != input.lost || faults) {
            input.lost = lost;
            inputLost(task, input, tick);
        }
        if (input.held != nullptr) {
            if (!lost)
                copySlice(*input.held, input.heldFrom, input.heldTo);
            else
                input.heldTo.state->quality = std::max(input.heldTo.state->quality, Quality::Stale);
            merge(sum, *input.heldTo.state, input.heldTo.state->quality, input.ages);
            continue;
        }
        merge(sum, *input.state,
              tooOld ? std::max(input.state->quality, Quality::Stale) : input.state->quality,
              input.ages);
        safe = safe || (lost && input.rule->onLoss == OnLoss::Safe);
    }
    if (safe && !task.simplex->safeByLoss_) latchSafe(task);
    task.simplex->safeByLoss_ = safe;
    return sum;
}

// An input was lost, or is back.
void TaskRunner::inputLost(Task& task, TaskInput& input, const Tick& tick) {
    SimplexCS& simplex = *task.simplex;
    EventText text{input.rule->name};
    text << " " << structure_.simplexes[input.target].path;
    if (!input.lost) {
        text << " is back";
        agent_.post(*simplex.thread_, Severity::Info, EventKind::Message, task.index, text);
        return;
    }
    if (input.state->quality >= Quality::Bad) {
        text << " is " << name(input.state->quality);
        const std::uint32_t cause = input.state->cause;
        if (cause < structure_.simplexes.size()) {
            text << ", first cause " << structure_.simplexes[cause].path;
        }
    } else {
        text << " is " << static_cast<double>(tick.nominalTime - input.state->time) * 1e-6
             << " ms old, allowed " << static_cast<double>(input.maxAge) * 1e-6;
    }
    if (input.rule->onLoss == OnLoss::Fault && simplex.state_ == State::Active) {
        simplex.fault(InputLost, text.view());
    } else {
        text << "; " << name(input.rule->onLoss);
        agent_.post(*simplex.thread_, Severity::Warning, EventKind::Message, task.index, text);
    }
}

void TaskRunner::finish(Task& task, const Tick& tick, SlotState state, Worker& worker) {
    SimplexCS& simplex = *task.simplex;
    for (std::uint32_t i = 0; i < task.outputCount; ++i) {
        TaskOutput& output = outputs_[task.firstOutput + i];
        if (output.limits != nullptr) limit(task, tick, output, worker);
    }
    if (task.measures)
        state = {tick.cycle, tick.nominalTime, noSimplex, Quality::Good};
    else if (simplex.state_ == State::Fault && state.quality < Quality::Bad) {
        state.quality = Quality::Bad;
        state.cause = task.index;
    } else if (simplex.state_ != State::Active && state.quality < Quality::Stale) {
        state.quality = Quality::Stale;
        state.cause = task.index;
    }
    if (simplex.qualitySet_) {
        state.quality = simplex.quality_;
        state.time = simplex.measuredAt_;
        state.cause = simplex.quality_ == Quality::Good ? noSimplex : task.index;
    }
    *task.own = state;
    for (std::uint32_t i = 0; i < task.outputCount; ++i) {
        *outputs_[task.firstOutput + i].state = state;
    }
}

void TaskRunner::limit(Task& task, const Tick& tick, TaskOutput& output, Worker& worker) {
    SimplexCS& simplex = *task.simplex;
    const double elapsed = tick.elapsedSeconds();
    LimitResult result = output.limits->apply(elapsed);
    if (result.item == nullptr) return;
    ++worker.counts.limits;
    if (simplex.state_ == State::Active && !simplex.safeByLoss_) {
        reportLimit(result, output.target, task.index, *simplex.thread_);
        if (result.faults) {
            EventText text{result.item->name};
            text << " of " << structure_.simplexes[output.target].path
                 << (result.notFinite ? " was not a number" : " was out of range");
            simplex.fault(result.notFinite ? DemandNotFinite : DemandOutOfRange, text.view());
            enterFault(task, tick);
        }
    }
    if (!result.notFinite) return;
    output.safe->write();
    if (output.limits->apply(elapsed).notFinite) output.limits->restorePrevious();
}

void TaskRunner::reportLimit(const LimitResult& result, std::uint32_t target, std::uint32_t writer,
                             LoopThread& thread) {
    if (!result.isNew) return;
    EventText text{result.item->name};
    text << " of " << structure_.simplexes[target].path;
    if (result.notFinite)
        text << " was not a number";
    else
        text << " limited from " << result.value << " to " << result.limit;
    if (!result.item->unit.empty() && !result.notFinite) text << " " << result.item->unit;
    agent_.post(thread, Severity::Warning, EventKind::Limit, writer, text);
}

void TaskRunner::arbitrate(Task& task, Worker& worker, LoopThread& thread) {
    Arbiter& arbiter = *task.arbiter;
    std::uint32_t active = 0;
    for (std::uint32_t i = 0; i < arbiter.candidates.size(); ++i) {
        if (arbiter.candidates[i].writer->state_ != State::Active) continue;
        if (active++ == 0) arbiter.selected = i;
    }
    Arbiter::Candidate& chosen = arbiter.candidates[arbiter.selected];
    if (active > 1) {
        ++worker.counts.conflicts;
        if (!arbiter.inConflict) {
            EventText text{"several writers are Active; taken is "};
            text << chosen.writer->path();
            agent_.post(thread, Severity::Warning, EventKind::Conflict, task.index, text);
        }
    }
    arbiter.inConflict = active > 1;
    copySlice(arbiter.sizes, chosen.slice, arbiter.live);
    if (arbiter.limits == nullptr) return;
    const double elapsed = static_cast<double>(cycleElapsed_) * 1e-9;
    const LimitResult result = arbiter.limits->apply(elapsed);
    if (result.item == nullptr) return;
    ++worker.counts.limits;
    if (active > 0 && !chosen.writer->safeByLoss_) {
        reportLimit(result, task.index, chosen.writer->index(), thread);
        if (result.faults) chosen.output->refused = result.item;
    }
    if (!result.notFinite) return;
    chosen.output->safe->latch();
    chosen.output->safe->write();
    copySlice(arbiter.sizes, chosen.slice, arbiter.live);
    if (arbiter.limits->apply(elapsed).notFinite) arbiter.limits->restorePrevious();
}

}  // namespace cortex::cs
