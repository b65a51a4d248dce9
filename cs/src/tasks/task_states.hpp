// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tasks/task_demands.hpp"
#include "tasks/task_set.hpp"

#include <cstdint>
#include <vector>

namespace cortex::cs {

// The state machine of every active simplex: life-cycle commands, transitions, faults.
class TaskStates {
public:
    TaskStates(TaskSet& set, TaskDemands& demands)
        : set_{set}, demands_{demands}, watched_(set.structure.simplexes.size()) {}

    // Loop thread, before the tasks of a cycle.
    void beginCycle() CORTEX_REALTIME;
    // Whether step (1) may change the state. In nearly all cycles nothing has happened that could.
    bool mayMove(const SimplexCS& simplex, std::uint8_t calls) const CORTEX_REALTIME {
        return anyMayMove_ || simplex.pending_.any() || AgentRuntime::hasLifeCycle(calls);
    }
    void transition(Task& task, const Tick& tick) CORTEX_REALTIME;
    void enterFault(Task& task, const Tick& tick) CORTEX_REALTIME;
    void checkTimeout(Task& task, const Tick& tick) CORTEX_REALTIME;

    // In the next cycle all that is Active faults. `why` stays as it is.
    void halt(FaultCode code, const char* why) {
        haltNext_ = true;
        haltCode_ = code;
        haltWhy_ = why;
    }
    // From now on nothing starts up.
    void beginStop() { stopping_ = true; }
    // In the next cycle: whatever is not in Standby or Fault goes to Standby, with safe demands.
    void forceStandby() { forced_ = true; }
    // Tasks run in this cycle whatever their rate.
    bool allRun() const CORTEX_REALTIME { return halted_ || forced_; }

    // What becomes of a simplex that a group command asks; it outlives the tasks.
    struct Watched {
        bool asked = false;
        bool ran = false;  // written by the task of that simplex, if it is asked
        EventText reason;  // likewise: why it refuses or faults
    };
    void registerWatched(std::uint32_t simplex, Watched& watched);  // setup
    // Whether those registered are written. Loop thread, between cycles.
    void watch(bool on) CORTEX_REALTIME { watching_ = on; }

private:
    void judge(const SetPoint& setPoint) CORTEX_REALTIME;
    bool lifeCycle(Task& task, LifeCycle command, const Tick& tick) CORTEX_REALTIME;
    void enter(Task& task, State to, const Tick& tick) CORTEX_REALTIME;
    bool mayStart(Task& task) CORTEX_REALTIME;
    void noteReason(const Task& task) CORTEX_REALTIME;
    Watched* watchedOf(const Task& task) const CORTEX_REALTIME {
        Watched* watched = watching_ ? watched_[task.index] : nullptr;
        return watched != nullptr && watched->asked ? watched : nullptr;
    }

    TaskSet& set_;
    TaskDemands& demands_;
    std::vector<Watched*> watched_;  // by simplex; null: none
    bool watching_ = false;
    FaultCode haltCode_ = ClusterHalted;
    const char* haltWhy_ = "";
    bool haltNext_ = false, halted_ = false, forced_ = false, stopping_ = false;
    bool anyMayMove_ = false;  // in this cycle, without a call of its own
};

}  // namespace cortex::cs
