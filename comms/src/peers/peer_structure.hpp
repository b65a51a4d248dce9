// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"
#include "cortex/core/structure.hpp"

#include "wire/messages.hpp"

#include <map>
#include <memory>
#include <string>

namespace cortex::comms {

// Builds the structure of another agent, with the indexes and layouts that its owner has.
// Everything that the agent says of its simplexes is checked; what is wrong is an error in the
// report.
std::shared_ptr<Structure> buildPeerStructure(
    const std::string& agent, TypeModel types,
    const std::map<std::string, SimplexMessage>& simplexes, Report& report);

}  // namespace cortex::comms
