// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include "tasks/task_states.hpp"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace cortex::cs {

// startup, shutdown and clearFaults of everything below a path, one simplex after the other in
// canonical order (shutdown: reverse). The commands of /<cluster>; loop thread.
class GroupCommands {
public:
    // `order`: all active simplexes in canonical order. Registers the handlers on /<cluster>.
    GroupCommands(AgentRuntime& agent, TaskStates& states, std::vector<SimplexCS*> order);
    GroupCommands(const GroupCommands&) = delete;
    GroupCommands& operator=(const GroupCommands&) = delete;

    // From now on only shuts down: commands of others are refused.
    void beginStop();
    void begin(LifeCycle command, std::string_view prefix) CORTEX_REALTIME;
    // Once a cycle, before the tasks. False: all that can follow have.
    bool step() CORTEX_REALTIME;
    const EventText& failures() const { return failures_; }

    bool allResting() const CORTEX_REALTIME;  // every simplex is in Standby or Fault

private:
    Outcome handle(LifeCycle command, Call& call, Argument<std::string_view> prefix);
    template <LifeCycle command>
    void registerHandler(std::string_view name);

    bool anyStandsThere() const CORTEX_REALTIME;
    bool anyWorks() const CORTEX_REALTIME;
    bool belongs(const SimplexCS& simplex) const CORTEX_REALTIME;
    bool reached(const SimplexCS& simplex) const CORTEX_REALTIME;
    bool failed(const SimplexCS& simplex) const CORTEX_REALTIME;
    void addFailure(const SimplexCS& simplex) CORTEX_REALTIME;
    std::size_t place(std::size_t at) const CORTEX_REALTIME;
    SimplexCS& member(std::size_t at) const CORTEX_REALTIME { return *order_[place(at)]; }

    AgentRuntime& agent_;
    TaskStates& states_;
    std::vector<SimplexCS*> order_;
    std::vector<Data<const std::string_view>> faultTexts_;  // of the same simplexes
    std::array<Argument<std::string_view>, 4> prefixes_{};  // by LifeCycle
    LifeCycle command_ = LifeCycle::None;
    EventText prefix_;
    EventText failures_;
    std::size_t at_ = 0;
    bool posted_ = false;
    bool again_ = false;  // the second round of a shutdown
    bool anyFailed_ = false;
    bool stopping_ = false;
};

}  // namespace cortex::cs
