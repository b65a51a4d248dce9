// SPDX-License-Identifier: Apache-2.0
// How a row of an axis is painted.
#include "motion/axis_row.hpp"

#include <QPainter>
#include <QPolygonF>
#include <algorithm>
#include <cmath>

namespace cortex::explorer {

namespace {

QFont sized(const QFont& font, double factor, bool strong = false) {
    QFont result = font;
    result.setPointSizeF(font.pointSizeF() * factor);
    if (strong) result.setWeight(QFont::DemiBold);
    return result;
}

void paintCut(QPainter& painter, const QRect& box, int align, const QString& text) {
    painter.drawText(box, align | Qt::TextSingleLine,
                     painter.fontMetrics().elidedText(text, Qt::ElideRight, box.width()));
}

// A triangle: down to a point on the bar, or up from a limit.
void paintTriangle(QPainter& painter, QPointF tip, double size, double down, const QColor& colour) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    painter.drawPolygon(QPolygonF{{tip,
                                   {tip.x() - size * 0.6, tip.y() - down * size},
                                   {tip.x() + size * 0.6, tip.y() - down * size}}});
}

}  // namespace

void AxisRow::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.setRenderHint(QPainter::Antialiasing);
    if (look_.selected) {
        painter.fillRect(rect(), palette().color(QPalette::AlternateBase));
        painter.fillRect(QRect{0, 0, units(0.75), height()}, palette().color(QPalette::Highlight));
    }
    if (look_.selected && look_.focused) {
        painter.setPen(QPen{palette().color(QPalette::Highlight), 2});
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(rect().adjusted(1, 1, -1, -1));
    }
    const RowColumns columns = columnsOf(width(), mainHeight(), look_.nameWidth);
    painter.setPen(palette().color(QPalette::WindowText));
    painter.setFont(sized(font(), 1.2, true));
    const int up = look_.unitInRow ? units(3.5) : 0;
    paintCut(painter, columns.name.adjusted(0, 0, 0, -up), Qt::AlignLeft | Qt::AlignVCenter,
             axis_.name);
    if (look_.unitInRow) {
        painter.setFont(sized(font(), 0.9));
        painter.setPen(textColour(Tone::Quiet));
        paintCut(painter, columns.name.adjusted(0, units(5), 0, 0),
                 Qt::AlignLeft | Qt::AlignVCenter, look_.position.unit.text);
    }
    paintBar(painter, columns.bar);
    paintCaptions(painter, columns.bar);
    paintNumbers(painter, columns);
    paintDrive(painter, columns.drive);
    if (part_ == RowPart::Demand && look_.edited) {
        painter.setPen(Qt::NoPen);
        painter.setBrush(palette().color(QPalette::Highlight));
        painter.drawEllipse(QPointF{columns.act.left() + units(1) * 1.0, mainHeight() / 2.0},
                            units(0.75), units(0.75));
    }
}

void AxisRow::paintBar(QPainter& painter, const QRect& box) const {
    if (!axis_.min || !axis_.max || !(*axis_.max > *axis_.min)) return;
    const double high = units(2), middle = box.top() + mainHeight() * 0.4;
    const QRectF track{box.left() * 1.0, middle - high / 2, box.width() * 1.0, high};
    painter.setPen(Qt::NoPen);
    painter.setBrush(markColour(Tone::Track));
    painter.drawRoundedRect(track, units(0.5), units(0.5));
    const auto place = [&](double number) {
        const double share = (number - *axis_.min) / (*axis_.max - *axis_.min);
        return track.left() + std::clamp(share, 0.0, 1.0) * track.width();
    };
    if (axis_.position && std::isfinite(*axis_.position)) {
        const double wide = units(0.75), over = units(0.75);
        const double left =
            std::clamp(place(*axis_.position) - wide / 2, track.left(), track.right() - wide);
        const QRectF needle{left, track.top() - over, wide, high + 2 * over};
        if (axis_.live) {
            painter.fillRect(needle, palette().color(QPalette::WindowText));
        } else {
            painter.setBrush(Qt::NoBrush);
            painter.setPen(QPen{markColour(Tone::NotLive), 1});
            painter.drawRect(needle);
        }
    }
    const auto wished = look_.edited && look_.entered ? look_.entered : axis_.wished;
    if (!wished || !std::isfinite(*wished)) return;
    const QPointF tip{place(*wished), track.top() - units(0.25)};
    const bool isAt = axis_.isAtLimit(1) || axis_.isAtLimit(-1);
    paintTriangle(painter, tip, units(1.75), 1, markColour(isAt ? Tone::Limit : Tone::Demand));
}

// The ends of the range below the bar; at a limit the words take the place of its number.
void AxisRow::paintCaptions(QPainter& painter, const QRect& box) const {
    painter.setFont(sized(font(), 0.9));
    const int line = painter.fontMetrics().height();
    const QRect below{box.left(), static_cast<int>(mainHeight() * 0.56), box.width(), line};
    const QString limit = axis_.limitText();
    painter.setPen(textColour(Tone::Quiet));
    if (limit.isEmpty()) {
        if (axis_.min) paintCut(painter, below, Qt::AlignLeft, look_.position.brief(*axis_.min));
        if (axis_.max) paintCut(painter, below, Qt::AlignRight, look_.position.brief(*axis_.max));
        if (!axis_.min && !axis_.max) paintCut(painter, below, Qt::AlignLeft, tr("no range"));
        return;
    }
    const bool upper = axis_.isAtLimit(1);
    const double size = units(2);
    const int wide =
        std::min(painter.fontMetrics().horizontalAdvance(limit), box.width() - units(3));
    const int left = upper ? below.right() - wide : below.left() + units(3);
    painter.setPen(textColour(Tone::Limit));
    paintCut(painter, {left, below.top(), wide + 1, line}, Qt::AlignLeft, limit);
    paintTriangle(painter, {left - units(1.75) * 1.0, below.top() + (line - size) / 2.0}, size, -1,
                  markColour(Tone::Limit));
}

void AxisRow::paintNumbers(QPainter& painter, const RowColumns& columns) const {
    painter.setFont(sized(font(), 1.2));
    const auto number = [&](const QRect& box, std::optional<double> value, bool live,
                            const QColor& colour) {
        QString text = look_.position.text(value);
        if (value && !live) text = '[' + text + ']';
        painter.setPen(live ? colour : textColour(Tone::NotLive));
        paintCut(painter, box, Qt::AlignRight | Qt::AlignVCenter, text);
    };
    number(columns.value, axis_.position, axis_.live, palette().color(QPalette::WindowText));
    number(columns.target, axis_.wished, axis_.demandLive, textColour(Tone::Demand));
}

void AxisRow::paintDrive(QPainter& painter, const QRect& box) const {
    if (!axis_.drive) return;
    const State state = *axis_.drive;
    const bool fault = state == State::Fault;
    const QColor ink = fault ? markColour(Tone::Fault) : palette().color(QPalette::WindowText);
    const double size = units(3);
    const QRectF mark{box.left() * 1.0, (mainHeight() - size) / 2, size, size};
    painter.setPen(QPen{ink, units(0.5) * 1.0});
    painter.setBrush(state == State::Active || fault ? QBrush{ink} : QBrush{Qt::NoBrush});
    painter.drawEllipse(mark.adjusted(1, 1, -1, -1));
    if (fault) {
        painter.setPen(palette().color(QPalette::BrightText));
        painter.setFont(sized(font(), 0.9, true));
        painter.drawText(mark, Qt::AlignCenter, QStringLiteral("!"));
    }
    if (box.width() < units(10)) return;
    painter.setFont(sized(font(), 0.9));
    painter.setPen(fault ? textColour(Tone::Fault) : palette().color(QPalette::WindowText));
    const int left = box.left() + units(4);
    paintCut(painter, {left, 0, box.right() - left + 1, mainHeight()},
             Qt::AlignLeft | Qt::AlignVCenter, QLatin1String{name(state)});
}

}  // namespace cortex::explorer
