// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_view.hpp"

#include "cortex/core/path.hpp"

#include <algorithm>

namespace cortex::comms {
namespace {

constexpr std::int64_t stalePeriods = 3;
// A shorter time would judge the scheduling of the mirror itself.
constexpr std::chrono::milliseconds leastPatience{50};

}  // namespace

bool MirrorView::shows(std::string_view path) const {
    return std::ranges::any_of(prefixes,
                               [&](const auto& prefix) { return isAtOrBelow(path, prefix); });
}

std::chrono::nanoseconds MirrorView::patience(std::int64_t period) const {
    const std::chrono::nanoseconds own{rate == 0 ? period : 1'000'000'000 / rate};
    return std::max<std::chrono::nanoseconds>(stalePeriods * own, leastPatience);
}

std::uint32_t viewClass(std::uint32_t rate) {
    if (rate == 0 || rate > 100) return 0;
    if (rate > 30) return 100;
    return rate > 5 ? 30 : 5;
}

}  // namespace cortex::comms
