// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/live.hpp"

#include <string>
#include <vector>

// Who uses the tools on the network, as they say.
namespace cortex::cli {

// Waits until all tools that were found have said who uses them; in the first second on the network
// also for those that are found now.
void waitForPeople(Live& live);
// The same until it is known of these tools, and not as long: they may never say it.
void waitForPeople(Live& live, const std::vector<std::string>& names);

// Empty where it is not known.
std::string personAt(Live& live, const std::string& name);
// "alice (cortex@vm.26573-41c8f2)", or the name of the agent or tool alone.
std::string whoIs(Live& live, const std::string& name);

// The leases of all agents, as far as they have come.
std::vector<comms::ShownLease> shownLeases(const Live& live);
// Waits for them. What lacks then, or "".
std::string waitForLeases(Live& live);

}  // namespace cortex::cli
