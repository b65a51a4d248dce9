// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/plot_lines.hpp"
#include "plots/plot_range.hpp"
#include "record/recorder.hpp"

#include <cstdint>
#include <vector>

namespace cortex::gui {

// Why a stretch has no values: no cycle came, or the values of all that came were not good; or
// both.
enum class Lack { NoData, NotGood, InPart };

Lack lackOf(const Extent& extent);

// Samples from one index to before another.
struct Samples {
    std::int64_t first = 0, last = 0;
};

// A line with its samples, in one frame. Without samples nothing of it came yet.
struct DrawnLine {
    PlotLine line;
    const Ring* ring = nullptr;
    const AgentTime* time = nullptr;
    double silentUntil = 0;  // s, UTC: it should have come until then, and did not; 0: it comes

    bool any() const { return ring != nullptr && time != nullptr; }
    // Numbers are as they are shown, whatever the unit of the model.
    double value(std::int64_t index) const { return ring->value(index) * line.factor; }
    Extent extent(std::int64_t from, std::int64_t to) const;  // without `to`
    double newest() const;  // NaN: the newest sample is missing, or there is none
    // The indexes of what lies in a stretch of time, with the sample before and the one after.
    std::int64_t first(TimeSpan span) const;
    std::int64_t last(TimeSpan span) const;  // without it
    // Those of which the moments lie in it or at its ends, of what is kept.
    Samples inside(TimeSpan span) const;
    // The value of the sample at this moment or the last before; NaN: missing.
    double valueAt(double seconds) const;
    double samplesOf(double seconds) const;  // how many there are in it
    Extent extent(TimeSpan span) const;

private:
    double slack() const;  // samples that a moment may be off, as it is rounded
};

// A stretch without data, true to the sample. Its end may be beyond what is shown.
struct Gap {
    double from = 0, to = 0;  // s, UTC
    std::vector<int> tags;    // of the lines that have it
    Lack lack = Lack::NoData;
};

// All gaps in a stretch of time that are to be told apart at so many seconds a pixel. Those of
// several lines that are alike are one.
std::vector<Gap> gapsOf(const std::vector<DrawnLine>& lines, TimeSpan span, double pixel);

}  // namespace cortex::gui
