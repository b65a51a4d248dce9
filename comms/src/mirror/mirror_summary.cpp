// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_summary.hpp"

#include "mirror/mirror_view.hpp"
#include "wire/simplex_marks.hpp"

#include <algorithm>
#include <cstddef>

namespace cortex::comms {

bool MirrorSummary::take(const Summary& summary, std::size_t own, Moment when) {
    const auto& marks = summary.marks;
    const bool fits = marks.size() == own && std::ranges::all_of(marks, [](std::uint8_t each) {
                          return markOf(each).has_value();
                      });
    if (!fits) return false;
    // A cycle that is sent again does not become newer.
    if (!any() || summary.cycle != cycle_) when_ = when;
    octets_ = marks;
    cycle_ = summary.cycle;
    return true;
}

std::vector<SimplexMark> MirrorSummary::marks(const Structure& structure, bool lost,
                                              std::int64_t period, Moment now) const {
    std::vector<SimplexMark> marks;
    if (!any()) return marks;
    const std::size_t count = structure.simplexes.size();
    marks.resize(count);
    for (std::uint32_t i = 0; i < std::min(octets_.size(), count); ++i) {
        const auto patience = patienceOf(viewRates.size() - 1, period, structure.writtenEvery(i));
        const bool stale = now - when_ >= patience;
        const Quality least = lost ? Quality::Lost : stale ? Quality::Stale : Quality::Good;
        marks[i] = *markOf(octets_[i]);
        marks[i].quality = std::max(marks[i].quality, least);
        marks[i].outside = marks[i].outside && marks[i].quality == Quality::Good;
    }
    return marks;
}

}  // namespace cortex::comms
