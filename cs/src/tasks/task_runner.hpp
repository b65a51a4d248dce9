// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tasks/crash_report.hpp"
#include "tasks/hook.hpp"
#include "tasks/task_demands.hpp"
#include "tasks/task_inputs.hpp"
#include "tasks/task_set.hpp"
#include "tasks/task_states.hpp"
#include "tasks/task_values.hpp"
#include "threads/scheduler.hpp"

#include <cstdint>
#include <memory>
#include <span>

namespace cortex::cs {

struct RunnerCounts {
    std::uint64_t limits = 0, conflicts = 0, startups = 0;
};

// Runs tasks: commands, hooks, and around them states, inputs and demands. Built once by start();
// run() is called for each chunk of the schedule on the loop's threads.
class TaskRunner {
public:
    // `schedule` stays as long as it is used.
    TaskRunner(AgentRuntime& agent, const Schedule& schedule, std::int64_t period);

    // Loop thread, before the chunks of a cycle. `next`: when the loop's next one is due, ns of the
    // monotonic clock; 0: not known.
    void beginCycle(const Tick& tick, std::int64_t next = 0) CORTEX_REALTIME;
    void run(std::uint32_t chunk, std::uint32_t worker) CORTEX_REALTIME;
    // One task, by its place in the execution order, for measurements that order them otherwise
    // (without delayed commands: the clock of the thread stays as it is).
    void runAlone(std::uint32_t task, std::uint32_t worker) CORTEX_REALTIME {
        runTask(set_.tasks[task], set_.threads[worker], positions_[worker]);
    }

    // Between cycles: other chunks of the same tasks in the same order.
    void use(const Schedule& schedule) CORTEX_REALTIME { chunks_ = schedule.chunks; }

    TaskStates& states() { return states_; }
    const TaskDemands& demands() const { return demands_; }
    const Position& position(std::uint32_t worker) const { return positions_[worker]; }
    Escape& escape(std::uint32_t worker) { return escapes_[worker]; }
    RunnerCounts counts() const;
    // Of the last cycle. Small sets of tasks are timed whole, of others a few a cycle in turn,
    // however they are cut into chunks.
    LongestTask longest() const CORTEX_REALTIME;
    // Whether it was each task's turn to be timed at least once.
    bool timedAll() const { return timedAll_; }

private:
    void runTasks(std::uint32_t from, std::uint32_t end, std::uint32_t worker) CORTEX_REALTIME;
    // After an exit() in a hook: that task ends in Fault. Returns the place of the next one.
    std::uint32_t endEscaped(std::uint32_t from, std::uint32_t end, std::uint32_t worker);
    void endTask(Task& task, SimplexCS& simplex, const Tick& tick) CORTEX_REALTIME;
    void noteStandstill(const Tick& tick) CORTEX_REALTIME;
    // False: it is not its turn, or nobody's task.
    bool runTask(Task& task, TaskThread& thread, Position& position) CORTEX_REALTIME;
    bool runAtTimes(Task& task, TaskThread& thread, Position& position) CORTEX_REALTIME;
    void runSimplex(Task& task, const Tick& tick, TaskThread& thread, Position& position)
        CORTEX_REALTIME;
    void runTimed(Task& task, TaskThread& thread, Position& position) CORTEX_REALTIME;
    void runHooks(Task& task, SimplexCS& simplex, const Tick& tick, Position& position)
        CORTEX_REALTIME;
    static void runPassing(SimplexCS& simplex, const Tick& tick, Position& position)
        CORTEX_REALTIME;
    void finishDemands(Task& task, const Tick& tick) CORTEX_REALTIME;

    TaskSet set_;
    TaskDemands demands_;
    TaskInputs inputs_;
    TaskStates states_;
    TaskValues values_;
    std::span<const Chunk> chunks_;
    std::unique_ptr<Position[]> positions_;
    std::unique_ptr<Escape[]> escapes_;
    Tick tick_;
    const std::uint32_t timed_;     // so many tasks in a cycle
    std::uint32_t firstTimed_ = 0;  // in the order of execution
    bool timedAll_ = false;
    std::int64_t lastBegin_ = 0;  // of a cycle, ns; 0: there was none
};

}  // namespace cortex::cs
