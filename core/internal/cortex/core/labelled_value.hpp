// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"
#include "cortex/core/type_model.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cortex {

// What a person writes for an item: as parseValue(), and labels may stand for their numbers. `why`
// lists the labels where the text is neither.
std::optional<Value> parseItemValue(const DataItem& item, std::string_view text, std::string& why);

// The text with the nearest label in the place of each word that is none and no number; "" where
// one of them has none that is near.
std::string withNearestLabels(const DataItem& item, std::string_view text);

// What speaks against an item having a value of its kind and length: "is out of the range 0 to 1";
// "" if nothing does.
std::string valueError(const DataItem& item, const Value& value);

// Only its labelled numbers are values of the item: it has labels and no range. So they are its
// range.
bool isClosed(const DataItem& item) CORTEX_REALTIME;

// How a value is out of the range of its item: "above 2", "below 0", "none of its labels"; of an
// array the first that is. "": it is not. What is no number is above and below nothing.
std::string outsideText(const DataItem& item, const Value& value);

// The labels of an int, one for each element; "" where a number has none. No labels: empty.
std::vector<std::string> labelsOf(const DataItem& item, const Value& value);

}  // namespace cortex
