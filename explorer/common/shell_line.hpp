// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/network_options.hpp"

#include <string>
#include <vector>

// Lines for a POSIX shell that do what a program did.
namespace cortex::common {

// A word that the shell takes as it stands, otherwise within quotes.
std::string shellWord(const std::string& word);

// "cortex call /control/pose moveTo speedShare=0.25 --domain 7": the words, quoted where they must
// be, and the options of the network where they differ from the defaults of a shell.
std::string shellLine(const std::vector<std::string>& words, const comms::NetworkOptions& network);

}  // namespace cortex::common
