// SPDX-License-Identifier: Apache-2.0
#include "tasks/task_demands.hpp"

namespace cortex::cs {

bool TaskDemands::limit(Task& task, const Tick& tick) {
    SimplexCS& simplex = *task.simplex;
    const double elapsed = tick.elapsedSeconds();
    const bool demands = simplex.state_ == State::Active && !simplex.safeByLoss_;
    bool again = false;
    for (TaskOutput& output : set_.outputsOf(task)) {
        if (output.limits == nullptr) continue;
        const LimitResult result = output.limits->apply(elapsed);
        if (!result.any) continue;
        if (result.limited) ++simplex.thread_->limits;
        if (result.notFinite) {
            output.safe->write();
            again = true;
        }
        if (!demands) continue;
        reportLimits(*output.limits, task.index, *simplex.thread_->loop);
        if (result.faulting == nullptr) continue;
        simplex.enterFault(result.notFinite ? DemandNotFinite : DemandOutOfRange,
                           refusal(result, output.target).view());
    }
    return again;
}

void TaskDemands::accept(Task& task, const Tick& tick, bool again) {
    for (TaskOutput& output : set_.outputsOf(task)) {
        if (output.limits == nullptr) continue;
        if (again && output.limits->apply(tick.elapsedSeconds()).notFinite)
            output.limits->restore();
        output.limits->accept();
    }
}

void TaskDemands::faultForRefused(Task& task) {
    for (TaskOutput& output : set_.outputsOf(task)) {
        if (output.refused.faulting == nullptr) continue;
        task.simplex->enterFault(output.refused.notFinite ? DemandNotFinite : DemandOutOfRange,
                                 refusal(output.refused, output.target).view());
        output.refused = {};
    }
}

EventText TaskDemands::refusal(const LimitResult& result, std::uint32_t target) const {
    EventText text{result.faulting->name};
    return text << " of " << set_.structure.simplexes[target].path
                << (result.notFinite ? " was not a number" : " was out of range");
}

// One event for each item whose episode begins.
void TaskDemands::reportLimits(const DemandLimits& limits, std::uint32_t simplex,
                               LoopThread& thread) {
    for (const DemandLimits::Beginning& each : limits.beginnings()) {
        EventText text{each.item->name};
        text << " of " << set_.structure.simplexes[limits.simplex()].path;
        if (each.notFinite) {
            text << " was not a number";
        } else {
            text << " limited from " << each.value << " to " << each.limit;
            if (!each.item->unit.empty()) text << " " << each.item->unit;
            if (each.byRate) text << " by its rate";
        }
        set_.agent.post(thread, Severity::Warning, EventKind::Limit, simplex, text);
    }
}

void TaskDemands::arbitrate(Arbiter& arbiter, const Tick& tick, TaskThread& thread) {
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
            set_.agent.post(*thread.loop, Severity::Warning, EventKind::Conflict, arbiter.target,
                            text);
        }
    }
    arbiter.inConflict = active > 1;
    copySlice(arbiter.sizes, chosen.slice, arbiter.live);
    if (arbiter.limits == nullptr) return;
    const double elapsed = tick.elapsedSeconds();
    const LimitResult result = arbiter.limits->apply(elapsed);
    if (result.limited) ++thread.limits;
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
