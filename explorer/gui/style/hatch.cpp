// SPDX-License-Identifier: Apache-2.0
#include "style/hatch.hpp"

#include "style/look.hpp"

#include <QPainter>
#include <cmath>

namespace cortex::gui {

void paintHatch(QPainter& painter, const QRectF& box) {
    painter.save();
    painter.setClipRect(box, Qt::IntersectClip);
    painter.fillRect(box, Look::colours().dataBg);
    painter.setPen(QPen{Look::colours().data, 1});
    painter.setRenderHint(QPainter::Antialiasing);
    const double step = Look::length(2);
    const double left = std::floor((box.left() - box.height()) / step) * step;
    for (double x = left; x < box.right(); x += step) {
        painter.drawLine(QPointF{x, box.bottom()}, QPointF{x + box.height(), box.top()});
    }
    painter.restore();
}

}  // namespace cortex::gui
