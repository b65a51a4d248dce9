// SPDX-License-Identifier: Apache-2.0
#include "tasks/task_demands.hpp"

#include "tasks/state_machine.hpp"

#include <algorithm>

namespace cortex::cs {

namespace {

// Calls `see` for each demand as it goes out: of several writers, that of the one taken last.
template <class See>
void eachThatGoesOut(const TaskSet& set, See see) {
    for (const TaskOutput& output : set.outputs) {
        if (output.limits != nullptr) see(output, *output.limits);
    }
    for (const auto& arbiter : set.arbiters) {
        if (arbiter->limits == nullptr) continue;
        see(*arbiter->candidates[arbiter->selected].output, *arbiter->limits);
    }
}

}  // namespace

bool TaskDemands::limit(Task& task, const Tick& tick) {
    SimplexCS& simplex = *task.simplex;
    const double elapsed = tick.elapsedSeconds();
    bool again = false;
    for (TaskOutput& output : set_.outputsOf(task)) {
        if (output.limits == nullptr) continue;
        const LimitResult result = output.limits->apply(elapsed);
        if (!result.any && output.limits->beginnings().empty()) continue;
        if (result.notFinite) {
            output.safe->write();
            again = true;
        }
        reportLimits(*output.limits, task.index, output.standsSafe, *simplex.thread_->loop);
        if (output.standsSafe) continue;
        if (result.limited) ++simplex.thread_->limits;
        if (result.faulting == nullptr) continue;
        simplex.enterFault(result.notFinite ? DemandNotFinite : DemandOutOfRange,
                           refusal(result, output.target).view());
    }
    return again;
}

void TaskDemands::settle(Task& task, const Tick& tick, bool bound) {
    const SimplexCS& simplex = *task.simplex;
    const bool rests = isResting(simplex.state_);
    task.demands = bound ? Task::Demands::Bound : Task::Demands::Free;
    for (TaskOutput& output : set_.outputsOf(task)) {
        if (output.safe == nullptr) continue;
        if (rests) tellInVain(task, output, "a hook or handler");
        if (rests || simplex.safeByLoss_) {
            output.safe->slow(tick.elapsedSeconds());
            output.safe->hold();
            output.standsSafe = true;
        } else {
            output.standsSafe = bound && !output.safe->moved();
        }
    }
}

void TaskDemands::tellHandlersInVain(Task& task) {
    if (!isResting(task.simplex->state_)) return;
    for (const TaskOutput& output : set_.outputsOf(task)) {
        if (output.safe != nullptr) tellInVain(task, output, "a handler");
    }
}

// Once a stay in the state.
void TaskDemands::tellInVain(Task& task, const TaskOutput& output, std::string_view who) {
    bool& told = set_.detailsOf(task).toldInVain;
    const DataItem* item = told ? nullptr : output.safe->writtenInVain(output.limits != nullptr);
    if (item == nullptr) return;
    told = true;
    EventText text{"what "};
    text << who << " wrote to " << item->name << " of "
         << set_.structure.simplexes[output.target].path << " does not go out: in "
         << name(task.simplex->state_) << " it is its safe value";
    if (who == "a handler") text << "; atRest=\"writer\" frees it";
    set_.agent.post(*task.simplex->thread_->loop, Severity::Warning, EventKind::Message, task.index,
                    text);
}

void TaskDemands::accept(Task& task, const Tick& tick, bool again) {
    for (TaskOutput& output : set_.outputsOf(task)) {
        if (output.limits == nullptr) continue;
        if (again && output.limits->apply(tick.elapsedSeconds()).notFinite)
            output.limits->restore();
        output.limits->accept();
    }
}

bool TaskDemands::anyOnTheWay() const {
    bool any = false;
    eachThatGoesOut(set_, [&any](const TaskOutput& output, const DemandLimits& limits) {
        any = any || (!limits.stands() && output.safe->onTheWay().has_value());
    });
    return any;
}

std::vector<TaskDemands::OnTheWay> TaskDemands::onTheWay() const {
    std::vector<OnTheWay> all;
    eachThatGoesOut(set_, [&all](const TaskOutput& output, const DemandLimits& limits) {
        const auto way = output.safe->onTheWay();
        const std::uint32_t away = limits.stands() ? limits.taker() : noSimplex;
        if (way || limits.changedUnseen()) all.push_back({output.target, way, away});
    });
    std::ranges::sort(all, {}, &OnTheWay::simplex);
    return all;
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

// One event for each item whose episode begins. A safe value that is limited is on its way, which
// is none; a step that nobody took is one all the same.
void TaskDemands::reportLimits(const DemandLimits& limits, std::uint32_t simplex, bool isSafe,
                               LoopThread& thread) {
    for (const DemandLimits::Beginning& each : limits.beginnings()) {
        if (isSafe && !each.unseen) continue;
        EventText text{each.item->name};
        text << " of " << set_.structure.simplexes[limits.simplex()].path;
        if (each.unseen) {
            text << " went from ";
            text.apart(each.value, each.limit) << " to ";
            text.apart(each.limit, each.value);
            if (!each.item->unit.empty()) text << " " << each.item->unit;
            text << " while " << set_.structure.simplexes[limits.taker()].path
                 << " was not connected";
        } else if (each.notFinite) {
            text << " was not a number";
        } else if (each.noLabel) {
            text << " was " << each.value << ", none of its labels; " << each.limit << " stays";
        } else {
            text << " limited from ";
            text.apart(each.value, each.limit) << " to ";
            text.apart(each.limit, each.value);
            if (!each.item->unit.empty()) text << " " << each.item->unit;
            if (each.byRate) text << " by its rate";
        }
        set_.agent.post(thread, Severity::Warning, EventKind::Limit, simplex, text);
    }
}

// Whether several are Active that nobody hands over.
bool TaskDemands::choose(Arbiter& arbiter) {
    std::uint32_t active = 0, first = 0, last = 0, manager = noSimplex;
    bool managed = true;
    for (std::uint32_t i = 0; i < arbiter.candidates.size(); ++i) {
        const Arbiter::Candidate& each = arbiter.candidates[i];
        if (each.writer->state_ != State::Active) continue;
        if (active++ == 0) {
            first = last = i;
            manager = each.writer->manager_;
            continue;
        }
        managed = managed && manager != noSimplex && each.writer->manager_ == manager;
        if (*each.stateSince > *arbiter.candidates[last].stateSince) last = i;
    }
    if (active > 0) arbiter.selected = managed ? last : first;
    return active > 1 && !managed;
}

void TaskDemands::arbitrate(Arbiter& arbiter, const Tick& tick, TaskThread& thread) {
    const bool conflict = choose(arbiter);
    Arbiter::Candidate& chosen = arbiter.candidates[arbiter.selected];
    if (conflict) {
        ++thread.conflicts;
        if (!arbiter.inConflict) {
            EventText text{"several writers are Active; taken is "};
            text << chosen.writer->path();
            set_.agent.post(*thread.loop, Severity::Warning, EventKind::Conflict, arbiter.target,
                            text);
        }
    }
    arbiter.inConflict = conflict;
    const double elapsed = tick.elapsedSeconds();
    if (chosen.output->standsSafe && chosen.output->safe->stops()) {
        chosen.output->safe->put(elapsed);  // its writer may run in fewer cycles
    }
    copySlice(arbiter.sizes, chosen.slice, arbiter.live);
    if (arbiter.limits == nullptr) return;
    const LimitResult result = arbiter.limits->apply(elapsed);
    // Events here are the shared simplex's: its writer's own may come from another thread.
    const bool demands = !chosen.output->standsSafe;
    if (demands && result.limited) ++thread.limits;
    reportLimits(*arbiter.limits, arbiter.target, !demands, *thread.loop);
    const bool faults = demands && result.faulting != nullptr;
    if (faults) {
        chosen.output->refused = result;
        chosen.writer->pending_.demandRefused = true;
    }
    if (faults || result.notFinite) {
        chosen.output->safe->latch(SafeDemands::Latch::Stop);
        chosen.output->safe->slow(elapsed);
        chosen.output->safe->write();
        copySlice(arbiter.sizes, chosen.slice, arbiter.live);
        *arbiter.live.state = ofSafeDemand(chosen.writer->index(), tick);
        if (arbiter.limits->apply(elapsed).notFinite) arbiter.limits->restore();
    }
    arbiter.limits->accept();
}

}  // namespace cortex::cs
