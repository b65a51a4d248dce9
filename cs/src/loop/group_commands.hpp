// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include "loop/start_order.hpp"
#include "tasks/task_states.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::cs {

// startup, shutdown and clearFaults of everything below a path, level by level (shutdown: in
// reverse). One that does not start holds back only those that rely on it. The commands of
// /<cluster>; loop thread.
class GroupCommands {
public:
    GroupCommands(AgentRuntime& agent, TaskStates& states, StartOrder order);
    GroupCommands(const GroupCommands&) = delete;
    GroupCommands& operator=(const GroupCommands&) = delete;

    // From now on only shuts down: commands of others are refused.
    void beginStop();
    void begin(LifeCycle command, std::string_view prefix) CORTEX_REALTIME;
    // Once a cycle, before the tasks. False: all that can follow have.
    bool step() CORTEX_REALTIME;
    bool allResting() const CORTEX_REALTIME;  // every simplex is in Standby or Fault
    // The time for the shutdown is over: whoever is on the way did not follow. In a cycle.
    void tellOverdue(double seconds);
    // Who did not follow, and why, a line each. After the loop.
    std::vector<std::string> notFollowed() const;

    std::int64_t levels() const { return static_cast<std::int64_t>(order_.levels.size()); }

private:
    // An active simplex, and what becomes of it in the command that runs.
    struct Member {
        Data<const std::string_view> faultText;
        TaskStates::Watched watched;
        bool failed = false;
        EventText failure;  // how it failed; what it does when it is asked again changes nothing
    };

    Outcome handle(LifeCycle command, Call& call, Argument<std::string_view> prefix);
    template <LifeCycle command>
    void registerHandler(std::string_view name);

    const StartOrder::Level& level() const CORTEX_REALTIME;
    bool ask() CORTEX_REALTIME;
    bool goesOn() const CORTEX_REALTIME;
    void settle() CORTEX_REALTIME;
    void holdBack(std::uint32_t node) CORTEX_REALTIME;
    void fail(std::uint32_t node, const EventText& text) CORTEX_REALTIME;
    void tell(Severity severity, std::uint32_t node) CORTEX_REALTIME;
    EventText answer() const CORTEX_REALTIME;

    SimplexCS& simplex(std::uint32_t node) const CORTEX_REALTIME {
        return *order_.nodes[node].active;
    }
    bool anyStandsThere() const CORTEX_REALTIME;
    bool anyWorks() const CORTEX_REALTIME;
    bool belongs(const SimplexCS& simplex) const CORTEX_REALTIME;
    bool reached(std::uint32_t node) const CORTEX_REALTIME;
    bool failed(std::uint32_t node) const CORTEX_REALTIME;
    std::uint32_t blockerOf(std::uint32_t node) const CORTEX_REALTIME;

    AgentRuntime& agent_;
    TaskStates& states_;
    StartOrder order_;
    std::vector<std::uint32_t> actives_;            // nodes
    std::vector<std::unique_ptr<Member>> members_;  // by node; null: has no state
    std::vector<std::uint32_t> blockers_;           // by node: who failed before it, or noSimplex
    std::array<Argument<std::string_view>, 4> prefixes_{};  // by LifeCycle
    LifeCycle command_ = LifeCycle::None;
    EventText prefix_;
    std::uint32_t level_ = 0;  // how many are done
    bool asked_ = false;       // those of the next one
    bool again_ = false;       // the second round of a shutdown
    bool anyFailed_ = false;
    bool stopping_ = false;
};

}  // namespace cortex::cs
