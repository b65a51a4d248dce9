// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/structure.hpp"

#include <span>
#include <string>
#include <string_view>

namespace cortex {

// Throws Error: `message`, then the names nearest to `wrong`, or all of them if none is near.
[[noreturn]] void throwUnknown(const std::string& message, std::string_view wrong,
                               std::span<const std::string> valid);

// Throws Error naming the nearest items if the simplex has no such item.
const ItemLayout& itemAt(const SimplexInfo& simplex, std::string_view item);
// Throws Error naming the nearest paths.
std::uint32_t simplexAt(const Structure& structure, std::string_view path);

std::string shapeOf(const DataItem& item);  // "float", "int array of 8"

}  // namespace cortex
