// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/lease_client.hpp"

#include <optional>
#include <vector>

namespace cortex::comms {

// The leases of an agent, by prefix; none: it does not show them, as it is lost, or as nobody looks
// at it or nothing has come yet. Then nobody knows who holds what.
std::optional<std::vector<ShownLease>> shownLeases(const AgentStatus& agent,
                                                   const AgentImage& image);

}  // namespace cortex::comms
