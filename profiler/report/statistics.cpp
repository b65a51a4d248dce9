// SPDX-License-Identifier: Apache-2.0
#include "report/statistics.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace cortex::profiler {

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

double percentile(std::vector<double> values, double part) {
    if (values.empty()) return 0;
    const auto rank =
        static_cast<std::ptrdiff_t>(std::ceil(part * static_cast<double>(values.size())) - 1);
    const auto place = values.begin() + std::max<std::ptrdiff_t>(rank, 0);
    std::ranges::nth_element(values, place);
    return *place;
}

// Bin: octave and the next nine bits.
void Histogram::add(std::int64_t nanoseconds, std::uint64_t times) {
    if (times == 0) return;
    const std::int64_t value = std::max<std::int64_t>(nanoseconds, 0);
    const auto shifted = static_cast<std::uint64_t>(value) + perOctave;
    const auto octave = static_cast<std::uint64_t>(std::bit_width(shifted)) - 10;
    const std::uint64_t bin = octave * perOctave + (shifted >> octave) - perOctave;
    bins_[std::min<std::uint64_t>(bin, bins_.size() - 1)] += static_cast<std::uint32_t>(times);
    count_ += times;
    const auto number = static_cast<double>(value);
    sum_ += number * static_cast<double>(times);
    squares_ += number * number * static_cast<double>(times);
    greatest_ = std::max(greatest_, value);
}

double Histogram::upperEdge(std::size_t bin) {
    const std::uint64_t octave = bin / perOctave;
    const std::uint64_t edge = (bin % perOctave + perOctave + 1) << octave;
    return static_cast<double>(edge - perOctave - 1) * 1e-3;
}

double Histogram::mean() const {
    return count_ == 0 ? 0 : sum_ / static_cast<double>(count_) * 1e-3;
}

double Histogram::deviation() const {
    if (count_ < 2) return 0;
    const double mean = sum_ / static_cast<double>(count_);
    return std::sqrt(std::max(0.0, squares_ / static_cast<double>(count_) - mean * mean)) * 1e-3;
}

double Histogram::percentile(double part) const {
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
        below += bins_[bin];
        if (bins_[bin] != 0 && static_cast<double>(below) >= part * static_cast<double>(count_)) {
            return std::min(upperEdge(bin), max());
        }
    }
    return 0;
}

std::vector<Point> Histogram::shareAbove() const {
    constexpr double apart = 1.02;
    std::vector<Point> points;
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
        if (bins_[bin] == 0) continue;
        below += bins_[bin];
        if (below == count_) break;
        const double x = upperEdge(bin);
        if (x <= 0 || (!points.empty() && x < points.back().x * apart)) continue;
        points.push_back({x, static_cast<double>(count_ - below) / static_cast<double>(count_)});
    }
    return points;
}

Line fit(std::span<const Point> points) {
    if (points.size() < 2) return {};
    const auto count = static_cast<double>(points.size());
    double x = 0, y = 0, xx = 0, xy = 0;
    for (const Point& each : points) {
        x += each.x;
        y += each.y;
        xx += each.x * each.x;
        xy += each.x * each.y;
    }
    Line line;
    line.slope = (count * xy - x * y) / (count * xx - x * x);
    line.offset = (y - line.slope * x) / count;
    const auto [least, most] = std::ranges::minmax_element(points, {}, &Point::y);
    if (most->y <= least->y) return line;
    for (const Point& each : points) {
        const double distance = std::abs(each.y - line.offset - line.slope * each.x);
        line.residual = std::max(line.residual, distance / (most->y - least->y));
    }
    return line;
}

}  // namespace cortex::profiler
