// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/live.hpp"
#include "text/output.hpp"
#include "verbs/verb_registration.hpp"

#include <string>

namespace cortex::cli {

struct ShellOptions {
    NetworkArguments network;
    std::string file;  // "": what is typed, or standard input
    std::string name;  // of who uses it; "": user@host
    bool keepGoing = false;
};
// The verbs in one process, with one participant, until the end of its lines.
Exit runShell(const ShellOptions& options);

void addShell(Verbs& verbs);

}  // namespace cortex::cli
