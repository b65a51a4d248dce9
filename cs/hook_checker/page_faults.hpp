// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace cortex::cs {

// Every page that this thread meets for the first time is noted from now on. What was read from
// files is brought in before, and what the program has written. Why not; "": it is so.
std::string trapPageFaultsOfThisThread();

}  // namespace cortex::cs
