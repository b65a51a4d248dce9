// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/live.hpp"

#include <chrono>
#include <string>
#include <vector>

// Who uses the tools on the network, as they say.
namespace cortex::cli {

inline constexpr std::chrono::milliseconds toMeetPeople{1000};

// Waits until it is known who uses these tools, or for all tools that were found until they have
// said who they are; in the second after we joined for those, too, that are found now.
void waitForPeople(Live& live, const std::vector<std::string>& names,
                   std::chrono::milliseconds limit = toMeetPeople);

// Empty where it is not known.
std::string personAt(Live& live, const std::string& name);
// "alice (cortex@vm.26573-41c8f2)", or the name of the agent or tool alone.
std::string whoIs(Live& live, const std::string& name);

// The leases of all agents, as far as they have come.
std::vector<comms::ShownLease> shownLeases(const Live& live);
// Waits for them. What lacks then, or "".
std::string waitForLeases(Live& live);

}  // namespace cortex::cli
