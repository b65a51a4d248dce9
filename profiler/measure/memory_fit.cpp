// SPDX-License-Identifier: Apache-2.0
#include "memory_fit.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::profiler {

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
