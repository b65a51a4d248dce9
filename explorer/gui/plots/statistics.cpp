// SPDX-License-Identifier: Apache-2.0
#include "plots/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::gui {

namespace {

// Of the straight line that fits best, by the times of the samples: a busy agent leaves some out.
double slopeOf(const DrawnLine& line, std::int64_t first, std::int64_t last, double mean) {
    const std::int64_t begin = line.time->table.utcAt(first);
    TimeWalk walk{line.time->table};
    double count = 0, times = 0, squares = 0, common = 0;
    for (std::int64_t i = first; i < last; ++i) {
        const double value = line.value(i) - mean;
        if (std::isnan(value)) continue;
        const double time = static_cast<double>(walk.utcAt(i) - begin) * 1e-9;
        ++count;
        times += time;
        squares += time * time;
        common += time * value;
    }
    const double spread = squares - times * times / count;
    return spread > 0 ? common / spread : 0;
}

}  // namespace

// Two passes: sums of squares of large numbers would lose what little they differ by.
Statistics statisticsOf(const DrawnLine& line, TimeSpan span) {
    Statistics result;
    if (!line.any()) return result;
    const auto [first, last] = line.inside(span);
    double sum = 0;
    Extent extent;
    for (std::int64_t i = first; i < last; ++i) {
        const double value = line.value(i);
        extent.add(value);
        std::isnan(value) ? ++result.missing : ++result.count;
        if (!std::isnan(value)) sum += value;
    }
    if (result.count == 0) return result;
    const auto count = static_cast<double>(result.count);
    result.length = line.time->secondsAt(line.ring->behindPresent(last) - 1) -
                    line.time->secondsAt(line.ring->nextPresent(first, last));
    result.min = extent.min;
    result.max = extent.max;
    result.mean = sum / count;
    double squares = 0;
    for (std::int64_t i = first; i < last; ++i) {
        const double value = line.value(i) - result.mean;
        if (!std::isnan(value)) squares += value * value;
    }
    result.deviation = result.count > 1 ? std::sqrt(squares / (count - 1)) : 0;
    result.slope = slopeOf(line, first, last, result.mean);
    return result;
}

}  // namespace cortex::gui
