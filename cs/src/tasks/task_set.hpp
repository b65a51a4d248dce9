// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "tasks/demands.hpp"
#include "tasks/task_thread.hpp"
#include "tasks/value_checks.hpp"
#include "threads/scheduler.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace cortex::cs {

// Fault codes of the framework; a task's own are its business (docs/writing-a-simplex.md).
enum FaultCode : std::int64_t {
    HookThrew = -1,
    InputLost = -2,
    DemandNotFinite = -3,
    DemandOutOfRange = -4,
    ClusterHalted = -5,
    TransitionTimeout = -6,
    TriggerStopped = -7,
    ThreadEnded = -8
};

// onLoss="hold": the copy of an input that stands while it is lost.
struct HeldInput {
    BlockSizes sizes;
    Slice from, to;
};

// One input relationship of a task.
struct TaskInput {
    const SlotState* state = nullptr;
    std::int64_t maxAge = 0;                    // ns
    const std::int64_t* ownerPeriod = nullptr;  // another agent's: 3 of them are allowed
    const std::uint32_t* linkLosses = nullptr;  // the same: how often its link was lost
    const HeldInput* held = nullptr;
    std::uint32_t seenLosses = 0;  // in the last run of the task
    std::uint32_t target = noSimplex;
    bool ages = false;         // something writes it
    bool fromOutside = false;  // it moves on while this loop stands still
    bool lost = false;
    bool told = false;  // that it is lost
    const Rule* rule = nullptr;
};

// One output relationship to a descriptive simplex.
struct TaskOutput {
    SlotState* state = nullptr;
    SafeDemands* safe = nullptr;     // null: not a demand
    DemandLimits* limits = nullptr;  // null: an arbiter applies them, or not a demand
    ValueChecks* checks = nullptr;   // null: a demand, or nothing that could be wrong
    std::uint32_t target = noSimplex;
    bool standsSafe = false;  // in this run: its safe value, which no hook has moved
    LimitResult refused;      // set by the arbiter: this demand faults its writer
};

// A simplex that several tasks write: takes the candidate of the one that is Active; of several
// with one manager, of the one that became so last.
struct Arbiter {
    struct Candidate {
        SimplexCS* writer;
        Slice slice;
        TaskOutput* output;
        const std::int64_t* stateSince;  // of the writer
    };
    std::uint32_t target = noSimplex;
    BlockSizes sizes;
    Slice live;
    DemandLimits* limits = nullptr;
    std::vector<Candidate> candidates;  // canonical order of the writers
    std::uint32_t selected = 0;
    bool inConflict = false;
};

// What the loop looks at in every cycle: half a cache line a task, in execution order.
struct alignas(32) Task {
    SimplexCS* simplex = nullptr;  // null: an arbiter
    std::uint32_t index = noSimplex;
    std::uint32_t firstInput = 0, inputCount = 0;
    std::uint32_t firstOutput = 0, outputCount = 0;
    bool everyCycle = true;
    bool measures = false;
    // Whether it has demands, and whether they were its hooks' alone when it ran last.
    enum class Demands : std::uint8_t { None, Free, Bound } demands = Demands::None;
    // Whether an observation or an item of its own can be wrong, or was wrong in the cycle before.
    enum class Values : std::uint8_t { Right, ToPass, Wrong } values = Values::Right;
};

// What the values that a task writes are to pass: runs of all of its outputs and of its own items.
struct TaskRuns {
    std::span<const ValueRun<double>> floats;
    std::span<const ValueRun<std::int64_t>> ints;
    std::span<const LabelRun> labels;
    std::span<const TextRun> texts;
};

// The last time for which a device has measured nothing new, but for two of its runs. What follows
// from its own measurements grows old meanwhile by its own doing.
struct Silence {
    std::int64_t since = -1;  // stamp of what it measured last before it; -1: none
    std::int64_t length = 0;  // ns

    std::int64_t of(std::int64_t stamp) const { return stamp <= since ? length : 0; }
};

// What it looks at when something happens, or where a task does not run in every cycle.
struct TaskDetails {
    Arbiter* arbiter = nullptr;
    ValueChecks* checks = nullptr;  // of its own items; null: nothing that could be wrong
    std::uint32_t every = 1, phase = 0;
    std::int64_t lastRun = 0;
    std::int64_t stateSince = 0;
    // Of a task that measures: the last one, and the one before, as what follows from it may be
    // under way still.
    Silence silence, formerSilence;
    bool toldInVain = false;  // in this stay: that what its hooks write does not go out
    Data<std::int64_t> state, faultCode;
    Data<std::string_view> faultText;
    Data<double> taskTime;
};

// The last time that the loop stood still for longer than a few periods.
struct Standstill {
    std::int64_t nominalTime = -1;  // of the cycle after it
    std::int64_t length = 0;        // ns
    std::int64_t end = 0;           // ns of the monotonic clock; 0: none, or the loop is stepped
};

// A demand that nobody writes, as people set it, and the device that takes it.
struct SetPoint {
    std::uint32_t demand = noSimplex;
    const SimplexCS* device = nullptr;
};

// The tasks of a cluster, and what they read and write. Built once by start().
struct TaskSet {
    TaskSet(AgentRuntime& runtime, const Schedule& schedule, std::int64_t nominalPeriod);
    TaskSet(const TaskSet&) = delete;
    TaskSet& operator=(const TaskSet&) = delete;

    TaskDetails& detailsOf(const Task& task) {
        return details[static_cast<std::size_t>(&task - tasks.data())];
    }
    std::span<TaskInput> inputsOf(const Task& task) {
        return {inputs.data() + task.firstInput, task.inputCount};
    }
    std::span<TaskOutput> outputsOf(const Task& task) {
        return {outputs.data() + task.firstOutput, task.outputCount};
    }

    AgentRuntime& agent;
    const Structure& structure;
    SlotState* states;  // by simplex
    std::int64_t period;
    Standstill standstill;
    std::vector<Task> tasks;           // in execution order
    std::vector<TaskDetails> details;  // of the same tasks
    std::vector<TaskInput> inputs;
    std::vector<TaskOutput> outputs;
    std::vector<std::unique_ptr<HeldInput>> held;
    std::vector<std::unique_ptr<SafeDemands>> safe;
    std::vector<std::unique_ptr<DemandLimits>> limits;
    std::vector<std::unique_ptr<ValueChecks>> checks;
    ValueRuns runs;
    std::vector<TaskRuns> runsOf;  // of the same tasks
    std::vector<std::unique_ptr<Arbiter>> arbiters;
    std::vector<SetPoint> setPoints;
    std::vector<TaskThread> threads;
};

}  // namespace cortex::cs
