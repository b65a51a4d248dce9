// SPDX-License-Identifier: Apache-2.0
#include "plots/line_item.hpp"

#include "style/look.hpp"

#include <QLineF>
#include <QPainter>
#include <QPolygonF>
#include <algorithm>
#include <cmath>
#include <optional>

#include <qwt_scale_map.h>

namespace cortex::gui {

namespace {

constexpr double fewSamples = 4;    // a column, below which they are joined by strokes
constexpr double widestColumn = 2;  // pixels
constexpr double hidden = 1;        // pixels up or down that a blank of a dash may hide

double width() { return Look::length(0.45); }

struct Maps {
    const QwtScaleMap& x;
    const QwtScaleMap& y;
    TimeSpan shown;

    // Far outside of the canvas all are alike, and beyond all numbers there is none.
    double yOf(double value) const { return std::clamp(y.transform(value), -1e6, 1e6); }
};

// Columns from one to before another.
struct Blank {
    double first = 0, last = 0;
};

// The columns of a dashed line between two dashes, if this one is between them.
std::optional<Blank> blankAt(const QVector<double>& dashes, double column, double unit) {
    if (dashes.isEmpty()) return std::nullopt;
    double whole = 0;
    for (const double each : dashes) whole += each * unit;
    double begin = std::floor(column / whole) * whole;
    for (int i = 0; i < dashes.size(); ++i) {
        const double end = begin + dashes[i] * unit;
        if (column < end && i % 2 == 1) return Blank{std::ceil(begin), std::ceil(end)};
        if (column < end) break;
        begin = end;
    }
    return std::nullopt;
}

// Whether a part of a line goes on as the whole does, so that a blank in its place hides nothing:
// neither there and back, nor most of the way at once. Pixels.
bool isEven(double part, double extent, double whole) {
    if (extent > std::abs(part) + hidden) return false;
    return std::abs(part) <= hidden || (part * whole > 0 && std::abs(part) <= std::abs(whole) / 2);
}

// Of the points of a stroke: to this one from the one before, beside its neighbours.
bool isEvenAt(const QPolygonF& points, int i) {
    const auto rise = [&](int k) {
        const bool there = k > 0 && k < points.size();
        return there ? points[k].y() - points[k - 1].y() : 0.0;
    };
    const double part = rise(i), before = rise(i - 1), after = rise(i + 1);
    const bool alone = std::abs(part) > 2 * std::max(std::abs(before), std::abs(after));
    const bool turns = part * before < 0 || part * after < 0;
    return std::abs(part) <= hidden || (!alone && !turns);
}

// What a dashed line has in its blanks is only what is even.
void drawStroke(QPainter& painter, const QPolygonF& points, const QPen& pen) {
    if (pen.style() != Qt::CustomDashLine) {
        painter.setPen(pen);
        painter.drawPolyline(points);
        return;
    }
    QPen dashed = pen, whole = pen;
    whole.setStyle(Qt::SolidLine);
    double length = 0;
    for (int first = 0, last = 1; last < points.size(); first = last++) {
        const bool even = isEvenAt(points, last);
        while (last + 1 < points.size() && isEvenAt(points, last + 1) == even) ++last;
        dashed.setDashOffset(length / pen.widthF());
        painter.setPen(even ? dashed : whole);
        painter.drawPolyline(points.constData() + first, last - first + 1);
        for (int i = first; i < last; ++i) length += QLineF{points[i], points[i + 1]}.length();
    }
}

// Samples from one index to before another.
void drawStrokes(QPainter& painter, const DrawnLine& line, const Maps& maps, std::int64_t from,
                 std::int64_t to) {
    const Ring& ring = *line.ring;
    const QPen pen = line.line.pen(width());
    QPolygonF points;
    painter.setRenderHint(QPainter::Antialiasing);
    const auto flush = [&] {
        if (points.size() == 1) {
            const double size = 2 * width();
            painter.fillRect(QRectF{points[0].x() - size / 2, points[0].y() - size / 2, size, size},
                             pen.color());
        }
        if (points.size() > 1) drawStroke(painter, points, pen);
        points.clear();
    };
    for (std::int64_t i = std::max(from, ring.begin()); i < std::min(to, ring.end()); ++i) {
        const double value = line.value(i);
        if (std::isnan(value)) {
            flush();
        } else {
            points.append({maps.x.transform(line.time->secondsAt(i)), maps.yOf(value)});
        }
    }
    flush();
    painter.setRenderHint(QPainter::Antialiasing, false);
}

std::int64_t firstOf(double column, double perColumn) {
    return static_cast<std::int64_t>(std::floor(column * perColumn));
}

// Whether a column is left out of a dashed line.
bool isBlank(const DrawnLine& line, const Maps& maps, const std::optional<Blank>& blank,
             double column, double perColumn, const Extent& extent) {
    if (!blank || extent.missing) return false;
    const auto before = [&](double k) {
        const std::int64_t at = firstOf(k, perColumn) - 1;
        return maps.yOf(line.value(std::clamp(at, line.ring->begin(), line.ring->end() - 1)));
    };
    const double part = before(column + 1) - before(column);
    const double whole = before(blank->last) - before(blank->first);
    if (std::isnan(part) || std::isnan(whole)) return false;
    return isEven(part, maps.yOf(extent.min) - maps.yOf(extent.max), whole);
}

void drawColumns(QPainter& painter, const DrawnLine& line, const Maps& maps, double perColumn) {
    const Ring& ring = *line.ring;
    const QPen pen = line.line.pen(width());
    const auto dashes = pen.style() == Qt::CustomDashLine ? pen.dashPattern() : QVector<double>{};
    const auto first = static_cast<double>(std::max(line.first(maps.shown), ring.begin()));
    const auto last = static_cast<double>(std::min(line.last(maps.shown), ring.end()));
    const double least = std::max(width(), 1.0);
    for (double k = std::floor(first / perColumn); k * perColumn < last; ++k) {
        const std::int64_t from = firstOf(k, perColumn), to = firstOf(k + 1, perColumn);
        Extent extent = line.extent(from, to);
        if (!extent.any()) continue;
        const double before = line.value(from - 1);
        if (!std::isnan(before) && !std::isnan(ring.value(from))) extent.add(before);
        if (isBlank(line, maps, blankAt(dashes, k, width()), k, perColumn, extent)) continue;
        const double left = std::round(maps.x.transform(line.time->secondsAt(from)));
        const double right = std::round(maps.x.transform(line.time->secondsAt(to)));
        if (right - left > widestColumn) {  // of an agent that is late
            drawStrokes(painter, line, maps, from - 1, to + 1);
            continue;
        }
        const double top = maps.yOf(extent.max), bottom = maps.yOf(extent.min);
        const double height = std::max(bottom - top, least);
        painter.fillRect(
            QRectF{left, (top + bottom - height) / 2, std::max(right - left, 1.0), height},
            pen.color());
    }
}

}  // namespace

LineItem::LineItem(const DrawnLine& line) : line_{line} {
    setZ(20);
    setYAxis(line.line.right ? 1 : 0);
}

void LineItem::draw(QPainter* painter, const QwtScaleMap& xMap, const QwtScaleMap& yMap,
                    const QRectF& canvas) const {
    if (!line_.any() || canvas.width() < 1) return;
    const Maps maps{xMap, yMap, {xMap.s1(), xMap.s2()}};
    const double perColumn = line_.samplesOf(maps.shown.length()) / canvas.width();
    painter->save();
    painter->setClipRect(canvas);
    if (perColumn >= fewSamples) {
        drawColumns(*painter, line_, maps, perColumn);
    } else {
        drawStrokes(*painter, line_, maps, line_.first(maps.shown), line_.last(maps.shown));
    }
    painter->restore();
}

}  // namespace cortex::gui
