// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tasks/task_set.hpp"

namespace cortex::cs {

// What tasks observe and show of themselves: a value that is no number makes its simplex bad, one
// out of its range is told. Neither is changed.
class TaskValues {
public:
    explicit TaskValues(TaskSet& set) : set_{set} {}

    // After a task, when its outputs have their quality.
    void check(Task& task) CORTEX_REALTIME {
        if (task.values == Task::Values::Wrong || !pass(task)) {
            task.values = examine(task) ? Task::Values::Wrong : Task::Values::ToPass;
        }
    }

private:
    // Nearly always: every value is as it should be.
    bool pass(const Task& task) const CORTEX_REALTIME {
        const TaskRuns& runs = set_.runsOf[static_cast<std::size_t>(&task - set_.tasks.data())];
        for (const auto& run : runs.floats) {
            if (!run.passes()) return false;
        }
        for (const auto& run : runs.ints) {
            if (!run.passes()) return false;
        }
        for (const auto& run : runs.labels) {
            if (!run.passes()) return false;
        }
        for (const auto& run : runs.texts) {
            if (!run.passes()) return false;
        }
        return true;
    }
    // True: a value is wrong.
    bool examine(const Task& task) CORTEX_REALTIME;
    bool examine(const Task& task, ValueChecks& checks, SlotState& state) CORTEX_REALTIME;
    void report(const ValueChecks& checks, const ValueChecks::Change& each, const Task& task)
        CORTEX_REALTIME;

    TaskSet& set_;
};

}  // namespace cortex::cs
