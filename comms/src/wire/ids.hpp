// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agreement.hpp"

#include "wire/messages.hpp"

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

// Names of 16 octets for the keys of topics, and hashes by which a receiver knows that it has
// everything (docs/protocol.md).
namespace cortex::comms {

// The id of the parts, joined by line ends.
Id idOf(std::initializer_list<std::string_view> parts);

Id agentId(std::string_view agent);
// The id of a sample: of its agent and the name or path of its first type or simplex.
Id modelId(const Model& sample);
Id linkId(std::string_view sender, std::string_view target);

Id typesHash(const std::map<std::string, TypeHash>& types);
// The result does not depend on the order of the simplexes.
Id structureHash(const std::vector<SimplexMessage>& simplexes);

}  // namespace cortex::comms
