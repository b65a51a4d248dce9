// SPDX-License-Identifier: Apache-2.0
#include "widgets/drop_zone.hpp"

#include "style/look.hpp"

#include <QFontMetrics>
#include <QPainter>
#include <algorithm>

namespace cortex::gui {

DropZone::DropZone(QWidget* over) : QWidget{over} {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
    setFocusPolicy(Qt::NoFocus);
    hide();
}

void DropZone::show(const QRect& box, const QString& words, bool allowed) {
    words_ = words;
    allowed_ = allowed;
    setAccessibleName(words);
    setGeometry(box);
    raise();
    QWidget::show();
    update();
}

void DropZone::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    const Tokens& c = Look::colours();
    painter.setPen(QPen{allowed_ ? c.accent : c.warnEdge, 2});
    painter.drawRect(rect().adjusted(1, 1, -1, -1));
    painter.setFont(Look::font(TextSize::Text, true));
    const QFontMetrics metrics{painter.font()};
    const int side = Look::units(2), most = width() - 2 * side;
    const QString text = metrics.elidedText(words_, Qt::ElideRight, most - 2 * side);
    QRect box{0, 0, metrics.horizontalAdvance(text) + 2 * side,
              std::min(metrics.height() + side, height() - 4)};
    box.moveCenter(rect().center());
    painter.fillRect(box, allowed_ ? c.raised : c.warnBg);
    painter.setPen(allowed_ ? c.ink : c.warnText);
    painter.drawText(box, Qt::AlignCenter, text);
}

}  // namespace cortex::gui
