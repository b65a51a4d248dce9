// SPDX-License-Identifier: Apache-2.0
#include "plots/line_item.hpp"

#include "style/look.hpp"

#include <QPainter>
#include <QPolygonF>
#include <algorithm>
#include <cmath>

#include <qwt_scale_map.h>

namespace cortex::gui {

namespace {

constexpr double fewSamples = 4;    // a column, below which they are joined by strokes
constexpr double widestColumn = 2;  // pixels

double width() { return Look::length(0.45); }

struct Maps {
    const QwtScaleMap& x;
    const QwtScaleMap& y;
    TimeSpan shown;
};

// Which columns of a dashed line are drawn.
bool isDrawn(const QVector<double>& dashes, std::int64_t column, double unit) {
    if (dashes.isEmpty()) return true;
    double whole = 0;
    for (const double each : dashes) whole += each * unit;
    double at = std::fmod(static_cast<double>(column), whole);
    if (at < 0) at += whole;
    for (int i = 0; i < dashes.size(); ++i) {
        at -= dashes[i] * unit;
        if (at < 0) return i % 2 == 0;
    }
    return true;
}

// Samples from one index to before another.
void drawStrokes(QPainter& painter, const DrawnLine& line, const Maps& maps, std::int64_t from,
                 std::int64_t to) {
    const Ring& ring = *line.ring;
    QPolygonF points;
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(line.line.pen(width()));
    const auto flush = [&] {
        if (points.size() == 1) {
            const double size = 2 * width();
            painter.fillRect(QRectF{points[0].x() - size / 2, points[0].y() - size / 2, size, size},
                             painter.pen().color());
        }
        if (points.size() > 1) painter.drawPolyline(points);
        points.clear();
    };
    for (std::int64_t i = std::max(from, ring.begin()); i < std::min(to, ring.end()); ++i) {
        const double value = line.value(i);
        if (std::isnan(value)) {
            flush();
        } else {
            points.append({maps.x.transform(line.time->secondsAt(i)), maps.y.transform(value)});
        }
    }
    flush();
    painter.setRenderHint(QPainter::Antialiasing, false);
}

void drawColumns(QPainter& painter, const DrawnLine& line, const Maps& maps, double perColumn) {
    const Ring& ring = *line.ring;
    const QPen pen = line.line.pen(width());
    const auto dashes = pen.style() == Qt::CustomDashLine ? pen.dashPattern() : QVector<double>{};
    const auto first = static_cast<double>(std::max(line.first(maps.shown), ring.begin()));
    const auto last = static_cast<double>(std::min(line.last(maps.shown), ring.end()));
    const double least = std::max(width(), 1.0);
    const auto column = [&](double k) {
        return static_cast<std::int64_t>(std::floor(k * perColumn));
    };
    for (double k = std::floor(first / perColumn); k * perColumn < last; ++k) {
        const std::int64_t from = column(k), to = column(k + 1);
        Extent extent = line.extent(from, to);
        if (!extent.any() || !isDrawn(dashes, static_cast<std::int64_t>(k), width())) continue;
        const double before = line.value(from - 1);
        if (!std::isnan(before) && !std::isnan(ring.value(from))) extent.add(before);
        const double left = std::round(maps.x.transform(line.time->secondsAt(from)));
        const double right = std::round(maps.x.transform(line.time->secondsAt(to)));
        if (right - left > widestColumn) {  // of an agent that is late
            drawStrokes(painter, line, maps, from - 1, to + 1);
            continue;
        }
        const double top = maps.y.transform(extent.max), bottom = maps.y.transform(extent.min);
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
