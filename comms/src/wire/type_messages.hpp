// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_description.hpp"

#include "wire/messages.hpp"

// Types as messages. What a reader needs to lay out data is in fields of its own; the rest is in
// attributes as in XML.
namespace cortex::comms {

TypeMessage typeMessage(const TypeDescription& type);
TypeDescription typeDescription(const TypeMessage& message);

}  // namespace cortex::comms
