// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "measure/measurement.hpp"

#include <cstdint>
#include <string>
#include <vector>

// The parts of what distribution costs; each starts and ends what it measures, in this domain and
// the next.
namespace cortex::profiler {

// Thrown through a part that is told to stop.
struct Stopped {};

struct CommsRun {
    int seconds = 2;  // of each measurement
    int domain = 1;
    Progress& progress;
    Results& results;

    void step(double part, const std::string& doing) const;
};

double medianMicroseconds(const std::vector<std::int64_t>& times);  // ns in
// Median, with p99 as a quantity of its own; ns in, us out.
void addTimes(const CommsRun& run, Quantity quantity, const std::vector<std::int64_t>& times);

void measureLoopCost(const CommsRun& run);
void measureTransit(const CommsRun& run);

}  // namespace cortex::profiler
