// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <ostream>

namespace cortex::cli {

void printTypeTree(std::ostream& stream, const TypeModel& types);
void printType(std::ostream& stream, const TypeModel& types, const Type& type);

}  // namespace cortex::cli
