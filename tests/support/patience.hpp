// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace cortex::test {

// What a test waits for on a busy machine. None waits so long unless it fails.
inline constexpr std::chrono::seconds patience{60};

}  // namespace cortex::test
