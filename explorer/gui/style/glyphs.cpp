// SPDX-License-Identifier: Apache-2.0
#include "style/glyphs.hpp"

#include <QPainterPath>
#include <QPixmap>
#include <initializer_list>
#include <vector>

namespace cortex::gui {

namespace {

using Points = std::initializer_list<QPointF>;

void add(QPainterPath& path, Points points) {
    bool first = true;
    for (const QPointF& point : points) {
        first ? path.moveTo(point) : path.lineTo(point);
        first = false;
    }
}

QPainterPath lines(std::initializer_list<Points> all) {
    QPainterPath path;
    for (const Points& points : all) add(path, points);
    return path;
}

QPainterPath with(QPainterPath path, const QRectF& ellipse) {
    path.addEllipse(ellipse);
    return path;
}

QPainterPath boxed(QPainterPath path, const QRectF& rectangle) {
    path.addRect(rectangle);
    return path;
}

// In a square of 16 by 16, to be drawn with a pen of 1.6; in the order of Glyph.
const std::vector<QPainterPath>& paths() {
    static const std::vector<QPainterPath> all{
        lines({{{2, 4}, {14, 4}}, {{2, 8}, {14, 8}}, {{2, 12}, {14, 12}}}),  // Menu
        with(lines({{{10, 10}, {14, 14}}}), {2, 2, 9, 9}),                   // Find
        lines(
            {{{2, 3}, {14, 3}, {9.5, 8.5}, {9.5, 13.5}, {6.5, 12}, {6.5, 8.5}, {2, 3}}}),  // Filter
        lines({{{4, 4}, {12, 12}}, {{12, 4}, {4, 12}}}),                                   // Close
        lines({{{8, 3}, {8, 13}}, {{3, 8}, {13, 8}}}),                                     // Plus
        lines({{{3, 8}, {13, 8}}}),                                                        // Minus
        lines({{{10, 3}, {5, 8}, {10, 13}}}),                                              // Left
        lines({{{6, 3}, {11, 8}, {6, 13}}}),                                               // Right
        lines({{{3, 10}, {8, 5}, {13, 10}}}),                                              // Up
        lines({{{3, 6}, {8, 11}, {13, 6}}}),                                               // Down
        lines({{{5.5, 3}, {5.5, 13}}, {{10.5, 3}, {10.5, 13}}}),                           // Hold
        lines({{{3, 3}, {9, 8}, {3, 13}}, {{12.5, 3}, {12.5, 13}}}),                       // Follow
        lines({{{8, 1.5}, {8, 14.5}}, {{5, 5}, {11, 5}}, {{5, 11}, {11, 11}}}),            // Cursor
        boxed(lines({{{5, 5}, {5, 8}}, {{8, 5}, {8, 9}}, {{11, 5}, {11, 8}}}),
              {1.5, 5, 13, 6}),  // Ruler
        lines({{{8, 10}, {8, 2}},
               {{5, 5}, {8, 2}, {11, 5}},
               {{2.5, 9}, {2.5, 13.5}, {13.5, 13.5}, {13.5, 9}}}),                        // Export
        boxed(lines({{{5, 3}, {5, 2}, {14, 2}, {14, 11}, {12, 11}}}), {2, 5, 9, 9}),      // Copy
        lines({{{1.5, 8}, {9, 8}}, {{6, 5}, {9, 8}, {6, 11}}, {{12.5, 3}, {12.5, 13}}}),  // LinkIn
        lines(
            {{{3.5, 3}, {3.5, 13}}, {{6.5, 8}, {14, 8}}, {{11, 5}, {14, 8}, {11, 11}}}),  // LinkOut
        boxed(lines({{{8, 3}, {8, 13}}}), {2, 3, 12, 10}),                                // Split
        boxed(lines({{{2, 6}, {14, 6}}}), {2, 3, 12, 10}),                                // Window
        lines({{{5, 2.5}, {11, 2.5}},
               {{6, 2.5}, {6, 7}, {4, 9.5}, {12, 9.5}, {10, 7}, {10, 2.5}},
               {{8, 9.5}, {8, 14}}}),  // Pin
        boxed(lines({{{5, 7}, {5, 4.5}, {6.5, 2.5}, {9.5, 2.5}, {11, 4.5}, {11, 7}}}),
              {3.5, 7, 9, 6.5}),  // Lock
        boxed(lines({{{5, 7}, {5, 4.5}, {6.5, 2.5}, {9.5, 2.5}, {11, 4}}}),
              {3.5, 7, 9, 6.5}),  // Unlock
        lines({{{5, 5.5}, {5.5, 3.5}, {8, 2.5}, {10.5, 3.5}, {11, 5.5}, {8, 8}, {8, 10.5}},
               {{8, 12.7}, {8, 14.3}}}),  // Help
    };
    return all;
}

}  // namespace

void paint(QPainter& painter, const QRectF& box, Glyph glyph, const QColor& colour) {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.translate(box.topLeft());
    painter.scale(box.width() / 16, box.height() / 16);
    painter.setPen(QPen{colour, 1.6, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin});
    painter.setBrush(Qt::NoBrush);
    painter.drawPath(paths()[static_cast<std::size_t>(glyph)]);
    painter.restore();
}

QIcon icon(Glyph glyph, const QColor& colour, int pixels) {
    QPixmap pixmap{pixels, pixels};
    pixmap.fill(Qt::transparent);
    QPainter painter{&pixmap};
    paint(painter, pixmap.rect(), glyph, colour);
    painter.end();
    QIcon result;  // the same where it cannot be pressed: the edge says so
    for (const auto mode : {QIcon::Normal, QIcon::Disabled, QIcon::Selected}) {
        result.addPixmap(pixmap, mode);
    }
    return result;
}

}  // namespace cortex::gui
