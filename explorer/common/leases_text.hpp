// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/lease_client.hpp"

#include <string>
#include <vector>

namespace cortex::common {

// What leases are on: "everything of robot, /drive of mixer". What lies below another one of the
// same agent goes without saying.
std::string leasesText(const std::vector<comms::LeaseClient::Lease>& leases);

}  // namespace cortex::common
