// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/cluster_cs.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <vector>

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
class Partner : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;
    static inline std::uint32_t commandsPerCycle = 1;

    std::int64_t executed = 0;
    std::int64_t full = 0;

protected:
    void loopStart(const Tick& tick) override;
    const AnswerHead& newestAnswer() const { return ping_.answer(); }
    void populate() override;

private:
    Outcome ping(Call& call);

    CommandSender ping_;
    Data<double> number_;
    Argument<double> asked_;
    Result<double> answered_;
};

// A partner that while it is Active writes an item of its own and an output with two limited items,
// as a controller of an axis does.
class WorkingPartner : public Partner {
public:
    using Partner::Partner;

private:
    void populate() override;
    void stateActive(const Tick& tick) override;

    Data<double> level_, position_, velocity_;
};

// A partner that also notes when its task began, which is before it sends its commands and after it
// executed those that it got.
class TimedPartner final : public WorkingPartner {
public:
    using WorkingPartner::WorkingPartner;
    struct Sample {
        std::int64_t begun = 0;          // ns, monotonic
        std::int64_t latencyCycles = 0;  // as the newest answer says
    };

    void prepare(std::size_t capacity) { samples_.reserve(capacity); }
    // Between two cycles.
    void begin() {
        samples_.clear();
        recording_ = true;
    }
    void end() { recording_ = false; }
    const std::vector<Sample>& samples() const { return samples_; }

private:
    void loopStart(const Tick& tick) override;

    std::vector<Sample> samples_;
    bool recording_ = false;
};

// Working partners of which the pair in the middle is timed. The commands of `first` are executed
// in the same cycle, those of `second` in the next.
struct TimedPartners {
    SimplexTree tree;
    TimedPartner *first, *second;
};

// A started cluster on a BurstTrigger, all simplexes Active.
struct SubjectCluster {
    SubjectCluster(SimplexTree&& simplexes, cs::ClusterOptions options);

    SimplexTree tree;
    cs::ClusterCS cluster;
    BurstTrigger* trigger;
};

// To every active simplex, between two cycles: all have followed some cycles later.
void postToAll(AgentRuntime& agent, LifeCycle command);
bool allActive(const Image& image);

TypeModel subjectTypes();
SimplexTree emptySimplexes(int count, int chain);
SimplexTree partners(int count);
TimedPartners timedPartners(int count);

}  // namespace cortex::profiler
