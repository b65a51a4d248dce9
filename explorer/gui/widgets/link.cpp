// SPDX-License-Identifier: Apache-2.0
#include "widgets/link.hpp"

#include <QFontMetrics>
#include <QKeyEvent>
#include <QPainter>

namespace cortex::gui {

Link::Link(const QString& text, TextSize size, QWidget* parent)
    : QAbstractButton{parent}, size_{size} {
    setText(text);
    setAccessibleName(text);
    setCursor(Qt::PointingHandCursor);
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
}

QSize Link::sizeHint() const {
    const QFontMetrics metrics{Look::font(size_)};
    return {metrics.horizontalAdvance(text()) + Look::units(1),
            std::max(metrics.height(), Look::units(6))};
}

void Link::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    QFont font = Look::font(size_);
    font.setUnderline(underMouse() || hasFocus());
    painter.setFont(font);
    painter.setPen(Look::colours().accent);
    painter.drawText(rect(), Qt::AlignVCenter | Qt::TextSingleLine, text());
    if (!hasFocus()) return;
    painter.setPen(QPen{Look::colours().accent, 2});
    painter.drawRect(rect().adjusted(1, 1, -1, -1));
}

void Link::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) {
        click();
    } else {
        QAbstractButton::keyPressEvent(event);
    }
}

}  // namespace cortex::gui
