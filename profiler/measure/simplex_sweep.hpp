// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "measure/sweep.hpp"

namespace cortex::profiler {

// Of duty and interval: pairs of simplexes, one command per cycle each, more and more of them. Made
// once for the same options.
const Sweep& simplexSweep(const RunOptions& options, Progress& progress, Results& results);
double simplexSweepSeconds(const RunOptions& options);
std::string simplexSweepSetup(const RunOptions& options, const Sweep& sweep);

}  // namespace cortex::profiler
