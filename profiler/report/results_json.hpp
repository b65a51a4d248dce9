// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <string>
#include <string_view>

namespace cortex::profiler {

// What is not a number is written as null and read as not a number.
std::string jsonText(const Results& results);

// Throws cortex::Error with what was expected where: "(/figures/2/x) …". Unknown keys are ignored.
Results resultsOf(std::string_view json);

}  // namespace cortex::profiler
