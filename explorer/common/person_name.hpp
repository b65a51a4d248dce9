// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror_data.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace cortex::common {

// Who uses this program: what --name gave, otherwise user@host. Throws Error with a remedy for what
// no tool may tell of itself: more than 63 bytes, control characters, no UTF-8.
std::string personName(const std::string& given);

// The same in what a command has for it: of "user@host" the user alone where all is too long for
// that, and otherwise the beginning.
inline constexpr std::size_t longestInCommand = 31;  // bytes
std::string nameInCommand(const std::string& person);

// A name that came from elsewhere as it may be printed: what a terminal would obey, and what turns
// the direction of the text behind it, becomes visible escapes.
std::string shownName(const std::string& name);

// "alice (cortex-explorer@desk.4711-5e1f0a)"; without a person the name of the tool or agent alone.
// The person is as told, so the name always stands beside it.
std::string whoText(const std::string& name, const std::string& person);

// Who uses the tool that holds a lease, as it says; empty where nothing is known.
std::string personOf(const std::vector<comms::ToolStatus>& tools, const std::string& holder);

}  // namespace cortex::common
