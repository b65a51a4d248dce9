// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/live.hpp"

#include <string>

namespace cortex::cli {

// Views the own simplexes of all agents, and waits for their values.
void viewOwnSimplexes(Live& live);
// Of a viewed agent: the CPUs that its loop is pinned to, and claims on its host. "": none, or it
// does not say.
std::string pinnedCpus(const Live& live, const std::string& agent);

}  // namespace cortex::cli
