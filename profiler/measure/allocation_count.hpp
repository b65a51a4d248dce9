// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace cortex::profiler {

// From now on each call of the allocator by this thread counts, giving back included. The malloc
// family is interposed by this program, operator new ends there too; under sanitizers nothing is.
void countAllocationsOfThisThread();
std::uint64_t countedAllocations();  // of all such threads

}  // namespace cortex::profiler
