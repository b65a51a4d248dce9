// SPDX-License-Identifier: Apache-2.0
#include "plots/time_axis.hpp"

#include "plots/time_ticks.hpp"
#include "style/look.hpp"

#include <QFontMetricsF>
#include <QPainter>
#include <algorithm>
#include <utility>

namespace cortex::gui {

TimeAxis::TimeAxis(QWidget* parent) : QWidget{parent} { setFixedHeight(Look::units(6)); }

void TimeAxis::show(TimeSpan span, int left, int right) {
    span_ = span;
    left_ = left;
    right_ = right;
    setFixedHeight(Look::units(6));
    const QString name = tr("Time in %1").arg(zoneText(span.to));
    if (name != accessibleName()) setAccessibleName(name);
    update();
}

void TimeAxis::paintEvent(QPaintEvent* /*event*/) {
    if (!(span_.length() > 0) || span_.to <= 0 || right_ <= left_) return;
    QPainter painter{this};
    painter.setFont(Look::font(TextSize::Note));
    painter.setPen(Look::colours().ink2);
    const QFontMetricsF metrics{painter.font()};
    const double gap = Look::length(2);
    painter.drawText(QRectF{0, 0, left_ - gap, static_cast<double>(height())},
                     Qt::AlignRight | Qt::AlignVCenter, zoneText(span_.to));
    const double width = right_ - left_;
    const double step = tickStep(span_.length(), width / Look::length(30));
    QString date = dateText(span_);
    for (const double tick : timeTicks(span_, step)) {
        const double x = left_ + (tick - span_.from) / span_.length() * width;
        QString text = timeText(tick, step);
        if (!date.isEmpty()) text.prepend(std::exchange(date, QString{}) + ' ');
        const double wide = metrics.horizontalAdvance(text) + 2;
        const double from = std::clamp(x - wide / 2, left_ - gap / 2, right_ - wide + gap);
        painter.drawText(QRectF{from, 0, wide, static_cast<double>(height())}, Qt::AlignCenter,
                         text);
    }
}

}  // namespace cortex::gui
