// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/ask_news.hpp"
#include "live/live.hpp"

#include <string>
#include <vector>

// Control between people: they ask for it, and answer. All throw Failure that says what to do.
namespace cortex::cli {

// Asks all who hold a part of it and say who uses them. A line for each who holds one.
std::vector<std::string> askForControl(Live& live, const std::string& prefix);
std::string withdrawAsk(Live& live);  // what it was

// Who asks for something of ours; by name, or the only one.
Asked askedBy(Live& live, const std::string& name);
void grantControl(Live& live, const Asked& asked);
void refuseControl(Live& live, const Asked& asked);

// The agent or tool that is meant by its whole name or, if none is called so, by that of the person
// who uses it. Of others only what can be the name of a tool is taken.
std::string recipientOf(Live& live, const std::string& name);

}  // namespace cortex::cli
