// SPDX-License-Identifier: Apache-2.0
#include "plots/overview_strip.hpp"

#include "plots/time_ticks.hpp"
#include "style/look.hpp"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace cortex::gui {

OverviewStrip::OverviewStrip(QWidget* parent) : QWidget{parent} {
    setFixedHeight(Look::units(11));
    setAccessibleName(tr("Everything that is kept"));
    setToolTip(tr("Drag to another time"));
}

void OverviewStrip::show(const DrawnLine& line, TimeSpan kept, TimeSpan shown) {
    line_ = line;
    kept_ = kept;
    shown_ = shown;
    setFixedHeight(Look::units(11));
    update();
}

void OverviewStrip::setEdges(int left, int right) {
    left_ = left;
    right_ = right;
}

double OverviewStrip::secondsAt(int x) const {
    return kept_.from + (x - left_) * kept_.length() / std::max(right_ - left_, 1);
}

void OverviewStrip::paintLine(QPainter& painter, const QRect& box) const {
    if (!line_.any()) return;
    const Extent all = line_.extent(kept_);
    if (!all.any()) return;
    const double height = box.height() - 4.0, scale = height / std::max(all.max - all.min, 1e-300);
    const QColor colour = line_.line.pen(1).color();
    for (int x = box.left(); x < box.right(); ++x) {
        const auto from = static_cast<std::int64_t>(line_.time->indexAt(secondsAt(x)));
        const auto to = static_cast<std::int64_t>(line_.time->indexAt(secondsAt(x + 1)));
        if (from >= line_.ring->end() || to < line_.ring->begin()) continue;
        const Extent extent = line_.extent(from, std::max(to, from + 1));
        if (!extent.any()) {
            painter.fillRect(x, box.top(), 1, box.height(), Look::colours().data);
            continue;
        }
        const double top = box.bottom() - 2 - (extent.max - all.min) * scale;
        painter.fillRect(QRectF{x + 0.0, top, 1, std::max((extent.max - extent.min) * scale, 1.0)},
                         colour);
    }
}

// "34.20 s"; "10 min 34 s" in two rows where it has no room in one.
QString OverviewStrip::lengthText(int room) const {
    QString text = durationText(kept_.length());
    const QFontMetrics metrics{Look::font(TextSize::Note)};
    const int second = static_cast<int>(text.indexOf(' ', text.indexOf(' ') + 1));
    if (second > 0 && metrics.horizontalAdvance(text) > room) text[second] = '\n';
    return text;
}

void OverviewStrip::paintEvent(QPaintEvent* /*event*/) {
    if (!(kept_.length() > 0) || right_ <= left_) return;
    QPainter painter{this};
    const Tokens& c = Look::colours();
    const QRect box{left_, 0, right_ - left_, height()};
    painter.fillRect(box, c.canvas);
    paintLine(painter, box);
    painter.setPen(QPen{c.line, 1});
    painter.drawRect(box.adjusted(0, 0, -1, -1));
    const auto place = [&](double at) {
        return left_ + (at - kept_.from) / kept_.length() * (right_ - left_);
    };
    const double from = std::clamp(place(shown_.from), left_ + 1.0, right_ - 4.0);
    const double to = std::clamp(place(shown_.to), from + 3, right_ - 1.0);
    painter.setPen(QPen{c.accent, 2});
    painter.drawRect(QRectF{from, 1, to - from, height() - 2.0});
    painter.setFont(Look::font(TextSize::Note));
    painter.setPen(c.ink2);
    const QRect beside{0, 0, left_ - Look::units(2), height()};
    painter.drawText(beside, Qt::AlignRight | Qt::AlignVCenter, lengthText(beside.width()));
}

void OverviewStrip::mousePressEvent(QMouseEvent* event) {
    const double at = secondsAt(event->pos().x());
    const bool inside = at >= shown_.from && at <= shown_.to;
    grip_ = inside ? shown_.to - at : shown_.length() / 2;
    if (!inside) Q_EMIT moved(at + grip_);
}

void OverviewStrip::mouseMoveEvent(QMouseEvent* event) {
    Q_EMIT moved(secondsAt(event->pos().x()) + grip_);
}

}  // namespace cortex::gui
