// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <string>
#include <vector>

namespace cortex::profiler {

// One page that needs nothing else: no network, no scripts, printable. `pictures`: SVG of each
// figure, empty where there is none.
std::string htmlReport(const Results& results, const std::vector<std::string>& pictures);

}  // namespace cortex::profiler
