// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <limits>
#include <optional>
#include <variant>

namespace cortex::cs {

inline double asDouble(const std::optional<Number>& bound, double otherwise) {
    if (!bound) return otherwise;
    return std::visit([](auto number) { return static_cast<double>(number); }, *bound);
}

// The range of a number; where none is stated all finite numbers.
inline double leastOf(const DataItem& item) {
    return asDouble(item.min, -std::numeric_limits<double>::max());
}
inline double greatestOf(const DataItem& item) {
    return asDouble(item.max, std::numeric_limits<double>::max());
}

}  // namespace cortex::cs
