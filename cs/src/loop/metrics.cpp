// SPDX-License-Identifier: Apache-2.0
#include "loop/metrics.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/framework_item.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

namespace cortex::cs {

namespace {

constexpr std::array percentiles{0.5, 0.99, 0.999};
constexpr std::array percentileNames{"P50", "P99", "P999"};

// First bin at which the cumulated count reaches each percentile.
template <class Bins, class CountOf, class ValueOf>
void findPercentiles(const Bins& bins, std::uint64_t count, std::span<Data<double>> items,
                     CountOf countOf, ValueOf valueOf) {
    std::uint64_t below = 0;
    std::size_t wanted = 0;
    for (std::uint32_t bin = 0; bin < bins.size() && wanted < percentiles.size(); ++bin) {
        below += countOf(bins[bin]);
        while (wanted < percentiles.size() &&
               static_cast<double>(below) >= percentiles[wanted] * static_cast<double>(count)) {
            items[wanted++] = valueOf(bin);
        }
    }
}

template <class T>
Data<T> clusterItem(AgentRuntime& agent, std::string_view item) {
    return frameworkItem<T>(agent, agent.agentSimplex(), item);
}

}  // namespace

MetricSeries::MetricSeries(AgentRuntime& agent, std::string_view name, double scale)
    : scale_{scale}, bins_(binsPerOctave * 44) {
    const std::string prefix{name};
    lastItem_ = clusterItem<double>(agent, prefix + "Last");
    meanItem_ = clusterItem<double>(agent, prefix + "Mean");
    maxItem_ = clusterItem<double>(agent, prefix + "Max");
    for (std::size_t i = 0; i < percentiles.size(); ++i) {
        percentileItems_[i] = clusterItem<double>(agent, prefix + percentileNames[i]);
    }
}

void MetricSeries::add(double figure) {
    last_ = figure;
    sum_ += figure;
    greatest_ = std::max(greatest_, figure);
    ++count_;
    // The octave, then the five bits behind the highest one of the scaled figure, are its bin.
    const auto scaled = static_cast<std::uint64_t>(std::max(0.0, figure * scale_)) + binsPerOctave;
    const auto octave = static_cast<unsigned>(std::bit_width(scaled)) - 6U;
    const auto bin = static_cast<std::size_t>(octave) * binsPerOctave +
                     static_cast<std::size_t>((scaled >> octave) - binsPerOctave);
    Bin& of = bins_[std::min(bin, bins_.size() - 1)];
    ++of.count;
    of.sum += figure;
}

void MetricSeries::write() {
    if (count_ == 0) return;
    lastItem_ = last_;
    meanItem_ = sum_ / static_cast<double>(count_);
    maxItem_ = greatest_;
}

void MetricSeries::writePercentiles() {
    if (count_ == 0) return;
    findPercentiles(
        bins_, count_, percentileItems_, [](const Bin& bin) { return bin.count; },
        [this](std::uint32_t bin) {
            return bins_[bin].sum / static_cast<double>(bins_[bin].count);
        });
}

ClusterMetrics::ClusterMetrics(AgentRuntime& agent, std::int64_t period, std::uint32_t threads)
    : agent_{agent},
      own_{agent.tables().live(agent.agentSimplex()).state},
      period_{static_cast<double>(period)},
      series_{MetricSeries{agent, "cycleDuration", 1000}, MetricSeries{agent, "jitter", 1000},
              MetricSeries{agent, "lateness", 1000}, MetricSeries{agent, "dutyCycle", 10000}},
      latencySum_(latencyBuckets),
      threads_{threads} {
    constexpr std::array latencyNames{"Last", "Mean", "P50", "P99", "P999", "Max"};
    for (std::size_t i = 0; i < latency_.size(); ++i) {
        latency_[i] = clusterItem<double>(agent, std::string{"commandLatency"} + latencyNames[i]);
    }
    overflowItem_ = clusterItem<std::int64_t>(agent, "overflowCount");
    commandItem_ = clusterItem<std::int64_t>(agent, "commandCount");
    rejectedItem_ = clusterItem<std::int64_t>(agent, "rejectedCount");
    conflictItem_ = clusterItem<std::int64_t>(agent, "conflictCount");
    limitItem_ = clusterItem<std::int64_t>(agent, "limitCount");
    droppedItem_ = clusterItem<std::int64_t>(agent, "eventsDropped");
    threadsItem_ = clusterItem<std::int64_t>(agent, "threads");
    cpusItem_ = clusterItem<std::string_view>(agent, "cpus");
    aliveItem_ = clusterItem<bool>(agent, "alive");
}

// All arguments in ns. The duty cycle is shown in % of the period, all else in µs. Jitter is that
// of the paper: how far the time between the beginnings of two cycles is from the period.
void ClusterMetrics::cycleEnded(std::int64_t sinceLastWakeUp, std::int64_t lateness,
                                std::int64_t work) {
    if (sinceLastWakeUp > 0) {
        const auto duration = static_cast<double>(sinceLastWakeUp);
        series_[0].add(duration * 1e-3);
        series_[1].add(std::abs(duration - period_) * 1e-3);
    }
    series_[2].add(static_cast<double>(std::max<std::int64_t>(lateness, 0)) * 1e-3);
    lastDuty_ = static_cast<double>(work) / period_ * 100;
    series_[3].add(lastDuty_);
}

void ClusterMetrics::write(const RunnerCounts& counts, const Tick& tick) {
    *own_ = {tick.cycle, tick.nominalTime, noSimplex, Quality::Good};
    for (MetricSeries& series : series_) series.write();
    writePercentiles(tick.nominalTime);
    std::uint64_t commands = 0;
    std::uint64_t rejected = 0;
    for (std::uint32_t i = 0; i < agent_.threadCount(); ++i) {
        commands += agent_.thread(i).commands;
        rejected += agent_.thread(i).rejected;
    }
    overflowItem_ = overflows_;
    commandItem_ = static_cast<std::int64_t>(commands);
    rejectedItem_ = static_cast<std::int64_t>(rejected);
    conflictItem_ = static_cast<std::int64_t>(counts.conflicts);
    limitItem_ = static_cast<std::int64_t>(counts.limits);
    droppedItem_ = static_cast<std::int64_t>(agent_.events().dropped());
    threadsItem_ = threads_;
    aliveItem_ = !hung_;
}

// The walks over the bins take turns: one in 16 cycles at first, and then one every 200 ms, so that
// figures are about a second old. In a slow loop several are due in one cycle.
void ClusterMetrics::writePercentiles(std::int64_t nominalTime) {
    const std::size_t all = series_.size() + 1;
    const std::int64_t early = std::max(16 * static_cast<std::int64_t>(period_), nominalTime / 8);
    const std::int64_t interval = std::min(nsPerSecond / 5, early);
    for (std::size_t i = 0; i < all && nextWalk_ <= nominalTime; ++i, nextWalk_ += interval) {
        const std::size_t turn = walks_++ % all;
        if (turn < series_.size())
            series_[turn].writePercentiles();
        else
            writeLatency();
    }
    nextWalk_ = std::max(nextWalk_, nominalTime + 1);
}

// The latencies of commands are counted by each thread of the loop; here they are added up.
void ClusterMetrics::writeLatency() {
    std::ranges::fill(latencySum_, 0);
    std::uint64_t count = 0;
    double sum = 0;
    double greatest = 0;
    std::int64_t last = 0;
    for (std::uint32_t i = 0; i < agent_.threadCount(); ++i) {
        const LoopThread& thread = agent_.thread(i);
        if (thread.commands != 0) last = std::max(last, thread.lastLatency);
        for (std::uint32_t bin = 0; bin < thread.latencyCounts.size(); ++bin) {
            if (thread.latencyCounts[bin] == 0) continue;
            latencySum_[bin] += thread.latencyCounts[bin];
            count += thread.latencyCounts[bin];
            sum += latencyOfBucket(bin) * static_cast<double>(thread.latencyCounts[bin]);
            greatest = std::max(greatest, latencyOfBucket(bin));
        }
    }
    if (count == 0) return;
    latency_[0] = static_cast<double>(last) * 1e-3;
    latency_[1] = sum / static_cast<double>(count);
    latency_[5] = greatest;
    findPercentiles(
        latencySum_, count, std::span{latency_}.subspan(2, 3),
        [](std::uint64_t bin) { return bin; }, latencyOfBucket);
}

}  // namespace cortex::cs
