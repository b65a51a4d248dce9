// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <cstdint>
#include <vector>

namespace cortex::profiler {

// Distribution of times on a logarithmic scale, 512 bins an octave (0.2 %); mean, deviation and
// maximum are exact. add() takes ns and does not allocate; all else is in us.
class Histogram {
public:
    Histogram() : bins_(perOctave * octaves) {}

    void add(std::int64_t nanoseconds, std::uint64_t times = 1);

    std::uint64_t count() const { return count_; }
    double mean() const;
    double deviation() const;  // standard
    double max() const { return static_cast<double>(greatest_) * 1e-3; }
    double percentile(double part) const;  // of (0, 1]; 0 where there is nothing
    // Share of the values above x, at x that are 2 % apart; none at zero, for logarithmic axes.
    std::vector<Point> shareAbove() const;

private:
    static constexpr std::uint64_t perOctave = 512, octaves = 28;  // up to 2 minutes
    static double upperEdge(std::size_t bin);

    std::vector<std::uint32_t> bins_;
    std::uint64_t count_ = 0;
    double sum_ = 0, squares_ = 0;
    std::int64_t greatest_ = 0;
};

}  // namespace cortex::profiler
