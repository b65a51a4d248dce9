// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "text/output.hpp"

#include <functional>

#include <CLI/CLI.hpp>

namespace cortex::cli {

// Adds `security` with its verbs; the one that is chosen sets `run`.
void addSecurityVerbs(CLI::App& app, bool& json, std::function<Exit()>& run);

}  // namespace cortex::cli
