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
#include <utility>

#include <qwt_scale_map.h>

namespace cortex::gui {

namespace {

constexpr double leastTold = 3;  // pixels

QString tr(const char* text) { return QCoreApplication::translate("Plot", text); }

// What is seen of a gap, as high as the row; of a negative width: nothing.
QRectF boxOf(const Gap& gap, const QwtScaleMap& xMap, const QRectF& row) {
    const double from = std::max(xMap.transform(gap.from), row.left());
    const double to = std::min(xMap.transform(gap.to), row.right());
    return {from, row.top(), to - from, row.height()};
}

}  // namespace

QString gapText(const Gap& gap, bool ofAll) {
    QString text = (gap.lack == Lack::NoData    ? tr("no data %1")
                    : gap.lack == Lack::NotGood ? tr("not good %1")
                                                : tr("no data %1, in part not good"))
                       .arg(durationText(gap.to - gap.from));
    if (ofAll) return text;
    QString tags;
    for (const int each : gap.tags) {
        tags += (tags.isEmpty() ? QString{} : QStringLiteral(", ")) + QString::number(each);
    }
    return QStringLiteral("%1: %2").arg(tags, text);
}

void GapItem::show(std::vector<Gap> gaps, std::size_t lines) {
    gaps_ = std::move(gaps);
    // The longest are told where there is no room for all.
    std::ranges::sort(gaps_, std::greater{}, [](const Gap& of) { return of.to - of.from; });
    lines_ = lines;
}

void GapItem::draw(QPainter* painter, const QwtScaleMap& xMap, const QwtScaleMap& /*yMap*/,
                   const QRectF& canvas) const {
    painter->save();
    for (const Gap& each : gaps_) {
        const QRectF seen = boxOf(each, xMap, canvas);
        if (seen.right() >= canvas.left() && seen.left() <= canvas.right()) {
            paintHatch(*painter, seen.adjusted(0, 0, std::max(2 - seen.width(), 0.0), 0));
        }
    }
    const double height = QFontMetricsF{Look::font(TextSize::Note)}.height() + Look::length(1);
    const QRectF row{canvas.left(), canvas.top() + Look::length(1), canvas.width(), height};
    paintTexts(*painter, xMap, row, true, {});
    painter->restore();
}

void GapItem::paintAbove(QPainter& painter, const QwtScaleMap& xMap, const QRectF& row,
                         std::vector<QRectF> taken) const {
    paintTexts(painter, xMap, row, false, std::move(taken));
}

// In chips, none over another one.
void GapItem::paintTexts(QPainter& painter, const QwtScaleMap& xMap, const QRectF& row, bool inside,
                         std::vector<QRectF> taken) const {
    const Tokens& c = Look::colours();
    painter.setFont(Look::font(TextSize::Note));
    const QFontMetricsF metrics{painter.font()};
    const double margin = Look::length(1.5);
    for (const Gap& each : gaps_) {
        const QRectF seen = boxOf(each, xMap, row);
        if (seen.width() < leastTold) continue;
        const QString text = gapText(each, each.tags.size() == lines_);
        const double width = metrics.horizontalAdvance(text) + 2 * margin;
        if (inside != (width <= seen.width()) || width > row.width()) continue;
        const double left =
            std::clamp(seen.center().x() - width / 2, row.left(), row.right() - width);
        const QRectF chip{left, row.top(), width, row.height()};
        const QRectF room = chip.adjusted(-margin, 0, margin, 0);
        if (std::ranges::any_of(taken, [&](const QRectF& of) { return of.intersects(room); }))
            continue;
        painter.setPen(QPen{c.data, 1});
        painter.setBrush(c.dataBg);
        painter.drawRoundedRect(chip, Look::length(1), Look::length(1));
        painter.setPen(c.dataText);
        painter.drawText(chip, Qt::AlignCenter, text);
        taken.push_back(chip);
    }
}

}  // namespace cortex::gui
