// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace cortex::profiler {

// For main(), first of all: where this process is one that a measurement started, what it does
// until its standard input ends, and its exit code.
std::optional<int> playChildRole(int argc, char** argv);

}  // namespace cortex::profiler
