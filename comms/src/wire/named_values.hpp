// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/value.hpp"

#include "wire/messages.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

// Values with their names, as they travel in commands, answers and constants.
namespace cortex::comms {

NamedValue namedValue(const std::string& name, const Value& value);
std::vector<NamedValue> namedValues(const std::map<std::string, Value>& values);

// Empty if the kind does not exist, or if the elements are of another kind.
std::optional<Value> valueOf(const NamedValue& named);
// Empty if one of them is wrong or if a name occurs twice.
std::optional<std::map<std::string, Value>> valuesOf(const std::vector<NamedValue>& named);

}  // namespace cortex::comms
