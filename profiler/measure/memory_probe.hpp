// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

namespace cortex::profiler {

// What this process holds, in octets; looked at without allocating anything.
struct MemoryUse {
    double allocated = 0;     // by malloc and not given back, mappings of its own included
    double resident = 0;      // Rss of all mappings
    double proportional = 0;  // Pss: what is shared counts in part
    double dirty = 0;         // private and written to
};
MemoryUse memoryUse();

int openHandles();
int runningThreads();

}  // namespace cortex::profiler
