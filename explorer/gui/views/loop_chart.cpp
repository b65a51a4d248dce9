// SPDX-License-Identifier: Apache-2.0
#include "views/loop_chart.hpp"

#include "style/look.hpp"

#include <QFontMetricsF>
#include <QPolygonF>
#include <algorithm>
#include <array>

namespace cortex::gui {

namespace {

constexpr std::array percentiles{LoopFigure::P50, LoopFigure::P99, LoopFigure::P999,
                                 LoopFigure::Max};
constexpr std::array dutyTicks{0.0, 50.0, 100.0, 150.0};  // %

double across(const QRectF& box, double share) { return box.left() + share * box.width(); }

double dutyShare(double duty) { return duty > 0 ? std::min(duty / wholeDuty, 1.0) : 0; }

void paintLine(QPainter& painter, double x, const QRectF& box, const QColor& colour, double width) {
    painter.setPen(QPen{colour, width, Qt::SolidLine, Qt::FlatCap});
    painter.drawLine(QPointF{x, box.top()}, QPointF{x, box.bottom()});
}

// A number below its tick, kept within the box; nothing where it would touch the one before.
void paintTick(QPainter& painter, const QRectF& box, double share, const QString& text,
               const QColor& ink, double& taken) {
    const QFontMetricsF metrics{painter.font()};
    const double width = metrics.horizontalAdvance(text) + 1;
    const double left = std::clamp(across(box, share) - width / 2, box.left(),
                                   std::max(box.left(), box.right() - width));
    if (left < taken) return;
    painter.setPen(ink);
    painter.drawText(QRectF{left, box.top(), width, box.height()},
                     static_cast<int>(Qt::AlignLeft | Qt::AlignVCenter) | Qt::TextDontClip, text);
    taken = left + width + Look::length(2);
}

void paintArrow(QPainter& painter, QPointF tip) {
    const double size = Look::length(2);
    painter.setPen(Qt::NoPen);
    painter.setBrush(Look::colours().warnEdge);
    painter.drawPolygon(QPolygonF{
        {tip, {tip.x() - size, tip.y() - size * 0.8}, {tip.x() - size, tip.y() + size * 0.8}}});
}

}  // namespace

void paintLoopMark(QPainter& painter, LoopFigure::Which which, QPointF at, const QColor& ink) {
    const double size = Look::length(1), thick = Look::length(0.5);
    painter.setPen(QPen{ink, thick, Qt::SolidLine, Qt::FlatCap, Qt::MiterJoin});
    painter.setBrush(ink);
    const double x = at.x(), y = at.y();
    switch (which) {
        case LoopFigure::P50:
            painter.drawEllipse(at, size, size);
            break;
        case LoopFigure::P99:
            painter.drawLine(QPointF{x, y - 2 * size}, QPointF{x, y + 2 * size});
            break;
        case LoopFigure::P999:
            painter.setBrush(Qt::NoBrush);
            painter.drawRect(QRectF{x - size, y - 1.5 * size, 2 * size, 3 * size});
            break;
        case LoopFigure::Max:
            painter.setPen(Qt::NoPen);
            painter.drawPolygon(QPolygonF{{{x, y - 1.8 * size},
                                           {x + 1.4 * size, y},
                                           {x, y + 1.8 * size},
                                           {x - 1.4 * size, y}}});
            break;
        case LoopFigure::Last:
        case LoopFigure::Count:
            break;
    }
}

void paintDuty(QPainter& painter, const QRectF& box, const LoopFigure& duty, bool live,
               const QColor& ink) {
    const Tokens& c = Look::colours();
    const double height = Look::length(3);
    const QRectF track{box.left(), box.center().y() - height / 2, box.width(), height};
    painter.fillRect(track, c.band);
    if (const auto last = duty.numbers[LoopFigure::Last]) {
        QRectF bar = track;
        bar.setWidth(dutyShare(*last) * track.width());
        painter.fillRect(bar, *last > 100 ? c.warnEdge : live ? c.armEdge : c.border);
    }
    paintLine(painter, across(box, dutyShare(100)), box, ink, Look::length(0.5));
    for (const LoopFigure::Which each : percentiles) {
        const auto& number = duty.numbers[each];
        if (!number) continue;
        if (*number > wholeDuty)
            paintArrow(painter, {box.right(), box.center().y()});
        else
            paintLoopMark(painter, each, {across(box, dutyShare(*number)), box.center().y()}, ink);
    }
}

void paintDutyScale(QPainter& painter, const QRectF& box, const QColor& ink) {
    double taken = box.left();
    for (const double each : dutyTicks) {
        paintTick(painter, box, dutyShare(each), QStringLiteral("%1 %").arg(each), ink, taken);
    }
}

void paintTimes(QPainter& painter, const QRectF& box, const LoopFigure& figure, const LogAxis& axis,
                const QColor& ink) {
    const Tokens& c = Look::colours();
    for (int power = axis.from; power <= axis.to; ++power) {
        paintLine(painter, across(box, axis.share(power)), box, c.grid, 1);
    }
    const auto& from = figure.numbers[LoopFigure::P50];
    const auto& to = figure.numbers[LoopFigure::Max];
    if (from && to) {
        painter.setPen(QPen{c.border, Look::length(0.25)});
        painter.drawLine(QPointF{across(box, axis.shareOf(*from)), box.center().y()},
                         QPointF{across(box, axis.shareOf(*to)), box.center().y()});
    }
    for (const LoopFigure::Which each : percentiles) {
        const auto& number = figure.numbers[each];
        if (!number) continue;
        paintLoopMark(painter, each, {across(box, axis.shareOf(*number)), box.center().y()}, ink);
    }
}

void paintTimeScale(QPainter& painter, const QRectF& box, const LogAxis& axis, const QColor& ink) {
    double taken = box.left();
    for (int power = axis.from; power <= axis.to; ++power) {
        paintTick(painter, box, axis.share(power), axis.label(power), ink, taken);
    }
}

}  // namespace cortex::gui
