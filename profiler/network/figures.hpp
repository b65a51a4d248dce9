// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "measure/measurement.hpp"

#include <cstdint>
#include <string>
#include <vector>

// The parts of what distribution costs; each starts and ends what it measures, in this domain and
// the next.
namespace cortex::network {

// Thrown through a part that is told to stop.
struct Stopped {};

struct Options {
    int seconds = 2;  // of each measurement
    int rounds = 10;  // of discovery
    int domain = 1;
    bool alone = false;  // on a loopback interface of its own
    profiler::Progress& progress;
    profiler::Results& results;

    void step(double part, const std::string& doing) const;
    void add(profiler::Quantity quantity) const;
};

// Median, with p99 as a quantity of its own; ns in, us out.
void addTimes(const Options& options, profiler::Quantity quantity,
              const std::vector<std::int64_t>& times);

void loopCost(const Options& options);
void latency(const Options& options);
void discovery(const Options& options);
void wire(const Options& options);
void footprint(const Options& options);

}  // namespace cortex::network
