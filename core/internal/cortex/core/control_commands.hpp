// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

// The commands that need no control of the part that they go to (docs/leases.md).
namespace cortex {

inline constexpr std::array<std::string_view, 4> controlCommands{
    "takeControl", "renewControl", "handOverControl", "releaseControl"};
inline constexpr std::array<std::string_view, 2> urgentCommands{"shutdown", "cancel"};

// Of an agent: it takes, keeps or gives away control.
inline bool isControlCommand(std::string_view name) {
    return std::ranges::find(controlCommands, name) != controlCommands.end();
}

// It stops something: it waits for nothing either.
inline bool isUrgentCommand(std::string_view name) {
    return std::ranges::find(urgentCommands, name) != urgentCommands.end();
}

}  // namespace cortex
