// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::comms {

using Moment = std::chrono::steady_clock::time_point;

// What a tool looks at: the simplexes at and below some paths, in one class of rates.
struct MirrorView {
    std::vector<std::string> prefixes;  // none: nothing
    std::uint32_t rate = 30;            // of the class; 0: every cycle

    bool operator==(const MirrorView&) const = default;
    bool shows(std::string_view path) const;
    // How long a value may stay away until it is called stale; `period` is that of the agent, ns.
    std::chrono::nanoseconds patience(std::int64_t period) const;
};

// 5, 30 or 100, whichever is at least this; 0, every cycle, above and for 0.
std::uint32_t viewClass(std::uint32_t rate);

}  // namespace cortex::comms
