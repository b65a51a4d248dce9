// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <string>

namespace cortex::profiler {

// One page that needs nothing else: no network, no scripts, light and dark, printable.
std::string htmlReport(const Results& results);

}  // namespace cortex::profiler
