// SPDX-License-Identifier: Apache-2.0
#include "widgets/range_bar.hpp"

#include "style/look.hpp"

#include <QPolygonF>
#include <algorithm>
#include <cmath>

namespace cortex::gui {

namespace {

void paintArrow(QPainter& painter, QPointF tip, double direction) {
    const double size = Look::units(2);
    painter.setBrush(Look::colours().warnEdge);
    painter.setPen(Qt::NoPen);
    painter.drawPolygon(QPolygonF{{tip,
                                   {tip.x() - direction * size, tip.y() - size * 0.8},
                                   {tip.x() - direction * size, tip.y() + size * 0.8}}});
}

}  // namespace

void paintRangeLine(QPainter& painter, const QRect& box, const RangeShown& range) {
    const Tokens& c = Look::colours();
    const int thick = Look::units(0.5), needle = Look::units(0.75);
    const QRect track{box.left(), box.bottom() - thick, box.width(), thick};
    painter.fillRect(track, c.band);
    const double width = range.max - range.min;
    if (!range.number || !std::isfinite(*range.number) || !(width > 0) || !std::isfinite(width)) {
        return;
    }
    const double share = std::clamp((*range.number - range.min) / width, 0.0, 1.0);
    const bool within = *range.number >= range.min && *range.number <= range.max;
    const int at = track.left() + static_cast<int>(share * (track.width() - needle));
    const QRect mark{at, track.top() - thick, needle, 2 * thick};
    if (range.live) {
        painter.fillRect(mark, within ? c.ink : c.warnEdge);
    } else {
        painter.setPen(QPen{c.ink2, 1});
        painter.drawRect(mark.adjusted(0, 0, -1, -1));
    }
}

void paintRange(QPainter& painter, const QRect& box, const RangeShown& range) {
    const Tokens& c = Look::colours();
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    const int height = Look::units(2), arrow = Look::units(2.5);
    const QRectF track{static_cast<double>(box.left() + arrow), box.center().y() + 1 - height / 2.0,
                       static_cast<double>(std::max(box.width() - 2 * arrow, 1)),
                       static_cast<double>(height)};
    painter.setPen(Qt::NoPen);
    painter.setBrush(c.band);
    painter.drawRoundedRect(track, Look::units(0.5), Look::units(0.5));
    const double width = range.max - range.min;
    if (range.number && std::isfinite(*range.number) && width > 0 && std::isfinite(width)) {
        const double share = (*range.number - range.min) / width;
        if (share < 0)
            paintArrow(painter, {track.left() - arrow, track.center().y()}, -1);
        else if (share > 1)
            paintArrow(painter, {track.right() + arrow, track.center().y()}, 1);
        else {
            const double needle = Look::units(0.75);
            const QRectF at{track.left() + share * (track.width() - needle),
                            track.top() - Look::units(0.75), needle,
                            track.height() + 2 * Look::units(0.75)};
            if (range.live)
                painter.fillRect(at, c.ink);
            else {
                painter.setBrush(Qt::NoBrush);
                painter.setPen(QPen{c.ink2, 1});
                painter.drawRect(at);
            }
        }
    }
    painter.restore();
}

}  // namespace cortex::gui
