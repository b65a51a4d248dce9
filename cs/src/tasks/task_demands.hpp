// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tasks/task_set.hpp"

namespace cortex::cs {

// What tasks demand: limits, safe values, and the choice among several writers of one simplex.
class TaskDemands {
public:
    explicit TaskDemands(TaskSet& set) : set_{set} {}

    // Limits each demand that this task alone writes. What is not a number becomes safe, and what
    // faults its writer is a fault of the simplex. True: accept() has to limit once more.
    bool limit(Task& task, const Tick& tick) CORTEX_REALTIME;
    // No demand moves further than its rate allows, safe or not; then it goes out.
    void accept(Task& task, const Tick& tick, bool again) CORTEX_REALTIME;
    // Takes the candidate of the writer that is Active.
    void arbitrate(Arbiter& arbiter, const Tick& tick, TaskThread& thread) CORTEX_REALTIME;
    // A fault of the simplex for each demand that an arbiter refused in the cycle before.
    void faultForRefused(Task& task) CORTEX_REALTIME;

    void latchSafe(Task& task) CORTEX_REALTIME {
        for (const TaskOutput& output : set_.outputsOf(task)) {
            if (output.safe != nullptr) output.safe->latch();
        }
    }
    void writeSafe(Task& task) CORTEX_REALTIME {
        for (const TaskOutput& output : set_.outputsOf(task)) {
            if (output.safe != nullptr) output.safe->write();
        }
    }

private:
    EventText refusal(const LimitResult& result, std::uint32_t target) const CORTEX_REALTIME;
    void reportLimits(const DemandLimits& limits, std::uint32_t simplex, LoopThread& thread)
        CORTEX_REALTIME;

    TaskSet& set_;
};

}  // namespace cortex::cs
