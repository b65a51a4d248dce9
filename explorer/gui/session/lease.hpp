// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace cortex::gui {

// By prefix; empty where nothing is held, or nothing is known of the agent.
std::vector<comms::ShownLease> leasesOf(const AgentFrame& agent);

// The lease that somebody else has on this path, or on a part of what lies below it.
std::optional<comms::ShownLease> leaseOfOthers(const AgentFrame& agent, std::string_view path,
                                               std::string_view self);

// Whether the agent has a simplex of its own at or below the path.
bool hasBelow(const AgentFrame& agent, std::string_view prefix);

}  // namespace cortex::gui
