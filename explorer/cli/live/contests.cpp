// SPDX-License-Identifier: Apache-2.0
#include "live/contests.hpp"

#include "cortex/core/path.hpp"

#include "text/plain_text.hpp"

#include <algorithm>
#include <ranges>
#include <utility>

namespace cortex::cli {
namespace {

bool isSame(const comms::Contested& one, const comms::Contested& other) {
    return one.agents == other.agents && one.owner == other.owner && one.why == other.why;
}

}  // namespace

std::vector<std::string> contestLines(const std::vector<comms::Contested>& all, std::size_t most) {
    std::vector<std::pair<const comms::Contested*, std::size_t>> tops;
    for (const comms::Contested& each : all) {
        const auto top = std::ranges::find_if(tops, [&](const auto& known) {
            return isAtOrBelow(each.path, known.first->path) && isSame(each, *known.first);
        });
        if (top != tops.end())
            ++top->second;
        else
            tops.emplace_back(&each, 0);
    }
    std::vector<std::string> lines;
    for (const auto& [contest, below] : tops | std::views::take(most)) {
        lines.push_back(printable(contest->text) +
                        (below > 0 ? "; the same of " + plural(below, "path") + " below" : ""));
    }
    if (tops.size() > most) {
        lines.push_back("so it is with " + plural(tops.size() - most, "further path"));
    }
    return lines;
}

}  // namespace cortex::cli
