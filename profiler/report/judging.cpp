// SPDX-License-Identifier: Apache-2.0
#include "report/judging.hpp"

#include "report/number_text.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::profiler {
namespace {

constexpr double mostMissed = 1;         // of 10,000, beyond the sleeper
constexpr double mostOverhead = 5;       // ns a task
constexpr double partOfPeer = 1.0 / 10;  // of what the flow graph adds

std::vector<double> everyOther(const std::vector<double>& all, std::size_t first) {
    std::vector<double> found;
    for (std::size_t i = first; i < all.size(); i += 2) found.push_back(all[i]);
    return found;
}

std::string tooNoisy(double nullRatio) {
    if (nullRatio <= mostNullRatio) return {};
    return "too noisy, a bare sleeper differs from itself by " + readable(nullRatio) +
           "; more than " + readable(mostNullRatio) + " is not judged";
}

double least(const std::vector<double>& values) {
    return values.empty() ? none : std::ranges::min(values);
}

}  // namespace

double Lateness::nullRatio() const {
    const double even = median(everyOther(p99s, 0)), odd = median(everyOther(p99s, 1));
    const double ratio = std::max(even, odd) / std::min(even, odd);
    return std::isfinite(ratio) ? ratio : std::numeric_limits<double>::infinity();
}

Quantity judgedLateness(const LoopAndSleeper& found) {
    Quantity ratio;
    ratio.value = found.ratio();
    ratio.baseline = found.sleeper.nullRatio();
    ratio.baselineName = "sleeper over itself";
    ratio.aim = Aim::AtMost;
    ratio.limit = mostLateness;
    ratio.doubt = tooNoisy(ratio.baseline);
    const std::size_t seconds = std::min(found.loop.p99s.size(), found.sleeper.p99s.size());
    for (std::size_t i = 0; i < seconds; ++i) {
        ratio.repeats.push_back(found.loop.p99s[i] / found.sleeper.p99s[i]);
    }
    return ratio;
}

Quantity judgedChange(const LoopAndSleeper& with, const LoopAndSleeper& without) {
    Quantity change;
    change.value = with.ratio() / without.ratio();
    change.baseline = std::max(with.sleeper.nullRatio(), without.sleeper.nullRatio());
    change.baselineName = "sleeper over itself";
    change.aim = Aim::AtMost;
    change.limit = std::max(mostLateness, change.baseline);
    change.doubt = tooNoisy(change.baseline);
    return change;
}

double Missed::per10000() const {
    return static_cast<double>(ticks) * 10'000 / std::max(1.0, static_cast<double>(of));
}

Quantity judgedMissed(const Missed& loop, const Missed& sleeper, const Missed& work) {
    Quantity missed;
    missed.unit = "ticks";
    missed.value = std::max(0.0, loop.per10000() - sleeper.per10000());
    missed.baseline = std::max(0.0, work.per10000() - sleeper.per10000());
    missed.baselineName = "threads that only compute";
    missed.aim = Aim::AtMost;
    missed.limit = mostMissed;
    if (missed.value > mostMissed && missed.baseline > mostMissed) {
        missed.doubt = "too noisy, threads that only compute miss " + readable(missed.baseline);
    }
    return missed;
}

Quantity judgedDuty(const Histogram& duration, const Histogram& work, double period, double most) {
    Quantity duty;
    duty.unit = "%";
    duty.value = 100 * duration.percentile(0.99) / period;
    duty.aim = Aim::AtMost;
    duty.limit = most;
    const double uneven = work.percentile(0.99) / work.percentile(0.5);
    const bool typical = 100 * duration.percentile(0.5) / period <= most;
    if (duty.value > most && typical && uneven > mostNullRatio) {
        duty.doubt = "too noisy, p99 of threads that only compute is " + readable(uneven) +
                     " times their median";
    }
    return duty;
}

Quantity judgedCapacity(double found, double medianDutyAbove, double most, double wanted) {
    Quantity capacity;
    capacity.value = found;
    capacity.aim = Aim::AtLeast;
    capacity.limit = wanted;
    capacity.lessIsBetter = false;
    if (found < wanted && medianDutyAbove <= most / 2) {
        capacity.doubt = "too noisy, it ended where the median duty cycle was only " +
                         readable(medianDutyAbove) + " %";
    }
    return capacity;
}

Quantity judgedOverhead(const TaskTimes& times) {
    const double plain = least(times.plain), peer = times.peer - plain;
    Quantity overhead;
    overhead.unit = "ns";
    overhead.value = least(times.pool) - plain;
    for (std::size_t i = 0; i < std::min(times.pool.size(), times.plain.size()); ++i) {
        overhead.repeats.push_back(times.pool[i] - times.plain[i]);
    }
    overhead.baseline = peer;
    overhead.aim = Aim::AtMost;
    overhead.limit = std::min(mostOverhead, peer * partOfPeer);
    const double differs =
        std::abs(least(everyOther(times.plain, 0)) - least(everyOther(times.plain, 1)));
    if (!(peer > 0)) {
        overhead.doubt = "too noisy, the flow graph took no longer than the plain loop";
    } else if (differs > overhead.limit) {
        overhead.doubt = "too noisy, the plain loop differs from itself by " + readable(differs) +
                         " ns between rounds";
    }
    return overhead;
}

}  // namespace cortex::profiler
