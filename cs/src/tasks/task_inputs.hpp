// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tasks/task_demands.hpp"
#include "tasks/task_set.hpp"

namespace cortex::cs {

// What tasks read: loss, age, held copies, and the quality and stamp that follow from it.
class TaskInputs {
public:
    TaskInputs(TaskSet& set, TaskDemands& demands) : set_{set}, demands_{demands} {}

    // Of a device, before its own stamp is that of this run.
    void noteSilence(const Task& task, const Tick& tick) CORTEX_REALTIME;
    // Before the hooks: worst quality and oldest stamp of all inputs.
    SlotState read(Task& task, const Tick& tick) CORTEX_REALTIME;
    // After them: what its own state, and what the task set itself, make of the quality of inputs.
    static void settleQuality(SlotState& state, const Task& task, const SimplexCS& simplex,
                              const Tick& tick) CORTEX_REALTIME {
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

private:
    // Of an input, in this run of the task; times in ns.
    struct Seen {
        std::int64_t age;         // 0: nothing writes it
        std::int64_t stoodStill;  // the loop, before this run
        bool isUnseen;            // it may have moved anywhere meanwhile
    };
    SlotState readUnusual(Task& task, TaskInput& input, Seen now) CORTEX_REALTIME;
    void lossChanged(Task& task, TaskInput& input, Seen now) CORTEX_REALTIME;
    void settleSafety(Task& task, const TaskInput* missed) CORTEX_REALTIME;

    TaskSet& set_;
    TaskDemands& demands_;
};

}  // namespace cortex::cs
