// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/session.hpp"

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace cortex::cli {

// What the last word of the text before the cursor may become: verbs, options, and what the agents
// that are known now have. It waits for nothing.
std::vector<std::string> completionsOf(const std::string& before, const CLI::App& verbs,
                                       Session& session);

}  // namespace cortex::cli
