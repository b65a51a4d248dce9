// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"

#include "tasks/task_runner.hpp"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace cortex::cs {

// Last, mean, maximum and percentiles of one measured figure, as items of the cluster simplex.
// A percentile is the mean of its bin in a logarithmic histogram, 32 bins an octave: within 3 %,
// and exact where the figures of a bin agree.
class MetricSeries {
public:
    // Items `<name>Last`, `<name>Mean`, … ; `scale` turns a figure into its bins' integer.
    MetricSeries(AgentRuntime& agent, std::string_view name, double scale);

    void add(double figure) CORTEX_REALTIME;
    void write() CORTEX_REALTIME;             // last, mean, max
    void writePercentiles() CORTEX_REALTIME;  // a walk over the bins
    double max() const { return greatest_; }

private:
    static constexpr int binsPerOctave = 32;

    double scale_;
    double last_ = 0, sum_ = 0, greatest_ = 0;
    std::uint64_t count_ = 0;
    struct Bin {
        std::uint64_t count = 0;
        double sum = 0;
    };
    std::vector<Bin> bins_;
    Data<double> lastItem_, meanItem_, maxItem_;
    std::array<Data<double>, 3> percentileItems_;
};

// The loop's metrics as data of /<cluster>. Those of cycle k stand in image k+1. Loop thread.
class ClusterMetrics {
public:
    ClusterMetrics(AgentRuntime& agent, std::int64_t period, std::uint32_t threads);

    // Figures of the cycle that has ended, ns.
    void cycleEnded(std::int64_t sinceLastWakeUp, std::int64_t lateness, std::int64_t work)
        CORTEX_REALTIME;
    void overflow(std::int64_t missed) CORTEX_REALTIME { overflows_ += missed; }
    void hung(bool hung) CORTEX_REALTIME { hung_ = hung; }
    // Writes all into the tables; before the image is taken.
    void write(const RunnerCounts& counts, const Tick& tick) CORTEX_REALTIME;
    void cpus(std::string_view cpus) CORTEX_REALTIME { cpusItem_ = cpus; }
    void threads(std::uint32_t threads) CORTEX_REALTIME { threads_ = threads; }
    double lastDuty() const { return lastDuty_; }
    std::int64_t overflows() const { return overflows_; }

private:
    void writePercentiles(std::int64_t nominalTime) CORTEX_REALTIME;
    void writeLatency() CORTEX_REALTIME;

    AgentRuntime& agent_;
    SlotState* own_;  // of the cluster's simplex
    double period_;
    std::array<MetricSeries, 4> series_;   // duration, jitter, lateness, duty
    std::array<Data<double>, 6> latency_;  // last, mean, p50, p99, p999, max
    Data<std::int64_t> overflowItem_, commandItem_, rejectedItem_, conflictItem_, limitItem_,
        droppedItem_, threadsItem_;
    Data<std::string_view> cpusItem_;
    Data<bool> aliveItem_;
    std::vector<std::uint64_t> latencySum_;
    std::int64_t overflows_ = 0;
    std::int64_t nextWalk_ = 1;  // nominal time, ns
    std::size_t walks_ = 0;
    std::uint32_t threads_;
    double lastDuty_ = 0;
    bool hung_ = false;
};

}  // namespace cortex::cs
