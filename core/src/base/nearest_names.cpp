// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/nearest_names.hpp"

#include "base/bounds.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace cortex {

namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Insertions, deletions, replacements and swaps of neighbours, without regard to case.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
    std::iota(above.begin(), above.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = lower(a[i - 1]) == lower(b[j - 1]);
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0U : 1U)});
            const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                                 lower(a[i - 2]) == lower(b[j - 1]);
            if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before = std::exchange(above, row);
    }
    return above[b.size()];
}

// "minimum" for "min".
bool isBeginning(std::string_view a, std::string_view b) {
    constexpr std::size_t least = 3;
    return std::min(a.size(), b.size()) >= least && (a.starts_with(b) || b.starts_with(a));
}

constexpr std::size_t mostNamed = 3;

// The nearest first.
std::vector<std::string_view> namesNear(std::string_view wrong,
                                        std::span<const std::string> valid) {
    if (wrong.empty() || wrong.size() > 2 * bounds::nameLength) return {};
    const std::size_t limit = std::max<std::size_t>(1, (wrong.size() + 1) / 3);
    std::vector<std::pair<std::size_t, std::string_view>> near;
    for (const std::string& candidate : valid) {
        const bool beginning = isBeginning(wrong, candidate);
        const auto [shorter, longer] = std::minmax({wrong.size(), candidate.size()});
        if (longer - shorter > limit && !beginning) continue;
        const std::size_t distance = editDistance(wrong, candidate);
        if (distance <= limit || beginning) near.emplace_back(std::min(distance, limit), candidate);
    }
    std::ranges::sort(near);
    near.erase(std::ranges::unique(near).begin(), near.end());
    if (near.size() > mostNamed) near.resize(mostNamed);
    std::vector<std::string_view> names;
    for (const auto& [distance, candidate] : near) names.push_back(candidate);
    return names;
}

}  // namespace

std::string nearestNames(std::string_view wrong, std::span<const std::string> valid) {
    std::string result;
    for (const std::string_view name : namesNear(wrong, valid)) {
        result += result.empty() ? "nearest of: " : ", ";
        result += name;
    }
    return result;
}

std::string nearestName(std::string_view wrong, std::span<const std::string> valid) {
    const auto names = namesNear(wrong, valid);
    return names.empty() ? "" : std::string{names.front()};
}

}  // namespace cortex
