// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::explorer {

// Who holds control of what, as the agent itself shows it.
struct Lease {
    std::string prefix, holder;
    std::int64_t since = 0;  // UTC ns
    double seconds = 0;      // since then
};

// By prefix; empty where nothing is held, or nothing is known of the agent.
std::vector<Lease> leasesOf(const AgentFrame& agent);

// The lease that somebody else has on this path, or on a part of what lies below it.
std::optional<Lease> leaseOfOthers(const AgentFrame& agent, std::string_view path,
                                   std::string_view self);

// Whether the agent has a simplex of its own at or below the path.
bool hasBelow(const AgentFrame& agent, std::string_view prefix);

}  // namespace cortex::explorer
