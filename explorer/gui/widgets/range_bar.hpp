// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QPainter>
#include <QRect>
#include <optional>

namespace cortex::gui {

// A number within its range: a track with a needle, and an arrow beyond the end when it is outside.
struct RangeShown {
    double min = 0, max = 0;
    std::optional<double> number;
    bool live = true;  // otherwise the needle is hollow
};

void paintRange(QPainter& painter, const QRect& box, const RangeShown& range);
// The same where there is no room: a thin line with its needle along the lower edge.
void paintRangeLine(QPainter& painter, const QRect& box, const RangeShown& range);

}  // namespace cortex::gui
