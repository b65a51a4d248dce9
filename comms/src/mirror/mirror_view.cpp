// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_view.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/path.hpp"

#include <algorithm>

namespace cortex::comms {
namespace {

constexpr std::int64_t stalePeriods = 3;
constexpr std::int64_t longestPeriod = std::int64_t{1} << 60U;  // ns: others say theirs
// A shorter time would judge the scheduling of the mirror itself.
constexpr std::chrono::milliseconds leastPatience{100};

bool isBelowAny(std::string_view path, const std::vector<std::string>& prefixes) {
    return std::ranges::any_of(prefixes,
                               [&](const auto& prefix) { return isAtOrBelow(path, prefix); });
}

}  // namespace

bool MirrorView::empty() const {
    return std::ranges::all_of(prefixes, [](const auto& each) { return each.empty(); });
}

std::optional<std::size_t> MirrorView::streamOf(std::string_view path) const {
    for (std::size_t i = 0; i < prefixes.size(); ++i) {
        if (isBelowAny(path, prefixes[i])) return i;
    }
    return {};
}

MirrorView viewOf(const std::vector<Viewed>& views) {
    MirrorView view;
    for (const Viewed& each : views) {
        auto& prefixes = view.prefixes[streamFor(each.rate)];
        prefixes.insert(prefixes.end(), each.prefixes.begin(), each.prefixes.end());
    }
    for (std::size_t slow = 1; slow < viewRates.size(); ++slow) {
        std::erase_if(view.prefixes[slow], [&](const std::string& prefix) {
            return std::any_of(view.prefixes.begin(),
                               view.prefixes.begin() + static_cast<std::ptrdiff_t>(slow),
                               [&](const auto& faster) { return isBelowAny(prefix, faster); });
        });
    }
    return view;
}

std::chrono::nanoseconds patienceOf(std::size_t stream, std::int64_t period, std::uint32_t every) {
    const std::uint32_t rate = viewRates.at(stream);
    const std::int64_t cycles = std::max<std::int64_t>(every, 1);
    const std::int64_t written =
        std::clamp<std::int64_t>(period, 0, longestPeriod / cycles) * cycles;
    const std::chrono::nanoseconds own{rate == 0 ? written : std::max(written, nsPerSecond / rate)};
    return std::max<std::chrono::nanoseconds>(stalePeriods * own, leastPatience);
}

std::size_t streamFor(std::uint32_t rate) {
    if (rate == 0 || rate > 100) return 0;
    if (rate > 30) return 1;
    return rate > 5 ? 2 : 3;
}

}  // namespace cortex::comms
