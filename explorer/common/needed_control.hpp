// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace cortex::common {

// What must be controlled for a command: its simplex, or what its prefix names if it goes to the
// simplex of an agent itself. None: it is free. Agents decide the same (router_control.cpp).
// `path`, `ofAgent`: the simplex, and whether it is its agent's own. `prefix`: the parameter of the
// command that has this name; null: it has none.
std::optional<std::string> neededControl(const std::string& path, bool ofAgent,
                                         std::string_view command, const DataItem* prefix,
                                         const comms::Mirror::Arguments& arguments);

// A prefix as it is compared: without slashes at its end, "/" for everything.
std::string withoutEnd(std::string_view prefix);

}  // namespace cortex::common
