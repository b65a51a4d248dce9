// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace cortex {

// Remembers where a loaded plug-in lies in memory; it stays there for good. Setup phase.
void notePlugin(void* library, const std::string& file);

// The file of the plug-in that has this address, null if none has. Neither allocates nor locks, so
// that handlers of signals may call it.
const char* pluginAt(const void* address);

}  // namespace cortex
