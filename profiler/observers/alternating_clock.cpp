// SPDX-License-Identifier: Apache-2.0
#include "alternating_clock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace cortex::observers {
namespace {

constexpr std::int64_t perSecond = 1000;  // ticks

double percentile(std::vector<std::int64_t> values, double part) {
    if (values.empty()) return 0;
    const auto rank =
        static_cast<std::ptrdiff_t>(std::ceil(part * static_cast<double>(values.size())) - 1);
    const auto place = values.begin() + std::max<std::ptrdiff_t>(rank, 0);
    std::nth_element(values.begin(), place, values.end());
    return static_cast<double>(*place) * 1e-3;
}

}  // namespace

std::vector<double> Lateness::p99s() const {
    std::vector<double> all;
    for (const auto& second : seconds) all.push_back(percentile(second, 0.99));
    return all;
}

double Lateness::medianOfP99() const {
    std::vector<std::int64_t> all;
    for (const double each : p99s()) all.push_back(static_cast<std::int64_t>(each * 1e3));
    return percentile(all, 0.5);
}

double Lateness::nullRatio() const {
    const double even = every(0).medianOfP99(), odd = every(1).medianOfP99();
    return std::min(even, odd) > 0 ? std::max(even, odd) / std::min(even, odd) : 1;
}

std::string Lateness::tail() const {
    std::vector<std::int64_t> all;
    for (const auto& second : seconds) all.insert(all.end(), second.begin(), second.end());
    char text[96];
    std::snprintf(text, sizeof text, "p99.9 %.0f, p99.99 %.0f, max %.0f us", percentile(all, 0.999),
                  percentile(all, 0.9999), percentile(all, 1));
    return text;
}

Lateness Lateness::every(std::size_t second) const {
    Lateness half;
    for (std::size_t i = second; i < seconds.size(); i += 2) half.seconds.push_back(seconds[i]);
    return half;
}

void AlternatingClock::start() {
    sleeper_.emplace(Period);
    second_.reserve(perSecond);
}

void AlternatingClock::finishSecond() {
    {
        const std::lock_guard lock{mutex_};
        Lateness& to = sleeping_ ? measured_.sleeper : measured_.loop;
        to.seconds.push_back(second_);
        measured_.missed += std::exchange(loopMissed_, 0);
        measured_.missedBySleeper += std::exchange(sleeperMissed_, 0);
    }
    second_.clear();
    sleeping_ = !sleeping_;
}

cs::Trigger AlternatingClock::waitForTick() {
    for (bool afterCycle = true; !interrupted_; afterCycle = false) {
        const std::int64_t before = sleeper_->missed();
        const std::int64_t second = sleeper_->tick() / perSecond;
        const std::int64_t lateness = sleeper_->sleep();
        (afterCycle ? loopMissed_ : sleeperMissed_) += sleeper_->missed() - before;
        if (sleeper_->tick() / perSecond != second) finishSecond();
        second_.push_back(lateness);
        if (!sleeping_) return {sleeper_->tick() * Period, lateness, 1, false};
    }
    return {0, 0, 1, true};
}

AlternatingClock::Measured AlternatingClock::take() {
    const std::lock_guard lock{mutex_};
    return std::exchange(measured_, {});
}

}  // namespace cortex::observers
