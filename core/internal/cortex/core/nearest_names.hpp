// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace cortex {

// "nearest of: a, b, c" for an unknown name; at most three, by edit distance; "" if none is near.
std::string nearestNames(std::string_view wrong, std::span<const std::string> valid);

// The nearest of them; "" if none is near.
std::string nearestName(std::string_view wrong, std::span<const std::string> valid);

}  // namespace cortex
