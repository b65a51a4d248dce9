// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

#include <array>

// MuJoCo ends the process on an error, and writes a file on a warning, unless the process handles
// them.
namespace cortex::physics {

using MujocoText = std::array<char, 1024>;

// Handles them in this process from now on: one outside of guarded() goes to who handled it before,
// or else to standard error, and an error then ends the process. Setup phase; any thread.
void handleMujocoErrors();

// Calls work(argument). False: MuJoCo had an error in it and `error` is its text; work() was left
// where it was, so it must own nothing that needs a destructor. Warnings are dropped: MuJoCo counts
// them.
bool guarded(void (*work)(void*), void* argument, MujocoText& error) CORTEX_REALTIME;

}  // namespace cortex::physics
