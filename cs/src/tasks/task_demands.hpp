// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tasks/task_set.hpp"

#include <string_view>
#include <vector>

namespace cortex::cs {

// Where a safe value stands its writer has chosen it, in this cycle: to act on, but not to begin
// anything new with. No loss of an input shows here.
inline SlotState ofSafeDemand(std::uint32_t writer, const Tick& tick) {
    return {tick.cycle, tick.nominalTime, writer, Quality::Stale};
}

// What tasks demand: limits, safe values, and the choice among several writers of one simplex.
class TaskDemands {
public:
    explicit TaskDemands(TaskSet& set) : set_{set} {}

    // Limits each demand that this task alone writes. What is not a number becomes safe, and what
    // faults its writer is a fault of the simplex. True: accept() has to limit once more.
    bool limit(Task& task, const Tick& tick) CORTEX_REALTIME;
    // No demand moves further than its rate allows, safe or not; then it goes out.
    void accept(Task& task, const Tick& tick, bool again) CORTEX_REALTIME;
    // Takes the candidate of the writer that is Active. Of several with one manager it is the one
    // that became so last: the demand is being handed over to it. Others are in conflict.
    void arbitrate(Arbiter& arbiter, const Tick& tick, TaskThread& thread) CORTEX_REALTIME;
    // A fault of the simplex for each demand that an arbiter refused in the cycle before.
    void faultForRefused(Task& task) CORTEX_REALTIME;

    // On the way between states, before commands and hooks: what no hook has moved goes on to its
    // safe value.
    void put(Task& task, const Tick& tick) CORTEX_REALTIME {
        if (task.demands == Task::Demands::None) return;
        for (const TaskOutput& output : set_.outputsOf(task)) {
            if (output.safe != nullptr) output.safe->put(tick.elapsedSeconds());
        }
    }
    // At rest, after commands: a handler may want what only its type can allow.
    void tellHandlersInVain(Task& task) CORTEX_REALTIME;
    // After them, before limits: whatever hooks wrote, safe values stand in Standby, in Fault and
    // while safe by loss.
    void settle(Task& task, const Tick& tick) CORTEX_REALTIME {
        const SimplexCS& simplex = *task.simplex;
        const bool bound = simplex.state_ != State::Active || simplex.safeByLoss_;
        if (bound || task.demands == Task::Demands::Bound) settle(task, tick, bound);
    }

    // Safe values that have not gone out yet, as their rates do not allow it, or no device took
    // them. Between cycles.
    bool anyOnTheWay() const CORTEX_REALTIME;
    struct OnTheWay {
        std::uint32_t simplex;
        std::optional<SafeDemands::Way> way;  // none: what has no rate, and was not taken
        std::uint32_t unconnected;  // the device that would take it; noSimplex: it is taken
    };
    std::vector<OnTheWay> onTheWay() const;

    void latchSafe(Task& task, SafeDemands::Latch why) CORTEX_REALTIME {
        for (const TaskOutput& output : set_.outputsOf(task)) {
            if (output.safe != nullptr) output.safe->latch(why);
        }
    }
    void writeSafe(Task& task) CORTEX_REALTIME {
        for (const TaskOutput& output : set_.outputsOf(task)) {
            if (output.safe != nullptr) output.safe->write();
        }
    }

private:
    static bool choose(Arbiter& arbiter) CORTEX_REALTIME;
    void settle(Task& task, const Tick& tick, bool bound) CORTEX_REALTIME;
    void tellInVain(Task& task, const TaskOutput& output, std::string_view who) CORTEX_REALTIME;
    EventText refusal(const LimitResult& result, std::uint32_t target) const CORTEX_REALTIME;
    void reportLimits(const DemandLimits& limits, std::uint32_t simplex, bool isSafe,
                      LoopThread& thread) CORTEX_REALTIME;

    TaskSet& set_;
};

}  // namespace cortex::cs
