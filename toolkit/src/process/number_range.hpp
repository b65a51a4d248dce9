// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <limits>
#include <optional>
#include <variant>

namespace cortex::toolkit {

// What an item's type allows; where it states no bound all finite numbers.
struct NumberRange {
    static constexpr double most = std::numeric_limits<double>::max();
    double least = -most, greatest = most;

    NumberRange() = default;
    explicit NumberRange(const DataItem& item)
        : least{of(item.min, -most)}, greatest{of(item.max, most)} {}

private:
    static double of(const std::optional<Number>& bound, double otherwise) {
        if (!bound) return otherwise;
        return std::visit([](auto number) { return static_cast<double>(number); }, *bound);
    }
};

}  // namespace cortex::toolkit
