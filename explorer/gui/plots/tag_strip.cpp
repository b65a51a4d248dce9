// SPDX-License-Identifier: Apache-2.0
#include "plots/tag_strip.hpp"

#include "style/look.hpp"

#include <QApplication>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace cortex::gui {

int tagSize() { return Look::units(4); }

void paintTag(QPainter& painter, const QRect& box, int tag, const QColor& colour) {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen{colour, 2});
    painter.setBrush(Look::colours().raised);
    painter.drawRoundedRect(QRectF{box}.adjusted(1, 1, -1, -1), Look::length(0.5),
                            Look::length(0.5));
    painter.setPen(Look::colours().ink);
    painter.setFont(Look::font(TextSize::Note, true));
    painter.drawText(box, Qt::AlignCenter, QString::number(tag));
    painter.restore();
}

TagStrip::TagStrip(QWidget* parent) : QWidget{parent} {
    setCursor(Qt::OpenHandCursor);
    setToolTip(tr("Drag a number to another panel"));
    setAccessibleName(tr("Numbers of lines"));
}

// Tags that would lie on one another make room downwards, then upwards from the end.
void TagStrip::show(std::vector<Tag> tags) {
    const int size = tagSize() + 1;
    std::ranges::sort(tags, {}, &Tag::y);
    double free = 0;
    for (Tag& each : tags) {
        each.y = std::round(std::max(each.y - size / 2.0, free));
        free = each.y + size;
    }
    double end = height();
    for (auto each = tags.rbegin(); each != tags.rend(); ++each) {
        each->y = std::min(each->y, end - size);
        end = each->y;
    }
    if (tags == tags_) return;
    tags_ = std::move(tags);
    setFixedWidth(Look::units(5));
    update();
}

QRect TagStrip::boxOf(const Tag& tag) const {
    return {Look::units(0.5), static_cast<int>(tag.y), tagSize(), tagSize()};
}

QRect TagStrip::boxOf(int tag) const {
    const auto found = std::ranges::find(tags_, tag, &Tag::tag);
    return found == tags_.end() ? QRect{} : boxOf(*found);
}

void TagStrip::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    for (const Tag& each : tags_) paintTag(painter, boxOf(each), each.tag, each.colour);
}

void TagStrip::mousePressEvent(QMouseEvent* event) {
    from_ = event->pos();
    for (const Tag& each : tags_) {
        if (boxOf(each).contains(event->pos())) dragged_ = each.tag;
    }
}

// Small movements are those of a click.
bool TagStrip::isAway(const QPoint& at) const {
    return dragged_ != 0 && (at - from_).manhattanLength() >= QApplication::startDragDistance();
}

void TagStrip::mouseMoveEvent(QMouseEvent* event) {
    if (isAway(event->pos())) {
        Q_EMIT dragged(dragged_, event->globalPos());
    } else {
        Q_EMIT givenUp();
    }
}

void TagStrip::mouseReleaseEvent(QMouseEvent* event) {
    if (isAway(event->pos())) {
        Q_EMIT dropped(dragged_, event->globalPos());
    } else {
        Q_EMIT givenUp();
    }
    dragged_ = 0;
}

}  // namespace cortex::gui
