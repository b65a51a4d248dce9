// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/lease_client.hpp"

#include <string>

namespace cortex::cli {

std::string hostOf(const comms::Mirror& mirror, const std::string& holder);  // "" if not known
std::string holderText(const comms::Mirror& mirror, const comms::ShownLease& lease);

}  // namespace cortex::cli
