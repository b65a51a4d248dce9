// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "measure/measurement.hpp"

namespace cortex::profiler {

// Memory, start-up and cycle of 100 to 100,000 empty simplexes. False: told to stop.
bool measureSizes(const RunOptions& options, Progress& progress, Results& results);

}  // namespace cortex::profiler
