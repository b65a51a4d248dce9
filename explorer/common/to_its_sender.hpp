// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace cortex::common {

// An agent says why it refuses a command to all that read its events. To its sender: "withdrawn by
// a later shutdown of its sender" is "withdrawn by your shutdown".
std::string toItsSender(const std::string& why);

}  // namespace cortex::common
