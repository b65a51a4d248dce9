// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/structure.hpp"

#include "tasks/hook.hpp"

namespace cortex::cs {

// Once on each loop thread, before its first cycle: a crash on this thread from now on prints the
// path of the simplex and the hook to stderr, on a stack of its own. Then the process ends by the
// same signal, or by the handler that the program had for it. Both arguments outlive the thread.
void reportCrashesOfThisThread(const Structure& structure, const Position& position);

// Whether this thread is one that runs hooks.
bool isLoopThread();

}  // namespace cortex::cs
