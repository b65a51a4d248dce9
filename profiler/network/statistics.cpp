// SPDX-License-Identifier: Apache-2.0
#include "statistics.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace cortex::network {

std::int64_t steadyNow() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

double percentile(std::vector<std::int64_t> values, double part) {
    if (values.empty()) return 0;
    const auto rank =
        static_cast<std::ptrdiff_t>(std::ceil(part * static_cast<double>(values.size())) - 1);
    const auto place = values.begin() + std::max<std::ptrdiff_t>(rank, 0);
    std::ranges::nth_element(values, place);
    return static_cast<double>(*place) * 1e-3;
}

double median(const std::vector<std::int64_t>& values) { return percentile(values, 0.5); }

}  // namespace cortex::network
