// SPDX-License-Identifier: Apache-2.0
#include "tasks/task_inputs.hpp"

#include "tasks/state_machine.hpp"

#include <algorithm>
#include <utility>

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

// ns. What comes over a network ages while this cycle was late to wake up, too. What followed from
// the last measurement of a device before it was silent cannot be younger than that.
std::int64_t ageOf(const TaskInput& input, const Tick& tick, const TaskDetails* device) {
    const std::int64_t late = input.ownerPeriod != nullptr ? tick.lateness : 0;
    const std::int64_t stamp = input.state->time;
    const std::int64_t age = tick.nominalTime + late - stamp;
    return device == nullptr ? age
                             : age - device->silence.of(stamp) - device->formerSilence.of(stamp);
}

// In tenths, rounded up.
double milliseconds(std::int64_t time) {
    constexpr std::int64_t tenth = 100'000;
    const std::int64_t tenths = (time + tenth - 1) / tenth;
    return static_cast<double>(tenths) / 10;
}

// What was not followed for so long may have moved anywhere, and another start of its agent knows
// nothing of what was before: it is lost for one run of the task, however fresh it looks.
bool movedOnUnseen(TaskInput& input, std::int64_t stoodStill) {
    const bool isAnew = input.linkLosses != nullptr &&
                        std::exchange(input.seenLosses, *input.linkLosses) != *input.linkLosses;
    return isAnew || (stoodStill > input.maxAge && input.fromOutside);
}

}  // namespace

// The rare case of an input: lost, back, aged, held, or not good.
SlotState TaskInputs::readUnusual(Task& task, TaskInput& input, Seen now) {
    const bool tooOld = now.age > input.maxAge || now.isUnseen;
    const bool lost = input.state->quality >= Quality::Bad || tooOld;
    const bool faults =
        lost && input.rule->onLoss == OnLoss::Fault && task.simplex->state_ == State::Active;
    if (lost != input.lost || faults) {
        input.lost = lost;
        lossChanged(task, input, now);
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

// A device that answers late or not at all, and one whose loop stood still, has nothing new.
void TaskInputs::noteSilence(const Task& task, const Tick& tick) {
    TaskDetails& details = set_.detailsOf(task);
    const std::int64_t measured = set_.states[task.index].time;
    const std::int64_t usual = 2 * set_.period * std::int64_t{details.every};
    const std::int64_t length = tick.nominalTime - measured - usual;
    if (length <= 0) return;
    const std::int64_t since = measured + set_.period;
    if (details.silence.since != since) {
        Silence& former = details.formerSilence = details.silence;
        const std::int64_t before = std::max<std::int64_t>(since - former.since, 0);
        former.length = std::min(former.length, before);  // the new one covers the rest
    }
    details.silence = {since, length};
}

SlotState TaskInputs::read(Task& task, const Tick& tick) {
    SlotState sum{tick.cycle, tick.nominalTime, noSimplex, Quality::Good};
    bool anyLost = false;
    const TaskInput* missed = nullptr;  // the first without which it is safe
    const bool stood = set_.standstill.nominalTime > tick.nominalTime - tick.passed;
    const std::int64_t stoodStill = stood ? set_.standstill.length : 0;
    const TaskDetails* const device = task.measures ? &set_.detailsOf(task) : nullptr;
    for (TaskInput& input : set_.inputsOf(task)) {
        if (input.ownerPeriod != nullptr) {
            input.maxAge = std::max(input.maxAge, 3 * *input.ownerPeriod);
        }
        const Seen now{input.ages ? ageOf(input, tick, device) : 0, stoodStill,
                       movedOnUnseen(input, stoodStill)};
        if (now.age <= input.maxAge && !now.isUnseen && !input.lost && input.held == nullptr &&
            input.state->quality == Quality::Good) {
            merge(sum, *input.state, input.ages);
            continue;
        }
        merge(sum, readUnusual(task, input, now), input.ages);
        anyLost = anyLost || input.lost;
        if (missed == nullptr && input.lost && input.rule->onLoss == OnLoss::Safe) missed = &input;
    }
    SimplexCS& simplex = *task.simplex;
    simplex.inputLost_ = anyLost;
    if (missed != nullptr || simplex.safeByLoss_)
        settleSafety(task, isResting(simplex.state_) ? nullptr : missed);
    return sum;
}

// `missed`: a lost input without which the simplex is safe; null: there is none now.
void TaskInputs::settleSafety(Task& task, const TaskInput* missed) {
    SimplexCS& simplex = *task.simplex;
    const bool safe = missed != nullptr;
    if (safe == simplex.safeByLoss_) return;
    simplex.safeByLoss_ = safe;
    if (!safe) return set_.agent.regainInput(task.index);
    demands_.latchSafe(task, SafeDemands::Latch::Stop);
    demands_.writeSafe(task);
    EventText why{"its input "};
    why << missed->rule->name << " from " << set_.structure.simplexes[missed->target].path
        << " is lost";
    set_.agent.loseInput(task.index, *simplex.thread_->loop, why);
}

// An input was lost, or is back.
void TaskInputs::lossChanged(Task& task, TaskInput& input, Seen now) {
    SimplexCS& simplex = *task.simplex;
    EventText text{"input "};
    text << input.rule->name << " from " << set_.structure.simplexes[input.target].path;
    if (!input.lost) {
        if (!std::exchange(input.told, false)) return;
        text << " is back";
        set_.agent.post(*simplex.thread_->loop, Severity::Info, EventKind::Loss, task.index, text);
        return;
    }
    if (input.state->quality >= Quality::Bad) {
        text << " is " << name(input.state->quality);
        const std::uint32_t cause = input.state->cause;
        if (cause < set_.structure.simplexes.size()) {
            text << ", first cause " << set_.structure.simplexes[cause].path;
        }
    } else if (now.age > input.maxAge || now.stoodStill > input.maxAge) {
        if (now.age > input.maxAge)
            text << " is " << milliseconds(now.age) << " ms old";
        else
            text << " was not followed for " << milliseconds(now.stoodStill)
                 << " ms, as the loop stood still";
        text << ", allowed " << milliseconds(input.maxAge) << " ms";
    } else {
        text << " was linked anew";
    }
    const bool faults = input.rule->onLoss == OnLoss::Fault && simplex.state_ == State::Active;
    // What follows from a simplex of another agent that has never been there is no loss.
    input.told = faults || !set_.agent.neverLinked(input.state->cause);
    if (!input.told) return;
    if (faults) {
        simplex.enterFault(InputLost, text.view());
    } else {
        text << "; reaction: " << name(input.rule->onLoss);
        set_.agent.post(*simplex.thread_->loop, Severity::Warning, EventKind::Loss, task.index,
                        text);
    }
}

}  // namespace cortex::cs
