// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/cluster_cs.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

namespace cortex::profiler {

// Lets a cluster run a number of cycles one after the other, as fast as they go.
class BurstTrigger final : public cs::TriggerSource {
public:
    // Returns when `cycles` more have been executed, with the time they took.
    std::chrono::nanoseconds burst(std::int64_t cycles);

    void start() override {}
    cs::Trigger waitForTick() override;
    void interrupt() override;
    std::int64_t period() const override { return 1'000'000; }
    bool realTime() const override { return false; }

private:
    std::atomic<std::int64_t> wanted_{0}, executed_{0};
    std::atomic<bool> interrupted_{false};
    std::int64_t cycle_ = -1;
    std::chrono::steady_clock::time_point begin_, end_;
};

struct Empty : cs::SimplexCS {
    using SimplexCS::SimplexCS;
};

// Sends one command to its partner in each cycle and answers the partner's.
class Partner final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;
    static inline std::uint32_t commandsPerCycle = 1;

    std::int64_t executed = 0;
    std::int64_t full = 0;

private:
    void populate() override;
    void loopStart(const Tick& tick) override;
    Outcome ping(Call& call);

    CommandSender ping_;
    Data<double> number_;
    Argument<double> asked_;
    Result<double> answered_;
};

// A started cluster on a BurstTrigger.
struct SubjectCluster {
    SubjectCluster(SimplexTree&& simplexes, cs::ClusterOptions options);

    SimplexTree tree;
    cs::ClusterCS cluster;
    BurstTrigger* trigger;
};

TypeModel subjectTypes();
SimplexTree emptySimplexes(int count, int chain);
SimplexTree partners(int count);

}  // namespace cortex::profiler
