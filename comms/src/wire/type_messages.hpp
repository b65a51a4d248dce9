// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_description.hpp"

#include "wire/messages.hpp"

// Types as they travel. What a reader needs to lay out data stands in fields of its own, the rest
// in attributes as in XML.
namespace cortex::comms {

TypeMessage typeMessage(const TypeDescription& type);
TypeDescription typeDescription(const TypeMessage& message);

}  // namespace cortex::comms
