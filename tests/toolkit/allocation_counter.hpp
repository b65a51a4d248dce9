// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace cortex::toolkit::test {

// Allocations of this thread so far.
std::uint64_t allocationCount();

}  // namespace cortex::toolkit::test
