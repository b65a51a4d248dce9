// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"

#include "determinism/real_run.hpp"
#include "loop/group_commands.hpp"
#include "loop/metrics.hpp"
#include "tasks/task_runner.hpp"
#include "threads/scheduler.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

namespace cortex::determinism {

// The loop of a cluster put together by hand, so that its schedule can be spoiled: as ClusterCS
// does it, but without missed ticks.
class HandMadeLoop {
public:
    explicit HandMadeLoop(const Plan& plan);
    ~HandMadeLoop();

    // Takes one dependency by chance out of the schedule; the chunk that was waited for now ends
    // only after the one that should have waited. False: there is none without another way round.
    bool dropDependency(std::uint64_t seed);
    Observation run();

private:
    void runChunk(std::uint32_t chunk, std::uint32_t worker);
    bool leadsTo(std::uint32_t from, std::uint32_t to) const;

    Disturbance disturbance_;
    SimplexTree tree_;
    Observation observation_;
    ScriptInterface script_;
    std::unique_ptr<AgentRuntime> agent_;
    cs::Schedule schedule_;
    std::unique_ptr<cs::TaskRunner> runner_;
    std::unique_ptr<cs::GroupCommands> group_;
    struct Dropped {
        std::uint32_t chunk, predecessor;
    };
    std::optional<Dropped> dropped_;
    Tick tick_;
    std::atomic<std::int64_t> ranIn_{0};  // cycle in which the dropped chunk last ran
};

}  // namespace cortex::determinism
