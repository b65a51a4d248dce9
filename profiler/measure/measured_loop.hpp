// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "measure/measurement.hpp"
#include "measure/recording_clock.hpp"
#include "report/judging.hpp"
#include "subject/subject.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

namespace cortex::profiler {

// What one plan found about one loop.
struct Measured {
    double period = 0;  // us
    std::int64_t simplexes = 0, cycles = 0, missed = 0;
    std::int64_t sleeps = 0, sleeperMissed = 0;
    std::int64_t works = 0, workMissed = 0;  // of RegisterWork
    Histogram duration, lateness, sleeperLateness, workDuration;
    Histogram interval, intervalError, sleeperIntervalError;  // errors: from the period, absolute
    // Of the timed pair by its own clock: from before the first command is sent until the last one
    // of the cycle is executed; errors: from the median, absolute.
    Histogram sameCycle, nextCycle, sameCycleError, nextCycleError;
    std::int64_t greatestLatencyCycles = 0;
    double clusterLatencyP99 = 0;  // us, the cluster's own metric
    std::uint64_t commands = 0, expectedCommands = 0, rejected = 0;
    std::uint64_t imagesRead = 0;
    double seconds = 0;                      // that the loop ran
    std::vector<double> blockP50, blockP99;  // us, of the duration, block by block
    bool complete = false;
    LoopAndSleeper judged;  // by blocks of the plan

    // p99 of the duty cycle in one block, or in all where there is no such block.
    double dutyOfBlock(std::size_t block) const {
        return block < blockP99.size() ? 100 * blockP99[block] / period : duty(0.99);
    }
    double duty(double part) const { return 100 * duration.percentile(part) / period; }
    double meanDuty() const { return 100 * duration.mean() / period; }
    // p99 of the duration above the period, or more ticks missed than by the sleeper and 1 in 100:
    // the one tolerance of all sweeps. judgeLoad() looks longer, at 1 in 10,000.
    bool overflows() const;
};

// A cluster on a RecordingClock, all simplexes Active, with somebody who reads its newest image 30
// times a second.
class MeasuredLoop {
public:
    // Pairs of simplexes that send `commands` each in each cycle.
    static std::unique_ptr<MeasuredLoop> ofPartners(std::int64_t simplexes, std::uint32_t commands,
                                                    double frequency, const RunOptions& options);
    static std::unique_ptr<MeasuredLoop> ofEmpty(std::int64_t simplexes, double frequency,
                                                 const RunOptions& options);
    ~MeasuredLoop();

    // Until the plan is carried out or `stop()` says so; it is asked ten times a second.
    Measured run(const RecordingPlan& plan, const std::function<bool()>& stop);
    const Recording& recording() const { return clock_->recording(); }
    const std::vector<std::string>& refusals() const { return cluster_->realtimeReport(); }
    std::uint32_t threads() const { return cluster_->threadsInUse(); }

private:
    struct Counts {
        std::uint64_t commands = 0, rejected = 0;
    };
    MeasuredLoop(SimplexTree&& tree, std::int64_t simplexes, std::uint32_t commands,
                 double frequency, const RunOptions& options);
    void start();
    void shutDown();
    void observe();
    void count(Counts& counts);
    void checkActive() const;
    void evaluateWakes(Measured& measured) const;
    void evaluateBlocks(Measured& measured) const;
    void evaluateCommands(Measured& measured) const;
    void evaluateIntervals(Measured& measured) const;
    void evaluateLatency(Measured& measured) const;

    SimplexTree tree_;
    std::int64_t simplexes_;
    std::uint32_t commands_;
    double period_;  // ns
    double settlingPeriods_ = 0;
    TimedPartner *first_ = nullptr, *second_ = nullptr;
    std::unique_ptr<cs::ClusterCS> cluster_;
    RecordingClock* clock_ = nullptr;
    Counts before_, after_;
    std::atomic<bool> ending_{false};
    std::atomic<std::uint64_t> imagesRead_{0};
    std::thread observer_;
};

// As many as CPUs may be used, at most 4, where the options leave it open.
std::uint32_t loopThreads(const RunOptions& options);

// How long a loop of partners runs before it is measured: where threads may share its work the
// library looks after a second at what tasks cost. Not with --quick.
double settlingSeconds(const RunOptions& options);

}  // namespace cortex::profiler
