// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/live.hpp"
#include "verbs/verb_registration.hpp"

namespace cortex::cli {

// The options that select a network; in a shell only how long to wait.
void addNetwork(CLI::App& verb, NetworkArguments& network, const std::shared_ptr<Session>& session);
// The verbs of live_verbs.hpp.
void addLiveVerbs(Verbs& verbs);

}  // namespace cortex::cli
