// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"
#include "cortex/core/type_model.hpp"

#include <span>

namespace cortex {

// What the items of a type say of each other: derivativeOf, safe="stop", and limits that must be
// equal. Only what this type states or joins itself: its parents' mistakes are found with them.
void checkDerivatives(const Type& type, std::span<const Type* const> parents, Report& report);

}  // namespace cortex
