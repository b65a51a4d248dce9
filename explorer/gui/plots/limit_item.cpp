// SPDX-License-Identifier: Apache-2.0
#include "plots/limit_item.hpp"

#include "model/value_text.hpp"
#include "style/look.hpp"

#include <QFontMetricsF>
#include <QPainter>
#include <algorithm>
#include <map>

#include <qwt_scale_map.h>

namespace cortex::gui {

namespace {

// The lines that have a limit, by its value.
std::map<double, std::vector<const PlotLine*>> limitsOf(const std::vector<PlotLine>& lines,
                                                        bool upper) {
    std::map<double, std::vector<const PlotLine*>> found;
    for (const PlotLine& each : lines) {
        if (const auto limit = numberOf(upper ? each.data.max : each.data.min)) {
            found[*limit].push_back(&each);
        }
    }
    return found;
}

void paintBand(QPainter& painter, bool upper, double y, const QRectF& canvas, bool ofAll) {
    const Tokens& c = Look::colours();
    if (ofAll) {
        painter.fillRect(upper ? QRectF{canvas.topLeft(), QPointF{canvas.right(), y}}
                               : QRectF{QPointF{canvas.left(), y}, canvas.bottomRight()},
                         c.warnBg);
    }
    QPen pen{c.warnEdge, 1};
    pen.setDashPattern({6, 4});
    painter.setPen(pen);
    painter.drawLine(QPointF{canvas.left(), y}, QPointF{canvas.right(), y});
}

// On the inner side; where there is no room, on the other one.
void paintWords(QPainter& painter, const QString& text, bool upper, double y,
                const QRectF& canvas) {
    const Tokens& c = Look::colours();
    painter.setFont(Look::font(TextSize::Note));
    const QFontMetricsF metrics{painter.font()};
    const double height = metrics.height(), margin = Look::length(1);
    double top = upper ? y + 1 : y - height - 1;
    if (top < canvas.top()) top = y + 1;
    if (top + height > canvas.bottom()) top = y - height - 1;
    const double width = metrics.horizontalAdvance(text) + margin;
    const QRectF box{canvas.right() - width - margin, top, width, height};
    painter.fillRect(box, c.canvas);
    painter.setPen(c.warnText);
    painter.drawText(box, Qt::AlignCenter, text);
}

QString wordsOf(double limit, bool upper, const PlotLine& line, bool ofAll) {
    const QString text = QStringLiteral("%1 %2 %3")
                             .arg(upper ? QStringLiteral("max") : QStringLiteral("min"),
                                  numberText(line.data, limit), line.unit())
                             .trimmed();
    return ofAll ? text : QStringLiteral("%1: %2").arg(line.tag).arg(text);
}

}  // namespace

LimitItem::LimitItem(Part part) : part_{part} { setZ(part == Part::Band ? 2 : 7); }

void LimitItem::draw(QPainter* painter, const QwtScaleMap& /*xMap*/, const QwtScaleMap& yMap,
                     const QRectF& canvas) const {
    painter->save();
    painter->setClipRect(canvas);
    for (const bool upper : {true, false}) {
        for (const auto& [limit, of] : limitsOf(lines_, upper)) {
            const double y = yMap.transform(limit);
            const bool ofAll = of.size() == lines_.size();
            const bool inside = y > canvas.top() && y < canvas.bottom();
            if (inside && part_ == Part::Band) {
                paintBand(*painter, upper, y, canvas, ofAll);
            } else if (inside) {
                paintWords(*painter, wordsOf(limit, upper, *of.front(), ofAll), upper, y, canvas);
            } else if (part_ == Part::Band && ofAll &&
                       (upper ? y >= canvas.bottom() : y <= canvas.top())) {
                painter->fillRect(canvas, Look::colours().warnBg);  // all of it is outside
            }
        }
    }
    painter->restore();
}

}  // namespace cortex::gui
