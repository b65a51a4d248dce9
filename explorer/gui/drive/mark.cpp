// SPDX-License-Identifier: Apache-2.0
#include "drive/mark.hpp"

#include "cortex/explorer/theme.hpp"

#include <QPainter>
#include <QPalette>
#include <QPolygonF>

namespace cortex::explorer {

namespace {

QPolygonF octagonIn(const QRectF& box) {
    const double cut = box.width() * 0.29;
    return {{{box.left() + cut, box.top()},
             {box.right() - cut, box.top()},
             {box.right(), box.top() + cut},
             {box.right(), box.bottom() - cut},
             {box.right() - cut, box.bottom()},
             {box.left() + cut, box.bottom()},
             {box.left(), box.bottom() - cut},
             {box.left(), box.top() + cut}}};
}

}  // namespace

void paintMark(QPainter& painter, const QRectF& box, MarkShape shape, const QPalette& palette) {
    const QColor& ink = palette.color(QPalette::WindowText);
    const QRectF inner = box.adjusted(1, 1, -1, -1);
    painter.setPen(Qt::NoPen);
    painter.setBrush(Qt::NoBrush);
    switch (shape) {
        case MarkShape::Disc:
            painter.setBrush(ink);
            painter.drawEllipse(inner);
            return;
        case MarkShape::Ring:
        case MarkShape::DashedRing:
            painter.setPen(QPen{textColour(Tone::Quiet), 1.5,
                                shape == MarkShape::Ring ? Qt::SolidLine : Qt::DotLine});
            painter.drawEllipse(inner);
            return;
        case MarkShape::Triangle:
            painter.setBrush(markColour(Tone::Limit));
            painter.drawPolygon(QPolygonF{{{box.center().x(), box.top()},
                                           {box.right(), box.bottom()},
                                           {box.left(), box.bottom()}}});
            return;
        case MarkShape::Octagon:
            painter.setBrush(markColour(Tone::Fault));
            painter.drawPolygon(octagonIn(box));
            return;
    }
}

}  // namespace cortex::explorer
