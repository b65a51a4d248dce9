// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace cortex::cs {

// Every system call of this thread is noted from now on, and made. The filter stays on the thread
// for the rest of its life. It lets pass clock_gettime and what ends a thread; it refuses new
// threads and processes, which would have the filter as well.
void trapSystemCallsOfThisThread();

std::string nameOfSystemCall(long number);

}  // namespace cortex::cs
