// SPDX-License-Identifier: Apache-2.0
#include "plots/drawn_line.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::gui {

namespace {

constexpr std::size_t mostGaps = 2'000;  // in one picture
constexpr double rounding = 3e-7;        // s, of a moment in UTC

void addGap(std::vector<Gap>& gaps, const Gap& gap, int tag, double pixel) {
    for (Gap& each : gaps) {
        if (each.lack != gap.lack) continue;
        if (std::abs(each.from - gap.from) > pixel || std::abs(each.to - gap.to) > pixel) continue;
        if (std::ranges::find(each.tags, tag) == each.tags.end()) each.tags.push_back(tag);
        return;
    }
    gaps.push_back({gap.from, gap.to, {tag}, gap.lack});
}

// A gap reaches from the last sample before it to the first one behind it.
void addGaps(std::vector<Gap>& gaps, const DrawnLine& of, TimeSpan span, double pixel) {
    const Ring& ring = *of.ring;
    const std::int64_t last = std::min(of.last(span), ring.end());
    std::int64_t at = std::max(of.first(span), ring.begin());
    std::vector<Gap> own;
    while (own.size() < mostGaps && (at = ring.nextMissing(at, last)) < last) {
        const std::int64_t begin = ring.behindPresent(at);
        const std::int64_t end = ring.nextPresent(at, ring.end());
        const double from = of.time->secondsAt(begin - 1);
        double to = of.time->secondsAt(end);
        Extent between = ring.extent(begin, end);
        if (end == ring.end() && of.silentUntil > to) {
            to = of.silentUntil;
            between.absent = true;
        }
        own.push_back({from, to, {}, lackOf(between)});
        at = std::max(end, static_cast<std::int64_t>(of.time->indexAt(to + pixel)));
    }
    const double newest = of.time->secondsAt(ring.end() - 1);
    const bool told = !own.empty() && own.back().to >= newest;
    if (of.silentUntil > newest && !told && newest < span.to) {
        own.push_back({newest, of.silentUntil, {}, Lack::NoData});
    }
    for (const Gap& each : own) addGap(gaps, each, of.line.tag, pixel);
}

}  // namespace

Lack lackOf(const Extent& extent) {
    if (!extent.unfit) return Lack::NoData;
    return extent.absent ? Lack::InPart : Lack::NotGood;
}

double DrawnLine::newest() const { return any() ? value(ring->end() - 1) : missingValue; }

std::int64_t DrawnLine::first(TimeSpan span) const {
    return static_cast<std::int64_t>(std::floor(time->indexAt(span.from)));
}

std::int64_t DrawnLine::last(TimeSpan span) const {
    return static_cast<std::int64_t>(std::ceil(time->indexAt(span.to))) + 1;
}

double DrawnLine::slack() const { return 1e-3 + samplesOf(rounding); }

Samples DrawnLine::inside(TimeSpan span) const {
    if (!any()) return {};
    const auto first = static_cast<std::int64_t>(std::ceil(time->indexAt(span.from) - slack()));
    const auto last = static_cast<std::int64_t>(std::floor(time->indexAt(span.to) + slack()));
    return {std::max(first, ring->begin()), std::min(last + 1, ring->end())};
}

double DrawnLine::valueAt(double seconds) const {
    if (!any()) return missingValue;
    return value(static_cast<std::int64_t>(std::floor(time->indexAt(seconds) + slack())));
}

double DrawnLine::samplesOf(double seconds) const {
    return time->table.period() > 0 ? seconds * 1e9 / static_cast<double>(time->table.period()) : 0;
}

Extent DrawnLine::extent(std::int64_t from, std::int64_t to) const {
    Extent extent = ring->extent(from, to);
    extent.min *= line.factor;
    extent.max *= line.factor;
    return extent;
}

Extent DrawnLine::extent(TimeSpan span) const {
    return any() ? extent(first(span), last(span)) : Extent{};
}

std::vector<Gap> gapsOf(const std::vector<DrawnLine>& lines, TimeSpan span, double pixel) {
    std::vector<Gap> gaps;
    for (const DrawnLine& each : lines) {
        if (each.any() && each.ring->end() > each.ring->begin()) {
            addGaps(gaps, each, span, pixel);
        }
    }
    std::ranges::sort(gaps, {}, &Gap::from);
    return gaps;
}

}  // namespace cortex::gui
