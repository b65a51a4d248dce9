// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_summary.hpp"

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

std::vector<SimplexMark> MirrorSummary::marks(std::size_t simplexes, bool lost,
                                              Moment limit) const {
    std::vector<SimplexMark> marks;
    if (!any()) return marks;
    const Quality least = lost ? Quality::Lost : when_ <= limit ? Quality::Stale : Quality::Good;
    marks.resize(simplexes);
    for (std::size_t i = 0; i < std::min(octets_.size(), simplexes); ++i) {
        marks[i] = *markOf(octets_[i]);
        marks[i].quality = std::max(marks[i].quality, least);
        marks[i].outside = marks[i].outside && marks[i].quality == Quality::Good;
    }
    return marks;
}

}  // namespace cortex::comms
