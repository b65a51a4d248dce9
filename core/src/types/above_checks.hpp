// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"
#include "cortex/core/type_model.hpp"

#include <span>
#include <string>

namespace cortex {

// What the items of a type say of each other by above: whether both are constant single numbers of
// one kind and unit, and whether the default is above that of the other. Only what this type states
// or joins itself.
void checkAbove(const Type& type, std::span<const Type* const> parents, Report& report);

// The item that this one must be above; null where it has none, or one that no value can be
// compared with, which is a finding of the type.
const DataItem* boundBelow(const Type& type, const DataItem& item);

// "0.05 s"
std::string quantityText(const DataItem& item, const Value& value);

}  // namespace cortex
