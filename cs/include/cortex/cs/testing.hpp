// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/cluster_cs.hpp"

#include <cstdint>
#include <functional>

namespace cortex::cs {

// For tests and measurements; not installed.
struct TestOptions {
    bool forceThreads = false;    // all that are asked for, also more than there are CPUs
    std::uint32_t chunkSize = 0;  // tasks in a chunk; 0: the schedule decides
    // Runs on each of the loop's threads (0: the loop's own) before its first cycle.
    std::function<void(std::uint32_t thread)> onThreadStart{};
};

struct ClusterTesting {
    static void set(ClusterCS& cluster, TestOptions options);  // before start()
    // From its next cycle on the loop runs the same tasks on so many threads, with so many tasks in
    // a chunk. False: it has not given the plan before back yet. While the loop waits for its tick.
    static bool offerPlan(ClusterCS& cluster, std::uint32_t threads, std::uint32_t chunkSize);
    // Plays an overload: the tick after the next counts so many missed periods.
    static void playLate(ManualTrigger& trigger, std::int64_t periods);
};

}  // namespace cortex::cs
