// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace cortex::test {

// What a test waits for on a busy machine. None waits so long unless it fails.
inline constexpr std::chrono::seconds patience{60};

// What a program has that a test starts, less than a case of the gate has.
inline constexpr std::chrono::seconds longestRun{110};

}  // namespace cortex::test
