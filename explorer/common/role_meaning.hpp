// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <string_view>

namespace cortex::common {

// For who reads that word for the first time.
inline constexpr const char* simplexMeaning =
    "A simplex is one part of a system, with a path: a device, a controller, an axis, or data.";

// What data of this role are, in a few words; "" of any other.
std::string_view roleMeaning(Role role);

}  // namespace cortex::common
