// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include "text/output.hpp"

namespace cortex::cli {

Json typeSummaryJson(const Type& type);                   // an entry of schemas/types.json
Json typeJson(const TypeModel& types, const Type& type);  // schemas/type.json

std::vector<std::string> childrenOf(const TypeModel& types, const Type& type);

}  // namespace cortex::cli
