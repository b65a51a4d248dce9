// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <compare>
#include <cstddef>
#include <string>
#include <vector>

namespace cortex::gui {

// An active simplex: several agents may have one path.
struct SimplexOf {
    std::string agent, path;
    auto operator<=>(const SimplexOf&) const = default;
};

// Who of some simplexes starts before whom, by their places among them. As an agent does it for all
// below a path, so it is here for any of them, also across agents: whoever relies on another one,
// directly or through what neither of them is, starts after it is Active. What is read a tick late
// is not relied on, and who is Active holds nobody back. Of agents that rely on each other in a
// circle none waits for the other.
using StartOrder = std::vector<std::vector<std::size_t>>;
StartOrder startOrder(const Frame& frame, const std::vector<SimplexOf>& all);

// How far each of them is. Failed holds back who relies on it; Left does not: somebody else decides
// whether it starts.
enum class StartStep { Waits, Asked, Active, Left, Failed };

// Those that may be asked now.
std::vector<std::size_t> mayStart(const StartOrder& order, const std::vector<StartStep>& steps);

}  // namespace cortex::gui
