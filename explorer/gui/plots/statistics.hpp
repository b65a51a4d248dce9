// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/drawn_line.hpp"

namespace cortex::gui {

// Of all samples in a stretch of time, at full rate.
struct Statistics {
    std::int64_t count = 0, missing = 0;
    double length = 0;  // s, from the first of them to the last
    double min = 0, mean = 0, max = 0, deviation = 0;
    double slope = 0;  // of the straight line through them, per second
};

Statistics statisticsOf(const DrawnLine& line, TimeSpan span);

}  // namespace cortex::gui
