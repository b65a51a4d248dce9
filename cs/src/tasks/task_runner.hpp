// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "tasks/demands.hpp"
#include "tasks/task_thread.hpp"
#include "threads/scheduler.hpp"

#include <atomic>
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
    TransitionTimeout = -6
};

enum class Hook : std::uint8_t {
    None,
    Commands,
    LoopStart,
    Standby,
    StartingUp,
    Active,
    ShuttingDown,
    Fault,
    LoopEnd
};
const char* name(Hook hook);

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
    const HeldInput* held = nullptr;
    std::uint32_t target = noSimplex;
    bool ages = false;  // something writes it
    bool lost = false;
    const Rule* rule = nullptr;
};

// One output relationship to a descriptive simplex.
struct TaskOutput {
    SlotState* state = nullptr;
    SafeDemands* safe = nullptr;     // null: not a demand
    DemandLimits* limits = nullptr;  // null: an arbiter applies them, or not a demand
    std::uint32_t target = noSimplex;
    LimitResult refused;  // set by the arbiter: this demand faults its writer
};

// A simplex that several tasks write: takes the candidate of the one that is Active.
struct Arbiter {
    struct Candidate {
        SimplexCS* writer;
        Slice slice;
        TaskOutput* output;
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
    bool limits = false;  // an output of its own has limits
};

// What it looks at when something happens, or where a task does not run in every cycle.
struct TaskDetails {
    Arbiter* arbiter = nullptr;
    std::uint32_t every = 1, phase = 0;
    std::int64_t lastRun = 0;
    std::int64_t stateSince = 0;
    Data<std::int64_t> state, faultCode;
    Data<std::string_view> faultText;
    Data<double> taskTime;
};

// What a loop thread is doing now, for the watchdog.
struct alignas(64) Position {
    std::atomic<std::uint32_t> simplex{noSimplex};
    std::atomic<Hook> hook{Hook::None};
};

struct RunnerCounts {
    std::uint64_t limits = 0, conflicts = 0, startups = 0;
};

// Executes tasks: commands, hooks, state machine, then quality, stamps, limits and safe demands.
// Built once by start(); run() is called for each chunk of the schedule on the loop's threads.
class TaskRunner {
public:
    // `schedule` stays as long as it is used.
    TaskRunner(AgentRuntime& agent, const Schedule& schedule, std::int64_t period);

    // Loop thread, before the chunks of a cycle.
    void beginCycle(const Tick& tick) CORTEX_REALTIME;
    void run(std::uint32_t chunk, std::uint32_t worker) CORTEX_REALTIME;
    // One task, by its place in the execution order, for who orders them otherwise (measurements,
    // without delayed commands: the clock of the thread stays as it is).
    void runAlone(std::uint32_t task, std::uint32_t worker) CORTEX_REALTIME {
        runTask(tasks_[task], threads_[worker], positions_[worker]);
    }

    // Between cycles: other chunks of the same tasks in the same order.
    void use(const Schedule& schedule) CORTEX_REALTIME { chunks_ = schedule.chunks; }

    // In the next cycle all that is Active faults (overflow="halt").
    void halt() { haltNext_ = true; }
    // From now on nothing starts up.
    void beginStop() { stopping_ = true; }
    // In the next cycle: whatever is not in Standby or Fault goes to Standby, with safe demands.
    void forceStandby() { forced_ = true; }

    std::uint32_t taskCount() const { return static_cast<std::uint32_t>(tasks_.size()); }
    const Position& position(std::uint32_t worker) const { return positions_[worker]; }
    RunnerCounts counts() const;

    // From now on: whether that simplex ran, and why it refuses or faults; `noSimplex`: none. Loop
    // thread, between cycles.
    void listenTo(std::uint32_t simplex) CORTEX_REALTIME {
        listenedTo_ = simplex;
        heardRun_ = false;
        heard_ = {};
    }
    bool heardRun() const { return heardRun_; }
    const EventText& heard() const { return heard_; }

private:
    friend struct TaskBuilder;

    // False: it is not its turn, or nobody's task.
    bool runTask(Task& task, TaskThread& thread, Position& position) CORTEX_REALTIME;
    bool runAtTimes(Task& task, TaskThread& thread, Position& position) CORTEX_REALTIME;
    void runSimplex(Task& task, const Tick& tick, TaskThread& thread, Position& position)
        CORTEX_REALTIME;
    void runTimed(Task& task, TaskThread& thread, Position& position) CORTEX_REALTIME;
    TaskDetails& details(const Task& task) {
        return details_[static_cast<std::size_t>(&task - tasks_.data())];
    }
    bool mayMove(const SimplexCS& simplex, std::uint8_t calls) const CORTEX_REALTIME;
    void runHooks(Task& task, SimplexCS& simplex, const Tick& tick, Position& position)
        CORTEX_REALTIME;
    static void runPassing(SimplexCS& simplex, const Tick& tick, Position& position)
        CORTEX_REALTIME;
    void transition(Task& task, const Tick& tick) CORTEX_REALTIME;
    bool lifeCycle(Task& task, LifeCycle command, const Tick& tick) CORTEX_REALTIME;
    void enter(Task& task, State to, const Tick& tick) CORTEX_REALTIME;
    void enterFault(Task& task, const Tick& tick) CORTEX_REALTIME;
    bool mayStart(Task& task) CORTEX_REALTIME;
    SlotState readInputs(Task& task, const Tick& tick) CORTEX_REALTIME;
    SlotState readInput(Task& task, TaskInput& input, const Tick& tick) CORTEX_REALTIME;
    void inputLost(Task& task, TaskInput& input, const Tick& tick) CORTEX_REALTIME;
    void limitOutputs(Task& task, const Tick& tick) CORTEX_REALTIME;
    EventText refusal(const LimitResult& result, std::uint32_t target) const CORTEX_REALTIME;
    void reportLimits(const DemandLimits& limits, std::uint32_t simplex, LoopThread& thread)
        CORTEX_REALTIME;
    void arbitrate(Arbiter& arbiter, TaskThread& thread) CORTEX_REALTIME;
    void latchSafe(Task& task) CORTEX_REALTIME;
    void writeSafe(Task& task) CORTEX_REALTIME;
    void checkTimeout(Task& task, const Tick& tick) CORTEX_REALTIME;
    void tell(const Task& task) CORTEX_REALTIME;  // who listens: the text of its thread
    void settleQuality(const Task& task, const SimplexCS& simplex, const Tick& tick) const
        CORTEX_REALTIME;

    AgentRuntime& agent_;
    const Structure& structure_;
    SlotState* states_;  // by simplex
    std::int64_t period_;
    std::span<const Chunk> chunks_;
    std::vector<Task> tasks_;           // in execution order
    std::vector<TaskDetails> details_;  // of the same tasks
    std::vector<TaskInput> inputs_;
    std::vector<TaskOutput> outputs_;
    std::vector<std::unique_ptr<HeldInput>> held_;
    std::vector<std::unique_ptr<SafeDemands>> safe_;
    std::vector<std::unique_ptr<DemandLimits>> limits_;
    std::vector<std::unique_ptr<Arbiter>> arbiters_;
    std::vector<TaskThread> threads_;
    std::unique_ptr<Position[]> positions_;
    Tick tick_;
    std::uint32_t listenedTo_ = noSimplex;
    bool heardRun_ = false;  // written by the task of that simplex
    EventText heard_;        // likewise
    std::uint32_t timedChunk_ = 0;
    bool haltNext_ = false, halted_ = false, forced_ = false, stopping_ = false;
    bool anyMayMove_ = false;  // in this cycle, without a call of its own
};

}  // namespace cortex::cs
