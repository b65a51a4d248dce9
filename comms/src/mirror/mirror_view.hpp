// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include "peers/moment.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::comms {

// The rates of the streams of views, in Hz, from the fastest to the slowest. 0: every cycle.
inline constexpr std::array<std::uint32_t, 4> viewRates{0, 100, 30, 5};

// What a tool looks at: the simplexes at and below some paths, those of each stream by its index in
// `viewRates`.
struct MirrorView {
    std::array<std::vector<std::string>, viewRates.size()> prefixes;

    bool operator==(const MirrorView&) const = default;
    bool empty() const;  // nothing is looked at
    // The stream of a path: the fastest of those that it is asked for on. None: it is not shown.
    std::optional<std::size_t> streamOf(std::string_view path) const;
    bool shows(std::string_view path) const { return streamOf(path).has_value(); }
};

// A prefix that a faster one covers is left out.
MirrorView viewOf(const std::vector<Viewed>& views);

// How long a value of a stream may be missing before it is stale: three times as long as it takes
// to come again. `period` is that of the agent in ns, `every` the cycles between two writings.
std::chrono::nanoseconds patienceOf(std::size_t stream, std::int64_t period,
                                    std::uint32_t every = 1);

// The slowest stream that is not below the rate. That of every cycle for 0 and above 100.
std::size_t streamFor(std::uint32_t rate);

}  // namespace cortex::comms
