// SPDX-License-Identifier: Apache-2.0
#include "plots/gap_item.hpp"

#include "plots/time_ticks.hpp"
#include "style/hatch.hpp"
#include "style/look.hpp"

#include <QCoreApplication>
#include <QFontMetricsF>
#include <QPainter>
#include <algorithm>
#include <functional>

#include <qwt_scale_map.h>

namespace cortex::gui {

namespace {

constexpr double leastTold = 3;  // pixels

QString tr(const char* text) { return QCoreApplication::translate("Plot", text); }

}  // namespace

QString gapText(const Gap& gap, bool ofAll) {
    const QString length = durationText(gap.to - gap.from);
    if (ofAll) return tr("no data %1").arg(length);
    QString tags;
    for (const int each : gap.tags) {
        tags += (tags.isEmpty() ? QString{} : QStringLiteral(", ")) + QString::number(each);
    }
    return tr("%1: no data %2").arg(tags, length);
}

GapItem::GapItem(Part part) : part_{part} { setZ(part == Part::Hatch ? 5 : 25); }

void GapItem::show(std::vector<Gap> gaps, std::size_t lines) {
    gaps_ = std::move(gaps);
    // The longest are told where there is no room for all.
    std::ranges::sort(gaps_, std::greater{}, [](const Gap& of) { return of.to - of.from; });
    lines_ = lines;
}

void GapItem::draw(QPainter* painter, const QwtScaleMap& xMap, const QwtScaleMap& /*yMap*/,
                   const QRectF& canvas) const {
    painter->save();
    painter->setFont(Look::font(TextSize::Note));
    std::vector<QRectF> chips;
    for (const Gap& each : gaps_) {
        const double from = std::max(xMap.transform(each.from), canvas.left());
        const double to = std::min(xMap.transform(each.to), canvas.right());
        if (from > canvas.right() || to < canvas.left()) continue;
        const QRectF box{from, canvas.top(), std::max(to - from, 2.0), canvas.height()};
        if (part_ == Part::Hatch) {
            paintHatch(*painter, box);
        } else if (to - from >= leastTold) {
            paintText(*painter, gapText(each, each.tags.size() == lines_), box, canvas, chips);
        }
    }
    painter->restore();
}

// In a chip that may be wider than the gap, below the title; not over another one.
void GapItem::paintText(QPainter& painter, const QString& text, const QRectF& box,
                        const QRectF& canvas, std::vector<QRectF>& chips) {
    const Tokens& c = Look::colours();
    const QFontMetricsF metrics{painter.font()};
    const double margin = Look::length(1.5), width = metrics.horizontalAdvance(text) + 2 * margin;
    const double left = std::clamp(box.center().x() - width / 2, canvas.left(),
                                   std::max(canvas.right() - width, canvas.left()));
    const QRectF chip{left, canvas.top() + metrics.height() + 2 * margin, width,
                      metrics.height() + Look::length(1)};
    const QRectF room = chip.adjusted(-margin, 0, margin, 0);
    if (std::ranges::any_of(chips, [&](const QRectF& each) { return each.intersects(room); }))
        return;
    painter.setPen(QPen{c.data, 1});
    painter.setBrush(c.dataBg);
    painter.drawRoundedRect(chip, Look::length(1), Look::length(1));
    painter.setPen(c.dataText);
    painter.drawText(chip, Qt::AlignCenter, text);
    chips.push_back(chip);
}

}  // namespace cortex::gui
