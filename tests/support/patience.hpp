// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace cortex::test {

// What a test waits for on a busy machine. None waits so long unless it fails.
inline constexpr std::chrono::seconds patience{60};

// A case that judges time does so in the build that users get; in one with a sanitizer it judges
// only what came.
#ifdef CORTEX_AT_FULL_SPEED
inline constexpr bool judgesTime = true;
#else
inline constexpr bool judgesTime = false;
#endif

// What a program has that a test starts, less than a case of the gate has.
inline constexpr std::chrono::seconds longestRun{110};

}  // namespace cortex::test
