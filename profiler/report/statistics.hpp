// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cortex::profiler {

double median(std::vector<double> values);                   // 0 of none
double percentile(std::vector<double> values, double part);  // of (0, 1]; 0 of none

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

// A straight line through points by least squares, and how far the farthest is from it as a part of
// what y ranges over.
struct Line {
    double slope = 0, offset = 0, residual = 0;
};
Line fit(std::span<const Point> points);

}  // namespace cortex::profiler
