// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cortex {

// What a person writes for an item: as parseValue(), and labels may stand for their numbers. `why`
// lists the labels where the text is neither.
std::optional<Value> parseItemValue(const DataItem& item, std::string_view text, std::string& why);

// What speaks against an item having a value of its kind and length: "is out of the range 0 to 1";
// "" if nothing does.
std::string valueError(const DataItem& item, const Value& value);

// The labels of an int, one for each element; "" where a number has none. No labels: empty.
std::vector<std::string> labelsOf(const DataItem& item, const Value& value);

}  // namespace cortex
