// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verbs/verb_registration.hpp"

namespace cortex::cli {

// What a shell has beyond the verbs: take, release, handover, ask and its answers, help, quit.
void addShellCommands(Verbs& verbs, bool& leaves);

}  // namespace cortex::cli
