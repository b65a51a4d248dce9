// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace cortex::profiler {

// Looks once a second how far apart the first two CPUs are while something is measured.
class Distances {
public:
    void look();
    // `id` and `what` of what was measured.
    void add(const std::string& id, const std::string& what, Results& results) const;

private:
    std::chrono::steady_clock::time_point next_;
    std::vector<double> nanoseconds_;
};

}  // namespace cortex::profiler
