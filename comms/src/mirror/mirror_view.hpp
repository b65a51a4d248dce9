// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "peers/moment.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::comms {

// What a tool looks at: the simplexes at and below some paths, in one class of rates.
struct MirrorView {
    std::vector<std::string> prefixes;  // none: nothing
    std::uint32_t rate = 30;            // of the class; 0: every cycle

    bool operator==(const MirrorView&) const = default;
    bool shows(std::string_view path) const;
    // How long a value may be missing before it is stale; `period` is that of the agent in ns.
    std::chrono::nanoseconds patience(std::int64_t period) const;
};

// The least of 5, 30 and 100 that is not below the rate. 0 (every cycle) for 0 and above 100.
std::uint32_t viewClass(std::uint32_t rate);

}  // namespace cortex::comms
