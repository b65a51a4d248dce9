// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/lease_client.hpp"

#include "live/live.hpp"

#include <string>

namespace cortex::cli {

std::string hostOf(const comms::Mirror& mirror, const std::string& holder);  // "" if not known
std::string holderText(Live& live, const comms::ShownLease& lease);          // with its person

}  // namespace cortex::cli
