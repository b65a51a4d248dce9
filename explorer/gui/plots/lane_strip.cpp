// SPDX-License-Identifier: Apache-2.0
#include "plots/lane_strip.hpp"

#include "style/hatch.hpp"
#include "style/look.hpp"
#include "widgets/rows.hpp"

#include <QFontMetrics>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace cortex::gui {

namespace {

constexpr double darkest = 0.3;  // of the way from the ground to the ink

int laneHeight() { return Look::units(6.5); }

QColor between(const QColor& from, const QColor& to, double share) {
    const auto mixed = [&](double a, double b) { return a + (b - a) * share; };
    return QColor::fromRgbF(mixed(from.redF(), to.redF()), mixed(from.greenF(), to.greenF()),
                            mixed(from.blueF(), to.blueF()));
}

}  // namespace

LaneStrip::LaneStrip(QWidget* parent) : QWidget{parent} { setAccessibleName(tr("Lanes")); }

void LaneStrip::show(std::vector<DrawnLine> lanes, const Recorder& recorder, TimeSpan span) {
    lanes_ = std::move(lanes);
    span_ = span;
    words_.clear();
    const double pixel = span.length() / std::max(right_ - left_, 1);
    QStringList texts;
    for (const DrawnLine& each : lanes_) {
        words_.push_back(laneWords(each, recorder, span, pixel));
        const auto& words = words_.back();
        QString last = tr("no data");
        if (!words.empty() && !words.back().missing) last = words.back().text;
        if (!words.empty() && words.back().lack == Lack::NotGood) last = tr("not good");
        texts.append(QStringLiteral("%1: %2").arg(each.line.name(), last));
    }
    const QString text = texts.join(QStringLiteral(", "));
    if (text != accessibleDescription()) setAccessibleDescription(text);
    setFixedHeight(laneHeight() * static_cast<int>(lanes_.size()));
    setVisible(!lanes_.empty());
    update();
}

void LaneStrip::setEdges(int left, int right) {
    left_ = left;
    right_ = right;
}

std::vector<LaneWord> LaneStrip::words(int lane) const {
    return words_.at(static_cast<std::size_t>(lane));
}

QColor LaneStrip::colourOf(int lane, const LaneWord& word) const {
    const Tokens& c = Look::colours();
    if (word.text.isEmpty()) return c.ink2;
    const PlotLine& line = lanes_.at(static_cast<std::size_t>(lane)).line;
    return between(c.hover, c.ink2, darkest * shadeOf(line, word.number));
}

void LaneStrip::paintLane(QPainter& painter, const QRect& row, int lane) const {
    const Tokens& c = Look::colours();
    const QFontMetrics metrics{painter.font()};
    const double scale = (right_ - left_) / span_.length();
    const int margin = Look::units(2);
    for (const LaneWord& each : words(lane)) {
        const double from = std::max(left_ + (each.from - span_.from) * scale, left_ + 0.0);
        const double to = std::min(left_ + (each.to - span_.from) * scale, right_ + 0.0);
        if (to <= from) continue;
        const QRectF box{from, row.top() + 1.0, std::max(to - from, 1.0), row.height() - 4.0};
        if (each.missing) {
            paintHatch(painter, box);
            continue;
        }
        painter.fillRect(box, colourOf(lane, each));
        painter.setPen(QPen{c.border, 1});
        painter.drawLine(box.topLeft(), box.bottomLeft());
        const int room = static_cast<int>(box.width()) - 2 * margin;
        const QString text = metrics.elidedText(each.text, Qt::ElideRight, room);
        if (room < metrics.averageCharWidth() * 2 || text.size() < 2) continue;
        painter.setPen(c.ink);
        painter.drawText(box.adjusted(margin, 0, -margin, 0), Qt::AlignLeft | Qt::AlignVCenter,
                         text);
    }
}

void LaneStrip::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.setFont(Look::font(TextSize::Note));
    const QFontMetrics metrics{painter.font()};
    const int gap = Look::units(2);
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
        const QRect row{0, static_cast<int>(i) * laneHeight(), width(), laneHeight()};
        const QRect name{gap / 2, row.top(), left_ - gap - gap / 2, row.height()};
        painter.setPen(Look::colours().ink2);
        painter.drawText(
            name, Qt::AlignRight | Qt::AlignVCenter,
            metrics.elidedText(lanes_[i].line.itemName(), Qt::ElideMiddle, name.width()));
        paintLane(painter, row, static_cast<int>(i));
    }
}

}  // namespace cortex::gui
