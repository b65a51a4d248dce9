// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace cortex::common {

// What timeFrom() understands, for who wrote something else.
inline constexpr const char* timeForms =
    "90s, 10m, 1h, 2d (ago), 14:05, 14:05:10, 2026-11-29, 2026-11-29T14:05 or "
    "2026-11-29T14:05:10Z, in UTC, of the years 1970 to 2261";

// A time as people write it, in UTC ns; seconds and what is ago may have decimals. A time of day is
// the last one: of today, or of yesterday where it would be in the future. A date may be in the
// future. None: it is no time, or one before 1970.
std::optional<std::int64_t> timeFrom(std::string_view words, std::int64_t nowUtcNs);

}  // namespace cortex::common
