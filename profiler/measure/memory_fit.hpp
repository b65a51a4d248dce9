// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <span>

namespace cortex::profiler {

// A straight line through points by least squares, and how far the farthest is from it as a part of
// what y ranges over.
struct Line {
    double slope = 0, offset = 0, residual = 0;
};
Line fit(std::span<const Point> points);

}  // namespace cortex::profiler
