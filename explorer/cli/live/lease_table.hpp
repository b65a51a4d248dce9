// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cortex::explorer {

// A lease as an agent shows it among its data.
struct ShownLease {
    std::string agent, prefix, holder;
    std::int64_t since = 0;  // UTC ns
    double seconds = 0;      // since then, in the agent's own time
};

// The leases in the newest image of an agent; none if its own simplex is not viewed.
std::vector<ShownLease> leasesOf(const comms::Mirror& mirror, const comms::AgentStatus& agent);

std::string hostOf(const comms::Mirror& mirror, const std::string& holder);  // "" if not known
std::string holderText(const comms::Mirror& mirror, const ShownLease& lease);

}  // namespace cortex::explorer
