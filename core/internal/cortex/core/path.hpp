// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace cortex {

// A prefix of paths as people write it: slashes at its end do not count, so "/" is "".
constexpr std::string_view withoutEndSlashes(std::string_view prefix) {
    while (prefix.ends_with('/')) prefix.remove_suffix(1);
    return prefix;
}

// True where `prefix` names `path` or something above it: "/arm" is above "/arm/axis" but not above
// "/army". "/" and "" are above everything; whoever grants rights must not take "" for a prefix.
// Leases, rights, views and group commands all ask here.
constexpr bool isAtOrBelow(std::string_view path, std::string_view prefix) {
    prefix = withoutEndSlashes(prefix);
    return path.starts_with(prefix) &&
           (prefix.empty() || path.size() == prefix.size() || path[prefix.size()] == '/');
}

}  // namespace cortex
