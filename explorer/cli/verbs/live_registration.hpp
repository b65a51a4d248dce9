// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/live.hpp"
#include "text/output.hpp"

#include <functional>

#include <CLI/CLI.hpp>

namespace cortex::explorer {

// The verbs of live_verbs.hpp. A verb that was chosen sets `run`; `json` is the flag of all verbs.
void addNetwork(CLI::App& verb, NetworkArguments& network);
void addLiveVerbs(CLI::App& app, bool& json, std::function<Exit()>& run);

}  // namespace cortex::explorer
