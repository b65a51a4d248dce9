// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verbs/verb_registration.hpp"

namespace cortex::cli {

// What a shell has for control between people: ask, withdraw, grant, refuse.
void addAskingCommands(Verbs& verbs);

}  // namespace cortex::cli
