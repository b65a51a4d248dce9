// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace cortex::common {

// UTC ns as ISO 8601, with so many digits of a second, 0 to 9; what is below them is cut off.
std::string utcText(std::int64_t utc, int digits = 3);  // "2026-11-20T10:00:00.123Z"

}  // namespace cortex::common
